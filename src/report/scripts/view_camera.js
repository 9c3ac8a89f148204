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

  // Directions to the right and upward on a picture.
  function pictureAxes(towards, up) {
    const right = new THREE.Vector3().crossVectors(up, towards).normalize();
    return [right, new THREE.Vector3().crossVectors(towards, right)];
  }

  // How far the middle of these points stands from the centre on the picture, and how much larger than within these sides
  // they may be drawn, with a margin of 5 %.
  function fitted(points, centre, axes, { right, top }) {
    const ends = axes.map((axis) => {
      let low = Infinity, high = -Infinity;
      for (const point of points) {
        const x = axis.x * (point[0] - centre[0]) + axis.y * (point[1] - centre[1]) + axis.z * (point[2] - centre[2]);
        low = Math.min(low, x);
        high = Math.max(high, x);
      }
      return { middle: (low + high) / 2, half: (high - low) / 2 };
    });
    const shift = new THREE.Vector3().addScaledVector(axes[0], ends[0].middle).addScaledVector(axes[1], ends[1].middle);
    const zoom = Math.min(right / ends[0].half, top / ends[1].half) / 1.1;
    return { shift, zoom: Number.isFinite(zoom) ? zoom : 1 };
  }

  class ViewCamera {
    // extent: all of what is there (carom.extentOf).
    constructor(extent, canvas, onTurned) {
      Object.assign(this, { extent, whole: extent, aspect: 1 });
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

    // Behind everything, also where the picture shows a part of it.
    get distance() {
      return Math.max(AWAY * this.extent.reach, 3 * this.whole.reach);
    }

    // From this direction, all of the extent in the picture.
    look(direction) {
      const { reach, centre, points } = this.extent, { distance, camera } = this;
      const towards = new THREE.Vector3(...direction).normalize(), sides = frustum(reach, this.aspect);
      const { shift, zoom } = points ? fitted(points, centre, pictureAxes(towards, camera.up), sides) : { shift: new THREE.Vector3(), zoom: 1 };
      this.controls.target.set(...centre).add(shift);
      camera.position.copy(this.controls.target).addScaledVector(towards, distance);
      Object.assign(camera, { near: 0.1 * reach, far: 2 * distance, zoom, ...sides });
      camera.updateProjectionMatrix();
      this.controls.update();
      this.onTurned();
    }

    // All of this box (carom.fitOf) in the picture, from where it is looked at now.
    fit(extent) {
      this.extent = { ...extent, isPlane: this.whole.isPlane };
      this.look(this.away().toArray());
    }

    // Eye and what is looked at, by as much.
    shift(way) {
      const { extent } = this, moved = (place) => place.map((x, c) => x + way[c]);
      this.extent = { ...extent, centre: moved(extent.centre), points: extent.points && extent.points.map(moved) };
      const step = new THREE.Vector3(...way);
      this.controls.target.add(step);
      this.camera.position.add(step);
      this.controls.update();
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
      this.camera.position.copy(this.controls.target).addScaledVector(other.away().normalize(), this.distance);
      this.camera.zoom = other.camera.zoom;
      this.camera.updateProjectionMatrix();
      this.controls.update();
    }

    // How many pixels a length of one has in a picture of this height.
    pixels(height) {
      return (height * this.camera.zoom) / (this.camera.top - this.camera.bottom);
    }

    resize(aspect) {
      this.aspect = aspect;
      Object.assign(this.camera, frustum(this.extent.reach, aspect));
      this.camera.updateProjectionMatrix();
    }
  }

  return Object.assign(ViewCamera, { directions, frustum, fitted });
})();
