// Runs scripts of the page in Node.js, and makes what they are tried on.
"use strict";
const assert = require("node:assert/strict");
const fs = require("node:fs");
const path = require("node:path");
const vm = require("node:vm");

// Runs these scripts one after the other, as a page does; what they have made.
function load(...names) {
  for (const name of ["cursor", ...names]) {
    const file = path.join(__dirname, "../../src/report/scripts", name + ".js");
    vm.runInThisContext(fs.readFileSync(file, "utf8"), { filename: file });
  }
  return vm.runInThisContext("carom");
}

// three.js with its controls, which ask the page for nothing but to be told of its events.
function loadThree() {
  const folder = process.env.CAROM_THREE_DIR || "/usr/share/javascript/three";
  globalThis.THREE = require(path.join(folder, "three.min.js"));
  const controls = path.join(folder, "examples/js/controls/OrbitControls.js");
  globalThis.window = { addEventListener() {} };
  vm.runInThisContext(fs.readFileSync(controls, "utf8"), { filename: controls });
}

// A field of a scene; values[component][frame][node or cell].
function fieldOf(name, values, more) {
  const ranges = values.map((frames) => [Math.min(...frames.flat()), Math.max(...frames.flat())]);
  return { name, label: name, at: "node", unit: "", power: 0, components: ["x", "y", "z"].slice(0, values.length), ranges,
    value: (component, frame, i) => values[component][frame][i], ...more };
}

// A scene of nodes [x, y, z] and triangles of them, each with a cell of its own; in part 0, all edges those of cells.
function sceneOf(nodes, triangles, fields = [], more = {}) {
  return { at: [0, 1, 2].map((c) => nodes.map((x) => x[c])), nodes: nodes.length, cells: triangles.length, triangles: triangles.length,
    node: [0, 1, 2].map((a) => triangles.map((t) => t[a])), cell: triangles.map((_, k) => k), part: triangles.map(() => 0),
    edges: triangles.map(() => 7), frames: 1, parts: ["body"], fields, field: (name) => fields.find((f) => f.name === name),
    isSeen: () => true, ...more };
}

// Numbers of which each differs by no more than this from what is expected.
function assertNear(found, expected, tolerance) {
  assert.equal(found.length, expected.length);
  found.forEach((x, i) => assert.ok(Math.abs(x - expected[i]) <= tolerance, `[${found}] is not [${expected}]`));
}

module.exports = { load, loadThree, fieldOf, sceneOf, assertNear };
