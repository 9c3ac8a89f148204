// Where the nodes of a scene are, and its edges.
"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const { load, loadThree, fieldOf, sceneOf, assertNear } = require("./page.js");
loadThree();
const carom = load("view_position", "view_scale", "view_means", "view_field", "view_buffers", "view_edges", "view_mirror", "view_arrows");

// Two nodes; the second moves by (1, 0, 2) in the second frame, the first goes.
const moved = sceneOf([[0, 0, 0], [3, 4, 0]], [], [fieldOf("displacement", [[[0, 0], [NaN, 1]], [[0, 0], [NaN, 0]], [[0, 0], [NaN, 2]]])], { frames: 2 });

test("a node is at its reference and its displacement times a scale", () => {
  assert.deepEqual(carom.positionOf(moved, 1, 1), [4, 4, 2]);
  assert.deepEqual(carom.positionOf(moved, 1, 1, 10), [13, 4, 20]);
  assert.deepEqual(carom.positionOf(moved, 1, 0), [NaN, NaN, NaN]);
  assert.deepEqual(carom.positions(moved, 1, 2), [[0, 5], [0, 4], [0, 4]]);
  assert.deepEqual(carom.positions(sceneOf([[1, 2, 3]], []), 0, 5), [[1], [2], [3]]);
});

test("the extent is that of all times", () => {
  const { low, high, centre, reach, isPlane } = carom.extentOf(moved);
  assert.deepEqual([low, high, centre], [[0, 0, 0], [4, 4, 2], [2, 2, 1]]);
  assert.equal(reach, 3);  // half of sqrt(16 + 16 + 4)
  assert.equal(isPlane, false);
});

test("bodies in a plane are seen as that, a single node from a distance", () => {
  const flat = carom.extentOf(sceneOf([[0, 0, 1], [6, 8, 1]], []));
  assert.equal(flat.isPlane, true);
  assert.equal(flat.reach, 5);
  assert.equal(carom.extentOf(sceneOf([[1, 1, 1]], [])).reach, 1);
});

// Two parts of two nodes each: one stays, the other goes by 8 in the second frame.
const thrown = sceneOf([[0, 0, 0], [1, 0, 0], [0, 0, 2], [1, 0, 2]], [[0, 1, 1], [2, 3, 3]],
  [fieldOf("displacement", [[[0, 0, 0, 0], [0, 0, 0, 0]], [[0, 0, 0, 0], [0, 0, 0, 0]], [[0, 0, 0, 0], [0.1, 0.1, 8, 8]]])], { part: [0, 1], frames: 2 });

test("parts move that go at least a twentieth as far as the one that goes farthest", () => {
  assert.deepEqual([...carom.movingParts(thrown)], [1]);
  assert.deepEqual([...carom.movingParts(sceneOf([[0, 0, 0], [1, 0, 0]], [[0, 1, 1]]))], [0]);
});

test("a picture is fitted to what moves, now where that is much smaller than all its way", () => {
  const moving = carom.movingParts(thrown), fit = (frame, hidden = []) => carom.fitOf(thrown, frame, 1, { hidden: new Set(hidden), moving });
  assert.deepEqual([fit(0).low, fit(0).high], [[0, 0, 2], [1, 0, 2]]);
  assert.deepEqual([fit(1).low, fit(1).high], [[0, 0, 10], [1, 0, 10]]);
  assert.deepEqual(fit(1).points, [[0, 0, 10], [1, 0, 10]]);
  // What is shown stays, so that nothing moves: all times are as large as now.
  assert.deepEqual([fit(0, [1]).low, fit(0, [1]).high], [[0, 0, 0], [1, 0, 0.1]]);
  assert.equal(fit(0, [0, 1]).reach, carom.fitOf(thrown, 0, 1, { hidden: new Set(), moving: new Set([0, 1]) }).reach);
});

test("a picture of what is small on its way goes with it, on the mean of the nodes that are there in both frames", () => {
  const moving = carom.movingParts(thrown), fit = (frame, hidden = []) => carom.fitOf(thrown, frame, 1, { hidden: new Set(hidden), moving });
  assert.deepEqual([fit(0).wayTo(1, 1), fit(0).wayTo(0, 1), fit(1).wayTo(0, 0.5)], [[0, 0, 8], [0, 0, 0], [0, 0, -4]]);
  assert.deepEqual(fit(0, [1]).wayTo(1, 1), [0, 0, 0]);  // what is shown hardly moves: the picture holds all of it
  const torn = sceneOf([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]],
    [fieldOf("displacement", [[[0, 0, 0], [20, 30, NaN]], [[0, 0, 0], [0, 0, NaN]], [[0, 0, 0], [0, 0, NaN]]])], { frames: 2 });
  assert.deepEqual(carom.fitOf(torn, 0, 1, { hidden: new Set(), moving: new Set([0]) }).wayTo(1, 1), [25, 0, 0]);
});

