// The picture of a view, drawn with WebGL: what is in it, from where, what is cut off.
carom.Drawing = (function () {
  "use strict";

  class Drawing {
    constructor(canvas, scenes, extent, onTurned) {
      this.extent = extent;
      this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
      this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
      this.renderer.localClippingEnabled = true;
      this.clipping = [];
      this.models = scenes.map((scene, s) => new carom.SceneModel(scene, s > 0, this.clipping));
      this.eye = new carom.ViewCamera(extent, canvas, onTurned);
      const light = new THREE.DirectionalLight(0xffffff, 0.5);
      light.position.set(0.4, 0.6, 1);
      this.eye.camera.add(light, light.target);
      this.world = new THREE.Scene();
      for (const model of this.models) this.world.add(...model.objects);
      this.world.add(this.eye.camera, new THREE.AmbientLight(0xffffff, 0.62));
    }

    resize(width, height) {
      this.eye.resize(width / height);
      this.renderer.setSize(width, height, false);
    }

    // Obstacles have no colours but their own, and no arrows.
    show(what) {
      this.plain = this.plain || new carom.Colouring(this.models[0].scene);
      for (const model of this.models) model.show(model.isObstacle ? { ...what, colouring: this.plain, arrows: false } : what);
    }

    draw() {
      this.renderer.render(this.world, this.eye.camera);
    }

    // Shows one side of a plane across an axis (0, 1, 2; -1: no cut), at this share of the way along the bodies.
    cut(axis, share, isOtherHalf) {
      this.clipping.length = 0;
      if (axis >= 0) this.clipping.push(cuttingPlane(this.extent, axis, share, isOtherHalf));
      for (const model of this.models) for (const object of model.objects) object.material.needsUpdate = true;
    }

    // The cell and node of the bodies at a place of the picture, from -1 to 1 to the right and upward; null for none.
    pick(x, y) {
      const raycaster = new THREE.Raycaster();
      raycaster.setFromCamera(new THREE.Vector2(x, y), this.eye.camera);
      return this.models[0].pick(raycaster, (point) => this.clipping.every((plane) => plane.distanceToPoint(point) >= 0));
    }

    // Where a node of the bodies is on the picture, in the same numbers.
    placeOf(node) {
      const { at } = this.models[0];
      return new THREE.Vector3(at[0][node], at[1][node], at[2][node]).project(this.eye.camera);
    }
  }

  // What is on its positive side is seen.
  function cuttingPlane({ low, high }, axis, share, isOtherHalf) {
    const sign = isOtherHalf ? 1 : -1, at = low[axis] + share * (high[axis] - low[axis]);
    return new THREE.Plane(new THREE.Vector3().setComponent(axis, sign), -sign * at);
  }

  return Object.assign(Drawing, { cuttingPlane });
})();
