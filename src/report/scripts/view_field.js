// What a view is coloured by: one number per node or cell, and its colours.
carom.Colouring = (function () {
  "use strict";
  const LENGTH = -1, VON_MISES = -2;  // in place of a component
  const { palettes } = carom.ColourScale;

  // What may be chosen of a field: its length, its components.
  function choices(scene, field) {
    if (field.ranges.length === 1) return [{ component: 0, label: field.label }];
    const parts = field.components.map((name, component) => ({ component, label: field.label + " " + name }));
    if (field.name === "stress" && !scene.field("von_mises")) return [{ component: VON_MISES, label: "von Mises stress" }, ...parts];
    if (field.components[0] !== "x") return parts;
    return [{ component: LENGTH, label: field.name === "velocity" ? "speed" : field.label + ", length" }, ...parts];
  }

  class Colouring {
    // Without a field every part has its colour.
    constructor(scene, field, component) {
      Object.assign(this, { scene, field, component, isSmooth: false });
      this.scale = new carom.ColourScale(!field ? "range" : component < 0 ? "from_zero" : field.colours);
      this.ofAllTimes = field ? this.rangeOfAllTimes() : [0, 0];
      this.scale.cover(this.ofAllTimes);
    }

    get isAtCells() {
      return Boolean(this.field) && this.field.at === "cell";
    }

    value(frame, i) {
      if (this.component >= 0) return this.field.value(this.component, frame, i);
      if (this.component === VON_MISES) {
        const [xx, yy, zz, xy, yz, zx] = this.field.ranges.map((_, c) => this.field.value(c, frame, i));
        return Math.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (xy ** 2 + yz ** 2 + zx ** 2));
      }
      let sum = 0;
      for (let c = 0; c < this.field.ranges.length; c++) sum += this.field.value(c, frame, i) ** 2;
      return Math.sqrt(sum);
    }

    // Of every node or cell.
    values(frame) {
      const values = new Float32Array(this.isAtCells ? this.scene.cells : this.scene.nodes);
      for (let i = 0; i < values.length; i++) values[i] = this.value(frame, i);
      return values;
    }

    rangeOfAllTimes() {
      if (this.component >= 0) return this.field.ranges[this.component];
      let ends = [Infinity, -Infinity];
      for (let t = 0; t < this.scene.frames; t++) ends = this.values(t).reduce(([low, high], v) => [v < low ? v : low, v > high ? v : high], ends);
      return ends[0] <= ends[1] ? ends : [0, 0];
    }

    // The frame in which the largest magnitude is found, the first of several; this one where all are zero.
    largestFrame(none) {
      const largest = Array.from({ length: this.scene.frames }, (_, t) => this.values(t).reduce((most, v) => (Math.abs(v) > most ? Math.abs(v) : most), 0));
      const most = Math.max(...largest);
      return most > 0 ? largest.indexOf(most) : none;
    }

    // By triangle, the values at its three corners: of cells, of nodes, or smooth means of cells.
    corners(frame) {
      const { scene } = this, values = this.values(frame), out = new Float32Array(3 * scene.triangles);
      const means = this.isAtCells && this.isSmooth ? carom.NodeMeans.of(scene) : null, smooth = means && means.of(values);
      for (let k = 0; k < scene.triangles; k++)
        for (let a = 0; a < 3; a++) out[3 * k + a] = means ? smooth[means.corner[3 * k + a]] : values[this.isAtCells ? scene.cell[k] : scene.node[a][k]];
      return out;
    }

    // The ends of the values of the triangles that are asked for; null where they have none.
    rangeAmong(frame, isWanted) {
      const corners = this.corners(frame);
      let low = Infinity, high = -Infinity;
      for (let k = 0; k < this.scene.triangles; k++) {
        if (!isWanted(k)) continue;
        for (let v = 3 * k; v < 3 * k + 3; v++) {
          if (corners[v] < low) low = corners[v];
          if (corners[v] > high) high = corners[v];
        }
      }
      return low <= high ? [low, high] : null;
    }

    // The corners' places on the scale (ColourScale.place). A triangle of which one corner has no value or is above the
    // limit is drawn so as a whole: between such colours there is nothing.
    places(frame) {
      const places = this.corners(frame).map((v) => this.scale.place(v));
      for (let v = 0; v < places.length; v += 3) {
        const three = places.subarray(v, v + 3);
        if (three.includes(-1)) three.fill(-1);
        else if (three.includes(2)) three.fill(2);
      }
      return places;
    }

    colour(place, part) {
      return this.field ? this.scale.colour(place) : palettes.parts[part % palettes.parts.length];
    }
  }

  return Object.assign(Colouring, { choices });
})();
