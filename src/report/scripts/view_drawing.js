// The picture of a view, drawn with WebGL: what is in it, from where, what is cut off.
carom.Drawing = (function () {
  "use strict";

  class Drawing {
    constructor(canvas, scenes, extent, onTurned) {
      this.extent = extent;
      this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
      this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
      this.renderer.localClippingEnabled = true;
      Object.assign(this, { cutting: [], cropping: [], clipping: [], around: [] });
      this.models = scenes.map((scene, s) => new carom.SceneModel(scene, s > 0, s > 0 ? this.around : this.clipping));
      if (!extent.isPlane) this.fill = new carom.CutFill(this.models[0], this.clipping, extent);
      this.eye = new carom.ViewCamera(extent, canvas, onTurned);
      const light = new THREE.DirectionalLight(0xffffff, 0.5);
      light.position.set(0.4, 0.6, 1);
      this.eye.camera.add(light, light.target);
      this.world = new THREE.Scene();
      const objects = [...this.models, ...(this.fill ? [this.fill] : [])].flatMap((drawn) => drawn.objects);
      this.world.add(this.eye.camera, new THREE.AmbientLight(0xffffff, 0.62), ...objects);
    }

    resize(width, height) {
      this.eye.resize(width / height);
      this.height = height;
      this.renderer.setSize(width, height, false);
    }

    // Obstacles have no colours but their own, and no arrows.
    show(what) {
      this.plain = this.plain || new carom.Colouring(this.models[0].scene);
      for (const model of this.models) model.show(model.isObstacle ? { ...what, colouring: this.plain, arrows: false } : what);
    }

    draw() {
      const pixels = this.eye.pixels(this.height);
      for (const model of this.models) model.edges.zoom(pixels);
      this.renderer.render(this.world, this.eye.camera);
    }

    // Shows one side of a plane across an axis (0, 1, 2; -1: no cut), at this share of the way along the bodies.
    cut(axis, share, isOtherHalf) {
      this.cutting = axis < 0 ? [] : [cuttingPlane(this.extent, axis, share, isOtherHalf)];
      if (this.fill) this.fill.show(this.cutting[0]);
      this.clip();
    }

    // All of this box in the picture, and obstacles around it.
    fit(box) {
      this.cropping = [0, 1, 2].flatMap((axis) => croppingPlanes(box, axis));
      this.clip();
      this.eye.fit(box);
    }

    // The picture goes this way, and what it shows of obstacles.
    shift(way) {
      for (const plane of this.cropping) plane.translate(new THREE.Vector3(...way));
      this.eye.shift(way);
    }

    // Draws what is there in these planes as well; obstacles only where they end at one.
    mirror(planes) {
      const images = carom.Mirrors.imagesOf(planes), [bodies] = this.models;
      for (const object of [bodies.mesh, bodies.edges.object, ...(this.fill ? this.fill.surfaces : [])]) carom.Mirrors.repeat(object, images);
      for (const { scene, mesh, edges } of this.models.slice(1)) {
        const own = carom.Mirrors.imagesOf(carom.Mirrors.oneSided(scene, planes));
        for (const object of [mesh, edges.object]) carom.Mirrors.repeat(object, own);
      }
    }

    clip() {
      this.clipping.splice(0, Infinity, ...this.cutting);
      this.around.splice(0, Infinity, ...this.cutting, ...this.cropping);
      for (const model of this.models) for (const object of model.objects) object.material.needsUpdate = true;
    }

    // Which triangles of the bodies are in the picture in this frame, hidden by nothing but what stands before them.
    sight(frame, scale) {
      const { scene } = this.models[0], at = carom.positions(scene, frame, scale), place = new THREE.Vector3();
      return (k) => {
        if (!this.models[0].isSeen(k, frame)) return false;
        at.forEach((xs, c) => place.setComponent(c, scene.node.reduce((sum, nodes) => sum + xs[nodes[k]], 0) / 3));
        if (!this.clipping.every((plane) => plane.distanceToPoint(place) >= 0)) return false;
        place.project(this.eye.camera);
        return Math.abs(place.x) <= 1 && Math.abs(place.y) <= 1;
      };
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

  // Beside a box, a little farther out than it reaches.
  function croppingPlanes({ low, high, reach }, axis) {
    return [[1, low[axis] - 0.6 * reach], [-1, high[axis] + 0.6 * reach]].map(([sign, at]) =>
      new THREE.Plane(new THREE.Vector3().setComponent(axis, sign), -sign * at));
  }

  return Object.assign(Drawing, { cuttingPlane, croppingPlanes });
})();
