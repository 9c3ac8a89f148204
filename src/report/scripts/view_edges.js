// The edges of cells as three.js draws them.
carom.CellEdges = (function () {
  "use strict";
  const EDGE = 5;  // numbers of an edge

  // Every edge of a cell once: its nodes, the part of one of its cells, the frames from which and until which it is seen:
  // what has become an edge of the surface stays one until its last cell goes.
  function edgesOf(scene) {
    const seen = new Map(), edges = [];
    for (let k = 0; k < scene.triangles; k++) {
      for (let e = 0; e < 3; e++) {
        if (!(scene.edges[k] & (1 << e))) continue;
        const a = scene.node[e][k], b = scene.node[(e + 1) % 3][k];
        const key = Math.min(a, b) * scene.nodes + Math.max(a, b);
        const [from, until] = scene.changes ? [scene.from[k], scene.until[k]] : [0, scene.frames];
        const known = seen.get(key);
        if (known === undefined) {
          seen.set(key, edges.length);
          edges.push(a, b, scene.part[scene.cell[k]], from, until);
        } else {
          edges[known + 3] = Math.min(edges[known + 3], from);
          edges[known + 4] = Math.max(edges[known + 4], until);
        }
      }
    }
    return Uint32Array.from(edges);
  }

  class CellEdges {
    constructor(scene, isObstacle, clipping) {
      this.scene = scene;
      this.edges = edgesOf(scene);
      const geometry = carom.changingGeometry((2 * this.edges.length) / EDGE, { position: 3 });
      this.position = geometry.attributes.position;
      const material = new THREE.LineBasicMaterial({ color: isObstacle ? 0x808080 : 0x000000, transparent: true, opacity: isObstacle ? 0.6 : 0.45, clippingPlanes: clipping });
      this.object = new THREE.LineSegments(geometry, material);
      this.object.frustumCulled = false;
    }

    // Of the parts that are not hidden, with nodes at these places.
    show(at, frame, hidden, visible) {
      this.object.visible = visible;
      if (!visible) return;
      const line = this.position.array;
      for (let e = 0; e < this.edges.length / EDGE; e++) {
        const [, , part, from, until] = this.edges.subarray(EDGE * e, EDGE * (e + 1));
        const isHidden = hidden.has(part) || (this.scene.changes && (frame < from || frame >= until));
        for (let a = 0; a < 2; a++)
          for (let c = 0; c < 3; c++) line[6 * e + 3 * a + c] = at[c][this.edges[EDGE * e + (isHidden ? 0 : a)]];
      }
      this.position.needsUpdate = true;
    }
  }

  CellEdges.edgesOf = edgesOf;
  return CellEdges;
})();
