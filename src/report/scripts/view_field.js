// What a view is coloured by: one number per node or cell, its range and its colours.
carom.Colouring = (function () {
  "use strict";
  const LENGTH = -1, VON_MISES = -2;  // in place of a component

  // Stops of viridis (S. van der Walt, N. Smith, 2015) and of a blue - white - red scale for numbers of both signs.
  const VIRIDIS = ["440154", "482475", "414487", "355f8d", "2a788e", "21918c", "22a884", "44bf70", "7ad151", "bddf26", "fde725"];
  const BOTH_SIGNS = ["2c4fa0", "5b83c4", "9cb8dd", "d8e1ec", "f2f2f0", "f0d6cb", "e0a085", "c8604c", "a3262b"];
  const PARTS = ["6f9fd0", "d99a6c", "79b894", "b08fc0", "cbb45f", "79b3c2", "c9839f", "9aa0a6"];

  const rgb = (hex) => [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16));
  function table(stops, count) {
    const colours = stops.map(rgb);
    return Array.from({ length: count }, (_, i) => {
      const x = (i / (count - 1)) * (stops.length - 1);
      const k = Math.min(Math.floor(x), stops.length - 2);
      return [0, 1, 2].map((c) => Math.round(colours[k][c] + (x - k) * (colours[k + 1][c] - colours[k][c])));
    });
  }
  const palettes = { viridis: table(VIRIDIS, 256), signed: table(BOTH_SIGNS, 256), parts: PARTS.map(rgb), none: rgb("9aa4ac") };

  // One colour for each of the whole numbers from 0 to this one.
  const steps = (last) => Array.from({ length: 256 }, (_, i) => palettes.parts[Math.round((i / 255) * last) % palettes.parts.length]);

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
      Object.assign(this, { scene, field, component });
      this.cover(field ? this.rangeOver(scene.frames) : [0, 0]);
    }

    // The colours go from one of these numbers to the other, or as the field wants it: from zero, about zero (which all
    // numbers of both signs are), or one for each whole number.
    cover([low, high]) {
      const wanted = !this.field ? "range" : this.component < 0 ? "from_zero" : this.field.colours;
      const isSigned = wanted === "both_signs" || (low < 0 && high > 0), most = Math.max(-low, high);
      this.covered = [low, high];
      if (wanted === "from_zero" || wanted === "categories") low = Math.min(0, low);
      this.range = isSigned ? [-most, most] : [low, high];
      this.palette = wanted === "categories" ? steps(high) : isSigned ? palettes.signed : palettes.viridis;
    }

    // The numbers of a legend, the largest first.
    ticks() {
      const [low, high] = this.range, count = this.field.colours === "categories" ? high : 4;
      return Array.from({ length: count + 1 }, (_, i) => high - (i * (high - low)) / Math.max(1, count));
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

    rangeOver(frames) {
      if (this.component >= 0) return this.field.ranges[this.component];
      const count = this.field.at === "cell" ? this.scene.cells : this.scene.nodes;
      let low = Infinity, high = -Infinity;
      for (let t = 0; t < frames; t++) {
        for (let i = 0; i < count; i++) {
          const v = this.value(t, i);
          if (v < low) low = v;
          if (v > high) high = v;
        }
      }
      return low <= high ? [low, high] : [0, 0];
    }

    // Of every node or cell, its place between the ends of the range; -1 where there is no value.
    places(frame) {
      const count = this.field.at === "cell" ? this.scene.cells : this.scene.nodes;
      const out = new Float32Array(count);
      const [low, high] = this.range, width = high > low ? high - low : 1;
      for (let i = 0; i < count; i++) {
        const v = this.value(frame, i);
        out[i] = Number.isNaN(v) ? -1 : Math.min(1, Math.max(0, (v - low) / width));
      }
      return out;
    }

    colour(place, part) {
      if (!this.field) return palettes.parts[part % palettes.parts.length];
      return place < 0 ? palettes.none : this.palette[Math.round(place * 255)];
    }
  }

  Colouring.choices = choices;
  Colouring.palettes = palettes;
  return Colouring;
})();