test("of many frames some are looked at, the ends among them, and all nodes of these", () => {
  const nodes = 4000, frames = 51, u = { name: "displacement", ranges: [[0, 50], [0, 0], [0, 0]], value: (c, t, n) => (c === 0 && n === 1 ? t : 0) };
  const places = Array.from({ length: nodes }, (_, n) => [n === 1 ? 100 : 0, 0, n % 2]);
  const scene = sceneOf(places, Array.from({ length: nodes - 2 }, (_, n) => [n, n + 1, n + 2]), [u], { frames });
  const { points } = carom.fitOf(scene, 0, 1, { hidden: new Set(), moving: new Set([0]) });
  assert.equal(points.length, 5 * nodes);  // of 20,000 at most
  assert.deepEqual([...new Set(points.map(([x]) => x))].filter((x) => x > 99), [100, 113, 125, 138, 150]);  // frames 0, 12.5, 25, ...
});

test("it is fitted to all the way where bodies fill a third of that", () => {
  const way = (far) => sceneOf([[0, 0, 0], [2, 0, 0]], [[0, 1, 1]], [fieldOf("displacement", [[[0, 0], [far, far]], [[0, 0], [0, 0]], [[0, 0], [0, 0]]])], { frames: 2 });
  const reach = (far) => carom.fitOf(way(far), 0, 1, { hidden: new Set(), moving: new Set([0]) }).reach;
  assert.deepEqual([reach(4), reach(4.1)], [3, 1]);  // 6 long of which the body has 2, and more
});

test("the frame next to a time is shown, the earlier of two", () => {
  const times = [0, 1, 4];
  assert.deepEqual([-1, 0.4, 0.5, 0.6, 2.5, 3, 9].map((t) => carom.nearestFrame(times, t)), [0, 0, 0, 1, 1, 2, 2]);
});

// A square of two triangles, whose common side (nodes 0 and 2) is an edge of no cell.
const square = (more) => sceneOf([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]], [], { edges: [3, 6], ...more });
const rowsOf = (numbers) => Array.from({ length: numbers.length / 5 }, (_, e) => [...numbers.slice(5 * e, 5 * e + 5)]);

test("the edges of a square are its four sides", () => {
  assert.deepEqual(rowsOf(carom.CellEdges.edgesOf(square())), [[0, 1, 0, 0, 1], [1, 2, 0, 0, 1], [2, 3, 0, 0, 1], [3, 0, 0, 0, 1]]);
});

test("an edge of two triangles stands once, seen as long as one of them", () => {
  const edges = rowsOf(carom.CellEdges.edgesOf(square({ edges: [4, 1], frames: 9, changes: true, from: [2, 0], until: [5, 3] })));
  assert.deepEqual(edges, [[2, 0, 0, 0, 5]]);
});

test("edges stand by the width of their cells, the widest first; bars are wider than all", () => {
  // Triangles of 3, 4, 5 and of a tenth of that, and a bar.
  const scene = sceneOf([[0, 0, 0], [3, 0, 0], [0, 4, 0], [9, 0, 0], [9.3, 0, 0], [9, 0.4, 0], [7, 7, 7]], [[3, 4, 5], [0, 1, 2], [6, 0, 0]], [], { edges: [7, 7, 1] });
  const { edges, widths } = carom.CellEdges.widestFirst(scene);
  assertNear(widths.slice(1), [2.4, 2.4, 2.4, 0.24, 0.24, 0.24], 1e-12);  // 3 x 4 / 5
  assert.equal(widths[0], Infinity);
  assert.deepEqual([...edges.slice(0, 2)], [6, 0]);
  assert.deepEqual([0.1, 0.3, 2.5].map((least) => carom.CellEdges.countAtLeast(widths, least)), [7, 4, 1]);
});

// A square of 1, which is pressed in x and gets wider in y: its left side and its lower one slide.
const quarter = () => {
  const ux = [[0, 0, 0, 0], [0, -0.1, -0.1, 0]], uy = [[0, 0, 0, 0], [0, 0, 0.05, 0.05]];
  const u = fieldOf("displacement", [ux, uy, [[0, 0, 0, 0], [0, 0, 0, 0]]]);
  return sceneOf([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]], [u], { frames: 2 });
};

