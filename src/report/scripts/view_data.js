// What deflate and base64 have made small (src/view/packed_arrays.hpp), as a Response.
carom.inflate = function (text) {
  "use strict";
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i++) bytes[i] = letters.charCodeAt(i);
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate")));
};

// A library that the page holds in an element, run as a script of the page.
carom.load = async function (id) {
  "use strict";
  const text = await carom.inflate(document.getElementById(id).textContent).text();
  document.head.append(Object.assign(document.createElement("script"), { textContent: text }));
};

// The arrays of a view, read back into its scenes.
carom.unpack = (function () {
  "use strict";

  class Reader {
    constructor(bytes) {
      this.bytes = bytes;
      this.at = 0;
    }
    // `count` numbers of `width` bytes: differences to `earlier`, or to the number before.
    numbers(count, width, earlier) {
      const out = new (width === 4 ? Uint32Array : width === 2 ? Uint16Array : Uint8Array)(count);
      const { bytes, at } = this;
      for (let i = 0; i < count; i++) {
        let folded = 0;
        for (let b = 0; b < width; b++) folded |= bytes[at + b * count + i] << (8 * b);
        const difference = (folded >>> 1) ^ -(folded & 1);
        out[i] = (earlier ? earlier[i] : i > 0 ? out[i - 1] : 0) + difference;
      }
      this.at += count * width;
      return out;
    }
  }

  // values[component][time]: whole numbers; value() is what they stand for, NaN where there is none. The number next to
  // zero stands for zero, which is between two of them as a rule: what is at rest has no speed.
  function readField(reader, field, scene) {
    const count = field.at === "cell" ? scene.cells : scene.nodes;
    const none = 2 ** field.bits - 1;
    field.values = field.ranges.map(() => {
      const frames = [];
      for (let t = 0; t < scene.frames; t++) frames.push(reader.numbers(count, 2, frames[t - 1]));
      return frames;
    });
    field.value = (component, frame, i) => {
      const [low, high] = field.ranges[component], step = (high - low) / (none - 1);
      const number = field.values[component][Math.min(frame, scene.frames - 1)][i], value = low + step * number;
      return number === none ? NaN : Math.abs(value) < 0.5 * step ? 0 : value;
    };
  }

  function readScene(reader, scene) {
    scene.at = scene.reference.map(([low, high]) => {
      const numbers = reader.numbers(scene.nodes, 2);
      return Float32Array.from(numbers, (n) => low + ((high - low) * n) / 65534);
    });
    if (scene.numbered) {
      scene.nodeNumber = reader.numbers(scene.nodes, 4);
      scene.cellNumber = reader.numbers(scene.cells, 4);
    }
    scene.part = reader.numbers(scene.cells, 2);
    scene.node = [0, 1, 2].map(() => reader.numbers(scene.triangles, 4));
    scene.cell = reader.numbers(scene.triangles, 4);
    scene.edges = reader.numbers(scene.triangles, 1);
    // Of every triangle, the first frame in which it is seen, and the first after that in which it is not.
    if (scene.changes) [scene.from, scene.until] = [0, 1].map(() => reader.numbers(scene.triangles, 2));
    scene.isSeen = (k, frame) => !scene.changes || (scene.from[k] <= frame && frame < scene.until[k]);
    for (const field of scene.fields) readField(reader, field, scene);
    scene.field = (name) => scene.fields.find((f) => f.name === name);
  }

  return async function (view) {
    const reader = new Reader(new Uint8Array(await carom.inflate(view.data).arrayBuffer()));
    for (const scene of view.scenes) readScene(reader, scene);
    return view;
  };
})();
