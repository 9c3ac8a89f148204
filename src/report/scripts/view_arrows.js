// The arrows of a scene's contact forces.
carom.ForceArrows = (function () {
  "use strict";
  const LEAST = 1e-3;  // of the largest force: smaller ones have no arrow

  function forceAt(field, frame, i) {
    return new THREE.Vector3(...[0, 1, 2].map((c) => field.value(c, frame, i) || 0));
  }

  // The largest number of nodes of a frame that have an arrow.
  function mostArrows(scene, field, largest) {
    let most = 0;
    for (let t = 0; t < scene.frames; t++) {
      let count = 0;
      for (let i = 0; i < scene.nodes; i++) if (forceAt(field, t, i).lengthSq() > (LEAST * largest) ** 2) count++;
      most = Math.max(most, count);
    }
    return most;
  }

  // Where an arrow of length one along y goes: forces on the body end at their node, they push it. A short arrow is not
  // thinner than a quarter of the longest.
  function placeArrow(force, end, length, longest) {
    const along = force.clone().normalize();
    const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), along);
    const width = Math.max(length, 0.25 * longest);
    return new THREE.Matrix4().compose(end.addScaledVector(along, -length), turn, new THREE.Vector3(width, length, width));
  }

  class ForceArrows {
    constructor(scene, field, largest, most, clipping) {
      Object.assign(this, { scene, field, largest });
      const material = new THREE.MeshPhongMaterial({ color: 0xd0342c, shininess: 0, clippingPlanes: clipping });
      const shaft = new THREE.CylinderBufferGeometry(0.02, 0.02, 0.75, 8).translate(0, 0.375, 0);
      const head = new THREE.ConeBufferGeometry(0.06, 0.25, 12).translate(0, 0.875, 0);
      this.objects = [shaft, head].map((geometry) => new THREE.InstancedMesh(geometry, material, most));
      for (const object of this.objects) object.frustumCulled = false;
    }

    // Where the arrows of a frame begin.
    tails(frame, at, longest) {
      const tails = [];
      for (let i = 0; i < this.scene.nodes; i++) {
        const force = forceAt(this.field, frame, i);
        if (force.length() > LEAST * this.largest) tails.push([0, 1, 2].map((c) => at[c][i] - (longest * force.getComponent(c)) / this.largest));
      }
      return tails;
    }

    // With nodes at these places, the largest force of the run as long as `longest`.
    show(frame, at, longest, visible) {
      for (const object of this.objects) object.visible = visible;
      if (!visible) return;
      let count = 0;
      for (let i = 0; i < this.scene.nodes; i++) {
        const force = forceAt(this.field, frame, i), size = force.length();
        if (!(size > LEAST * this.largest)) continue;
        const end = new THREE.Vector3(at[0][i], at[1][i], at[2][i]);
        const matrix = placeArrow(force, end, (longest * size) / this.largest, longest);
        for (const object of this.objects) object.setMatrixAt(count, matrix);
        count++;
      }
      for (const object of this.objects) {
        object.count = count;
        object.instanceMatrix.needsUpdate = true;
      }
    }
  }

  ForceArrows.placeArrow = placeArrow;
  // Null where a run has no contact forces in space.
  ForceArrows.of = function (scene, clipping) {
    const field = scene.field("contact_force");
    if (!field || field.ranges.length !== 3) return null;
    const largest = Math.max(...new carom.Colouring(scene, field, -1).ofAllTimes), most = mostArrows(scene, field, largest);
    return most === 0 ? null : new ForceArrows(scene, field, largest, most, clipping);
  };
  return ForceArrows;
})();