test("bodies go on at an end whose nodes slide within its plane, not at one that is held or moves", () => {
  assert.deepEqual(carom.Mirrors.planesOf(quarter()).map(({ axis, at }) => [axis, at]), [[0, 0], [1, 0]]);
  // What does not move along x at all is not cut there, as what falls.
  const falling = sceneOf([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], [fieldOf("displacement", [[[0, 0, 0]], [[0, 0, 0]], [[1, 1, 1]]])]);
  assert.deepEqual(carom.Mirrors.planesOf(falling), []);
  // Between two planes both ends slide.
  const wide = sceneOf([[0, 0, 0], [0, 1, 0], [1, 0, 0], [2, 0, 0], [2, 1, 0]], [[0, 1, 2], [2, 3, 4]], [fieldOf("displacement", [[[0, 0, 0.1, 0, 0]], [[0, 0, 0, 0, 0]], [[1, 1, 1, 1, 1]]])]);
  assert.deepEqual(carom.Mirrors.planesOf(wide).map(({ name, at }) => [name, at]), [["low x", 0], ["high x", 2]]);
  const held = sceneOf([[0, 0, 0], [0, 1, 0], [1, 0, 0]], [[0, 1, 2]], [fieldOf("displacement", [[[0, 0, 1]], [[0, 0, 1]], [[0, 0, 0]]])]);
  assert.deepEqual(carom.Mirrors.planesOf(held), []);
  assert.deepEqual(carom.Mirrors.planesOf(sceneOf([[0, 0, 0]], [])), []);
});

test("two planes make three pictures", () => {
  const images = carom.Mirrors.imagesOf([{ axis: 0, at: 1 }, { axis: 1, at: 0 }]);
  const places = images.map((m) => new THREE.Vector3(3, 4, 5).applyMatrix4(m).toArray());
  assert.deepEqual(places, [[-1, 4, 5], [3, -4, 5], [-1, -4, 5]]);
});

test("a picture is fitted to mirrored halves as well, and obstacles are mirrored that end at the plane", () => {
  const wide = carom.Mirrors.widened({ low: [0, 0, 0], high: [2, 1, 0], points: [[2, 1, 0]], wayTo: () => [5, 6, 7] }, [{ axis: 0, at: 0 }]);
  assert.deepEqual([wide.low, wide.high, wide.centre], [[-2, 0, 0], [2, 1, 0], [0, 0.5, 0]]);
  assert.deepEqual(wide.points, [[2, 1, 0], [-2, 1, 0]]);
  assert.deepEqual(wide.wayTo(1, 1), [0, 6, 7]);  // the halves go apart along x
  const planes = [0, 1, 0.5].map((at) => ({ axis: 0, at }));
  assert.deepEqual(carom.Mirrors.oneSided(quarter(), planes).map(({ at }) => at), [0, 1]);
});

const end = (matrix, y) => new THREE.Vector3(0, y, 0).applyMatrix4(matrix).toArray();

test("an arrow ends at its node and is as long as it shall be", () => {
  for (const [force, direction] of [[[0, 0, -7], [0, 0, -1]], [[3, 4, 0], [0.6, 0.8, 0]], [[0, -2, 0], [0, -1, 0]]]) {
    const matrix = carom.ForceArrows.placeArrow(new THREE.Vector3(...force), new THREE.Vector3(1, 2, 3), 0.5, 1);
    assertNear(end(matrix, 1), [1, 2, 3], 1e-15 * 8);  // rounding of numbers up to 3, some operations
    assertNear(end(matrix, 0), [1, 2, 3].map((x, c) => x - 0.5 * direction[c]), 1e-15 * 8);
  }
});

test("a short arrow is a quarter of the longest thick, a long one in its own measure", () => {
  const widthOf = (length) => {
    const matrix = carom.ForceArrows.placeArrow(new THREE.Vector3(0, 1, 0), new THREE.Vector3(), length, 2);
    return new THREE.Vector3().setFromMatrixScale(matrix).toArray();
  };
  assertNear(widthOf(0.1), [0.5, 0.1, 0.5], 1e-15);
  assertNear(widthOf(2), [2, 2, 2], 1e-15);
});

test("arrows are made for the frame that has most of them", () => {
  const force = fieldOf("contact_force", [[[0, 0, 0], [3, 0, 1]], [[0, 0, 0], [4, 0, 0]], [[0, 0, 0], [0, 1e-4, 0]]]);
  const scene = sceneOf([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [], [force], { frames: 2 });
  const arrows = carom.ForceArrows.of(scene, []);
  assert.equal(arrows.largest, 5);  // (3, 4, 0)
  // 5 and 1; 1e-4 is below a thousandth of 5.
  arrows.show(1, scene.at, 1, true);
  assert.deepEqual(arrows.objects.map((o) => o.count), [2, 2]);
  arrows.show(0, scene.at, 1, true);
  assert.equal(arrows.objects[0].count, 0);
  // The tail of the force (3, 4, 0) stands the longest length behind its node.
  assertNear(arrows.tails(1, scene.at, 2)[0], [-1.2, -1.6, 0], 1e-12);
  assert.equal(arrows.tails(1, scene.at, 2).length, 2);
  assert.equal(carom.ForceArrows.of(sceneOf([[0, 0, 0]], []), []), null);
  const untouched = sceneOf([[0, 0, 0]], [], [fieldOf("contact_force", [[[0]], [[0]], [[0]]])]);
  assert.equal(carom.ForceArrows.of(untouched, []), null);
});
