// From where a view is seen: a camera without perspective that the mouse and the keys turn, shift and zoom.
carom.ViewCamera = (function () {
  "use strict";
  const AWAY = 20;  // the eye's distance from what it looks at, in reaches: behind everything

  // Where the eye is, seen from the bodies. In space it is a hair in front of the upright when it looks from above: so y
  // points upward on the picture.
  const directions = (isPlane) => ({ iso: [1, -1.4, 0.8], x: [1, 0, 0], y: [0, -1, 0], z: isPlane ? [0, 0, 1] : [0, -1e-6, 1] });

  // The sides of a picture that holds a ball of this radius, a little larger; aspect is width to height.
  function frustum(reach, aspect) {
    const half = reach * 1.05;
    const [across, up] = aspect > 1 ? [half * aspect, half] : [half, half / aspect];
    return { left: -across, right: across, top: up, bottom: -up };
  }

  class ViewCamera {
    constructor(extent, canvas, onTurned) {
      this.extent = extent;
      this.camera = new THREE.OrthographicCamera();
      this.camera.up.set(...(extent.isPlane ? [0, 1, 0] : [0, 0, 1]));
      this.controls = new THREE.OrbitControls(this.camera, canvas);
      this.controls.enableKeys = false;
      this.controls.screenSpacePanning = true;
      this.onTurned = onTurned;
      this.controls.addEventListener("change", onTurned);
    }

    // From what is looked at to the eye.
    away() {
      return this.camera.position.clone().sub(this.controls.target);
    }

    // From this direction, everything in the picture.
    look(direction) {
      const { reach, centre } = this.extent;
      this.controls.target.set(...centre);
      this.camera.position.copy(this.controls.target).addScaledVector(new THREE.Vector3(...direction).normalize(), AWAY * reach);
      Object.assign(this.camera, { near: 0.1 * reach, far: 2 * AWAY * reach, zoom: 1 });
      this.camera.updateProjectionMatrix();
      this.controls.update();
      this.onTurned();
    }

    fit() {
      this.look(this.away().toArray());
    }

    // About the upright axis, and over the horizontal one.
    turn(around, over) {
      const away = this.away(), level = new THREE.Vector3().crossVectors(this.camera.up, away).normalize();
      away.applyAxisAngle(this.camera.up, around).applyAxisAngle(level, over);
      this.camera.position.copy(this.controls.target).add(away);
      this.controls.update();
    }

    zoom(factor) {
      this.camera.zoom *= factor;
      this.camera.updateProjectionMatrix();
      this.onTurned();
    }

    // From where another one looks, as near.
    follow(other) {
      this.camera.position.copy(this.controls.target).addScaledVector(other.away().normalize(), AWAY * this.extent.reach);
      this.camera.zoom = other.camera.zoom;
      this.camera.updateProjectionMatrix();
      this.controls.update();
    }

    resize(aspect) {
      Object.assign(this.camera, frustum(this.extent.reach, aspect));
      this.camera.updateProjectionMatrix();
    }
  }

  return Object.assign(ViewCamera, { directions, frustum });
})();
