// Values of cells averaged at the nodes of the surface, part by part: between two materials a field may jump.
carom.NodeMeans = (function () {
  "use strict";

  class NodeMeans {
    constructor(scene) {
      const places = new Map(), cells = [];
      this.corner = new Uint32Array(3 * scene.triangles);  // of each triangle's corners, the mean that it has
      for (let k = 0; k < scene.triangles; k++) {
        const cell = scene.cell[k];
        for (let a = 0; a < 3; a++) {
          const key = scene.part[cell] * scene.nodes + scene.node[a][k];
          if (!places.has(key)) places.set(key, cells.push(new Set()) - 1);
          cells[places.get(key)].add(cell);
          this.corner[3 * k + a] = places.get(key);
        }
      }
      this.cells = cells.map((set) => Uint32Array.from(set));
    }

    // The means of what the cells have; a cell without a value does not count, NaN is where none has one.
    of(values) {
      return Float32Array.from(this.cells, (cells) => {
        let sum = 0, count = 0;
        for (const cell of cells) {
          if (Number.isNaN(values[cell])) continue;
          sum += values[cell];
          count++;
        }
        return sum / count;
      });
    }
  }

  const known = new WeakMap();
  // Of a scene, made when it is wanted for the first time.
  NodeMeans.of = function (scene) {
    if (!known.has(scene)) known.set(scene, new NodeMeans(scene));
    return known.get(scene);
  };
  return NodeMeans;
})();
