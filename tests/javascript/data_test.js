// Arrays that src/view/packed_arrays.hpp has packed, read back.
"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const zlib = require("node:zlib");
const { load, assertNear } = require("./page.js");
const carom = load("view_data");

const base64 = (bytes) => zlib.deflateSync(Buffer.from(bytes)).toString("base64");

// Bytes of whole numbers as that header says: differences to `earlier` or to the number before (as signed numbers of
// that width), folded, low bytes first.
function packed(numbers, width, earlier) {
  const folded = numbers.map((x, i) => {
    const full = 256 ** width, before = earlier ? earlier[i] : i > 0 ? numbers[i - 1] : 0;
    const d = ((x - before + 1.5 * full) % full) - full / 2;
    return d >= 0 ? 2 * d : -2 * d - 1;
  });
  return Array.from({ length: width }, (_, b) => folded.map((f) => Math.floor(f / 256 ** b) % 256)).flat();
}

// Three nodes and one triangle, two frames: all arrays in the order in which a scene has them.
function sceneBytes() {
  const first = [0, 65534, 65535], second = [65534, 0, 32767];
  return [
    packed([0, 65534, 32767], 2), packed([0, 0, 0], 2), packed([65534, 0, 0], 2),  // places
    packed([70000, 1, 2], 4), packed([9], 4),  // numbers of nodes and of the cell
    packed([0], 2), packed([0], 4), packed([1], 4), packed([2], 4), packed([0], 4), packed([5], 1),  // part, nodes, cell, edges
    packed([1], 2), packed([2], 2),  // from and until
    packed(first, 2), packed(second, 2, first),
  ].flat();
}

async function unpacked() {
  const field = { name: "pressure", at: "node", bits: 16, ranges: [[-1, 3]] };
  const scene = { nodes: 3, cells: 1, triangles: 1, frames: 2, numbered: true, changes: true, fields: [field],
    reference: [[10, 20], [5, 5], [-1, 1]] };
  return (await carom.unpack({ scenes: [scene], data: base64(sceneBytes()) })).scenes[0];
}

test("a text is inflated", async () => {
  assert.equal(await (await carom.inflate(base64("carom, µs"))).text(), "carom, µs");
});

test("places stand between the ends of their range", async () => {
  const scene = await unpacked();
  // 32767 of 65534 is the middle. Places are single precision: 20 to 1e-6.
  assertNear([...scene.at[0]], [10, 20, 15], 1e-6);
  assertNear([...scene.at[1]], [5, 5, 5], 0);
  assertNear([...scene.at[2]], [1, -1, -1], 0);
});

test("whole numbers of one, two and four bytes are what they were", async () => {
  const scene = await unpacked();
  assert.deepEqual([...scene.nodeNumber], [70000, 1, 2]);
  assert.deepEqual([...scene.cellNumber], [9]);
  assert.deepEqual(scene.node.map((corner) => [...corner]), [[0], [1], [2]]);
  assert.deepEqual([...scene.edges], [5]);
});

test("values have the ends of their range, and the highest number for none", async () => {
  const scene = await unpacked(), { value } = scene.field("pressure");
  assert.deepEqual([0, 1, 2].map((i) => value(0, 0, i)), [-1, 3, NaN]);
  assert.deepEqual([0, 1, 2].map((i) => value(0, 1, i)), [3, -1, 1]);
  assert.equal(value(0, 7, 0), 3);  // beyond the last frame of the scene it stays as it is
});

test("the number next to zero stands for zero", async () => {
  const field = { name: "speed", at: "node", bits: 16, ranges: [[-1, 2.0001]] };
  const scene = { nodes: 3, cells: 0, triangles: 0, frames: 1, numbered: false, changes: false, fields: [field], reference: [[0, 1], [0, 1], [0, 1]] };
  const places = packed([0, 0, 0], 2), zero = Math.round(65534 / 3.0001);
  const bytes = [...places, ...places, ...places, ...packed([zero, zero + 1, 0], 2)];
  await carom.unpack({ scenes: [scene], data: base64(bytes) });
  assert.equal(scene.field("speed").value(0, 0, 0), 0);
  assert.notEqual(scene.field("speed").value(0, 0, 1), 0);
  assert.equal(scene.field("speed").value(0, 0, 2), -1);
});

test("a triangle is seen from its first frame until it goes", async () => {
  const scene = await unpacked();
  assert.deepEqual([0, 1, 2].map((frame) => scene.isSeen(0, frame)), [false, true, false]);
});
