// The cut faces of bodies that are cut open, filled in: pixels before which the surface on the side that is kept is met an
// odd number of times lie inside of a body. What fills them has the colour of the part: pages hold no values inside.
carom.CutFill = (function () {
  "use strict";

  // Does every side of these triangles belong to an even number of them? Bars have no inside.
  function isClosed(scene, triangles) {
    const odd = new Set();
    for (const k of triangles) {
      for (let e = 0; e < 3; e++) {
        const a = scene.node[e][k], b = scene.node[(e + 1) % 3][k], key = Math.min(a, b) * scene.nodes + Math.max(a, b);
        if (!odd.delete(key)) odd.add(key);
      }
    }
    return triangles.length > 0 && odd.size === 0;
  }

  // Lists of parts that are closed, each as its triangles: parts by themselves, and together those that share their faces.
  function closedGroups(scene) {
    const ofPart = new Map();
    for (let k = 0; k < scene.triangles; k++) {
      const part = scene.part[scene.cell[k]], isBar = scene.node[1][k] === scene.node[2][k];
      if (!ofPart.has(part)) ofPart.set(part, []);
      if (!isBar) ofPart.get(part).push(k);
    }
    const first = (triangles) => triangles.filter((k) => scene.isSeen(k, 0));
    const groups = [], open = [];
    for (const [part, triangles] of ofPart) {
      if (isClosed(scene, first(triangles))) groups.push({ parts: [part], triangles });
      else open.push({ part, triangles });
    }
    const joint = { parts: open.map((o) => o.part), triangles: open.flatMap((o) => o.triangles) };
    return isClosed(scene, first(joint.triangles)) ? [...groups, joint] : groups;
  }

  function stencilMesh(position, triangles, clippingPlanes) {
    const geometry = new THREE.BufferGeometry().setAttribute("position", position);
    geometry.setIndex(new THREE.BufferAttribute(Uint32Array.from(triangles.flatMap((k) => [3 * k, 3 * k + 1, 3 * k + 2])), 1));
    const each = THREE.InvertStencilOp;
    const material = new THREE.MeshBasicMaterial({
      colorWrite: false, depthWrite: false, depthTest: false, side: THREE.DoubleSide, clippingPlanes,
      stencilWrite: true, stencilFunc: THREE.AlwaysStencilFunc, stencilFail: each, stencilZFail: each, stencilZPass: each,
    });
    return new THREE.Mesh(geometry, material);
  }

  // Drawn where the surface was met an odd number of times; the marks of that go with it.
  function capMesh(colour) {
    const clear = THREE.ReplaceStencilOp;
    return new THREE.Mesh(new THREE.PlaneBufferGeometry(1, 1), new THREE.MeshBasicMaterial({
      color: new THREE.Color(...colour.map((c) => c / 255)), side: THREE.DoubleSide,
      stencilWrite: true, stencilRef: 0, stencilFunc: THREE.NotEqualStencilFunc, stencilFail: clear, stencilZFail: clear, stencilZPass: clear,
    }));
  }

  class CutFill {
    // Of a model's surface, which is cut by these planes.
    constructor(model, clipping, extent) {
      Object.assign(this, { model, extent });
      const { none, parts } = carom.ColourScale.palettes, position = model.mesh.geometry.attributes.position;
      this.fills = closedGroups(model.scene).map((group, g) => {
        const colour = group.parts.length === 1 ? parts[group.parts[0] % parts.length] : none;
        const made = { ...group, mesh: stencilMesh(position, group.triangles, clipping), cap: capMesh(colour) };
        [made.mesh, made.cap].forEach((object, i) => Object.assign(object, { frustumCulled: false, visible: false, renderOrder: 2 * g + i + 1 }));
        return made;
      });
    }

    get objects() {
      return this.fills.flatMap(({ mesh, cap }) => [mesh, cap]);
    }

    // What is counted.
    get surfaces() {
      return this.fills.map(({ mesh }) => mesh);
    }

    // In this plane; undefined: there is no cut.
    show(plane) {
      this.plane = plane;
      this.update();
    }

    // Parts that share their faces are not closed without each other.
    update() {
      const { plane, extent } = this, { hidden } = this.model;
      for (const { parts, mesh, cap } of this.fills) {
        mesh.visible = cap.visible = Boolean(plane) && !parts.some((part) => hidden.has(part));
        if (!plane) continue;
        plane.projectPoint(new THREE.Vector3(...extent.centre), cap.position);
        cap.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), plane.normal);
        cap.scale.setScalar(8 * extent.reach);
      }
    }
  }

  return Object.assign(CutFill, { closedGroups });
})();
