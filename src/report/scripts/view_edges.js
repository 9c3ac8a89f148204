// The edges of cells as three.js draws them.
carom.CellEdges = (function () {
  "use strict";
  const EDGE = 5;  // numbers of an edge
  const LEAST = 8;  // pixels across a cell: the edges of smaller ones would paint it black

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

  const sideOf = ({ at }, a, b) => Math.hypot(...at.map((xs) => xs[a] - xs[b]));

  // Of a triangle, the height over its longest side: how wide it is where it is narrowest.
  function widthOf(scene, k) {
    const sides = [0, 1, 2].map((e) => sideOf(scene, scene.node[e][k], scene.node[(e + 1) % 3][k]));
    const half = (sides[0] + sides[1] + sides[2]) / 2;
    const square = sides.reduce((product, side) => product * (half - side), half);  // of the area, by Heron's formula
    return (2 * Math.sqrt(Math.max(0, square))) / Math.max(...sides) || 0;
  }

  // The widths of the cells at every edge, of the wider one of two; bars have none, and their edges are always drawn.
  function widthsOf(scene, edges) {
    const widths = new Map();
    for (let k = 0; k < scene.triangles; k++) {
      const width = scene.node[1][k] === scene.node[2][k] ? Infinity : widthOf(scene, k);
      for (let e = 0; e < 3; e++) {
        const a = scene.node[e][k], b = scene.node[(e + 1) % 3][k], key = Math.min(a, b) * scene.nodes + Math.max(a, b);
        widths.set(key, Math.max(widths.get(key) || 0, width));
      }
    }
    return Array.from({ length: edges.length / EDGE }, (_, e) => {
      const a = edges[EDGE * e], b = edges[EDGE * e + 1];
      return widths.get(Math.min(a, b) * scene.nodes + Math.max(a, b));
    });
  }

  // Edges and their widths, the widest first.
  function widestFirst(scene) {
    const edges = edgesOf(scene), widths = widthsOf(scene, edges), order = widths.map((_, e) => e).sort((a, b) => widths[b] - widths[a]);
    const sorted = new Uint32Array(edges.length);
    order.forEach((e, i) => sorted.set(edges.subarray(EDGE * e, EDGE * (e + 1)), EDGE * i));
    return { edges: sorted, widths: order.map((e) => widths[e]) };
  }

  // How many of these numbers, the largest first, are at least so large.
  function countAtLeast(numbers, least) {
    let low = 0, high = numbers.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (numbers[middle] >= least) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  class CellEdges {
    constructor(scene, isObstacle, clipping) {
      Object.assign(this, { scene, ...widestFirst(scene), count: 0, last: null });
      const geometry = carom.changingGeometry((2 * this.edges.length) / EDGE, { position: 3 });
      this.position = geometry.attributes.position;
      const material = new THREE.LineBasicMaterial({ color: isObstacle ? 0x808080 : 0x000000, transparent: true, opacity: isObstacle ? 0.6 : 0.35, clippingPlanes: clipping });
      this.object = new THREE.LineSegments(geometry, material);
      this.object.frustumCulled = false;
    }

    // Those of cells that are at least a few pixels wide, where a length of one has so many.
    zoom(pixels) {
      const { count } = this;
      this.count = countAtLeast(this.widths, LEAST / pixels);
      this.object.geometry.setDrawRange(0, 2 * this.count);
      if (this.count > count && this.last) this.show(...this.last);
    }

    // Of the parts that are not hidden, with nodes at these places.
    show(at, frame, hidden, visible) {
      this.last = [at, frame, hidden, visible];
      this.object.visible = visible;
      if (!visible) return;
      const line = this.position.array, { edges, scene } = this;
      for (let e = 0; e < this.count; e++) {
        const n = EDGE * e, isHidden = hidden.has(edges[n + 2]) || (scene.changes && (frame < edges[n + 3] || frame >= edges[n + 4]));
        for (let a = 0; a < 2; a++)
          for (let c = 0; c < 3; c++) line[6 * e + 3 * a + c] = at[c][edges[n + (isHidden ? 0 : a)]];
      }
      this.position.needsUpdate = true;
    }
  }

  return Object.assign(CellEdges, { edgesOf, widestFirst, countAtLeast, widthOf, LEAST });
})();
