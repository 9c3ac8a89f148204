// Where things are on the picture: the eye, what is cut off, the axes, the picture without WebGL.
"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const { load, loadThree, fieldOf, sceneOf, assertNear } = require("./page.js");
loadThree();
globalThis.document = {};
const carom = load("elements", "numbers", "view_position", "view_scale", "view_means", "view_field", "view_buffers", "view_edges", "view_fill", "view_mirror",
  "view_camera", "view_drawing", "view_still", "view_overlay");
const { directions, frustum } = carom.ViewCamera;

// A ball of radius 2 about (1, 2, 3).
const extent = { low: [0, 0, 0], high: [2, 4, 6], centre: [1, 2, 3], reach: 2, isPlane: false };
const ROUNDING = 1e-12;  // some operations on numbers up to 40 (the eye's distance), 20 times their rounding

function eyeOf(of = extent, turned = () => {}) {
  const eye = new carom.ViewCamera(of, { addEventListener() {} }, turned);
  eye.resize(2);
  return eye;
}

function onPicture(eye, place) {
  eye.camera.updateMatrixWorld();
  return new THREE.Vector3(...place).project(eye.camera).toArray().slice(0, 2);
}

test("the picture holds the ball with a margin of 5 %, in the smaller of its sides", () => {
  assert.deepEqual(frustum(2, 2), { left: -4.2, right: 4.2, top: 2.1, bottom: -2.1 });
  assert.deepEqual(frustum(2, 0.5), { left: -2.1, right: 2.1, top: 4.2, bottom: -4.2 });
});

test("seen along y, x goes to the right and z upward; from above, y goes upward", () => {
  const eye = eyeOf();
  eye.look(directions(false).y);
  assertNear(onPicture(eye, [1, 2, 3]), [0, 0], ROUNDING);
  assertNear(onPicture(eye, [2, 9, 3]), [1 / 4.2, 0], ROUNDING);
  assertNear(onPicture(eye, [1, 9, 4]), [0, 1 / 2.1], ROUNDING);
  eye.look(directions(false).z);
  assertNear(onPicture(eye, [2, 3, 3]), [1 / 4.2, 1 / 2.1], 2e-6);  // the eye is 1e-6 off the upright
});

test("bodies in a plane are seen from above, y upward, and turned about that", () => {
  const eye = eyeOf({ ...extent, isPlane: true });
  eye.look(directions(true).z);
  assertNear(onPicture(eye, [2, 3, 3]), [1 / 4.2, 1 / 2.1], ROUNDING);
  eye.turn(0.3, 0);
  assertNear(eye.away().toArray(), [Math.sin(0.3), 0, Math.cos(0.3)].map((x) => 20 * extent.reach * x), ROUNDING * 40);
});

test("zooming makes the picture larger about what is looked at, looking anew undoes it", () => {
  let told = 0;
  const eye = eyeOf(extent, () => told++);
  eye.look(directions(false).y);
  const before = told;
  eye.zoom(1.5);
  assert.equal(told, before + 1);
  assertNear(onPicture(eye, [2, 2, 3]), [1.5 / 4.2, 0], ROUNDING);
  eye.fit(extent);
  assertNear(onPicture(eye, [2, 2, 3]), [1 / 4.2, 0], ROUNDING);
});

test("points that are known are fitted: their middle in the middle, the farthest a twentieth from the edge", () => {
  const eye = eyeOf(), points = [[1, 9, 3], [3, -9, 4]];  // seen along y, 2 wide and 1 high on a picture twice as wide as high
  eye.look(directions(false).y);
  eye.fit({ ...extent, points });
  assertNear(onPicture(eye, points[0]), [-1 / 1.1, -1 / 1.1], ROUNDING);
  assertNear(onPicture(eye, points[1]), [1 / 1.1, 1 / 1.1], ROUNDING);
  assert.equal(eye.extent.isPlane, false);
  eye.fit({ ...extent, points: [[1, 2, 3]] });
  assert.equal(eye.camera.zoom, 1);  // a single point has no size
});

test("the eye goes with what is looked at, and looks at it from elsewhere then", () => {
  const eye = eyeOf(), points = [[1, 9, 3], [3, -9, 4]];
  eye.look(directions(false).y);
  eye.fit({ ...extent, points });
  eye.shift([5, 6, 7]);
  for (const again of [() => {}, () => eye.look(directions(false).y)]) {
    again();
    assertNear(onPicture(eye, [6, 15, 10]), [-1 / 1.1, -1 / 1.1], 10 * ROUNDING);
    assertNear(onPicture(eye, [8, -3, 11]), [1 / 1.1, 1 / 1.1], 10 * ROUNDING);
  }
});

test("the eye is outside of all that is there, also when it looks at a small part", () => {
  const eye = eyeOf();
  eye.fit({ ...extent, reach: 0.01 });
  assert.equal(eye.distance, 6);
  assert.equal(eye.pixels(100), 100 / 0.021);  // the height of the picture is 2.1 reaches
});

test("turning goes about the upright axis and over the horizontal one", () => {
  const eye = eyeOf(), distance = 20 * extent.reach;
  eye.look(directions(false).x);
  eye.turn(0.3, 0);
  assertNear(eye.away().toArray(), [Math.cos(0.3), Math.sin(0.3), 0].map((x) => distance * x), ROUNDING * distance);
  eye.look(directions(false).x);
  eye.turn(0, -0.2);  // the key up: the eye goes up
  assertNear(eye.away().toArray(), [Math.cos(0.2), 0, Math.sin(0.2)].map((x) => distance * x), ROUNDING * distance);
});

test("one eye follows another with its direction and zoom, at its own distance", () => {
  const leader = eyeOf(), follower = eyeOf({ ...extent, centre: [0, 0, 0], reach: 5 });
  follower.look(directions(false).x);
  leader.look([0, -3, 4]);
  leader.zoom(2);
  follower.follow(leader);
  assertNear(follower.away().toArray(), [0, -60, 80], ROUNDING * 100);
  assert.equal(follower.camera.zoom, 2);
});

test("a cut leaves the lower half, or the other one", () => {
  // A quarter of the way along y, from 0 to 4: at 1.
  const lower = carom.Drawing.cuttingPlane(extent, 1, 0.25, false), upper = carom.Drawing.cuttingPlane(extent, 1, 0.25, true);
  for (const [y, distance] of [[0, 1], [1, 0], [3, -2]]) {
    assert.equal(lower.distanceToPoint(new THREE.Vector3(9, y, -9)), distance);
    assert.equal(upper.distanceToPoint(new THREE.Vector3(9, y, -9)), 0 - distance);
  }
});

test("obstacles are cropped a little beyond a box", () => {
  const [low, high] = carom.Drawing.croppingPlanes({ low: [0, 1, 0], high: [0, 3, 0], reach: 2 }, 1);
  for (const [y, ...distances] of [[-0.2, 0, 4.4], [2, 2.2, 2.2], [4.2, 4.4, 0]])
    assertNear([low, high].map((plane) => plane.distanceToPoint(new THREE.Vector3(7, y, 7))), distances, 1e-12);
});

test("a legend has the power of ten that its numbers need, and says what is marked", () => {
  const field = fieldOf("f", [[[0, 1.186e-5, 3]]], { colours: "range", unit: "MPa", power: 6 });
  const colouring = new carom.Colouring(sceneOf([[0, 0, 0], [0, 0, 0], [0, 0, 0]], [], [field]), field, 0);
  colouring.scale.cover([0, 11.86]);  // Pa
  const legend = carom.Overlay.legendOf(colouring, "stress", 0);
  assert.equal(legend.title, "stress [10⁻⁶ MPa]");
  assert.deepEqual(legend.ticks.map(({ text }) => text), ["10", "8", "6", "4", "2", "0"]);
  assertNear([legend.ticks[0].share], [10 / 11.86], 1e-15);
  assert.equal(legend.above, "");
  colouring.scale.limit = 2;
  assert.equal(carom.Overlay.legendOf(colouring, "stress", 0).above, "1 node above 2 · 10⁻⁶");
  assert.equal(carom.Overlay.legendOf(new carom.Colouring(colouring.scene), "parts", 0), null);
});

// A tetrahedron; its faces are the triangles.
const TETRAHEDRON = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]];
const closed = (triangles, part) => carom.CutFill.closedGroups(sceneOf(Array.from({ length: 8 }, () => [0, 0, 0]), triangles, [], { part }));

test("closed surfaces are filled where they are cut: by themselves, or together with those whose faces they share", () => {
  const other = TETRAHEDRON.map((t) => t.map((n) => n + 4)), bar = [[0, 4, 4]];
  const two = closed([...TETRAHEDRON, ...other, ...bar], [0, 0, 0, 0, 1, 1, 1, 1, 2]);
  assert.deepEqual(two.map(({ parts, triangles }) => [parts, triangles]), [[[0], [0, 1, 2, 3]], [[1], [4, 5, 6, 7]]]);
  assert.deepEqual(closed(TETRAHEDRON, [0, 0, 1, 1]).map((g) => g.parts), [[0, 1]]);  // neither is closed without the other
  assert.deepEqual(closed(TETRAHEDRON.slice(1), [0, 0, 0]), []);
});

test("the axes point as those of the bodies do, the farthest first", () => {
  const eye = eyeOf();
  eye.look(directions(false).y);
  eye.camera.updateMatrixWorld();
  const lines = carom.Overlay.axisLines(new THREE.Matrix4().extractRotation(eye.camera.matrixWorldInverse));
  const of = (name) => lines.find((l) => l.name === name);
  assertNear([of("x").x, of("x").y, of("x").tx], [54, 32, 61], ROUNDING * 64);
  assertNear([of("z").x, of("z").y, of("z").ty], [32, 10, 3], ROUNDING * 64);
  assertNear([of("y").x, of("y").y, of("y").depth], [32, 32, -1], ROUNDING * 64);
  assert.equal(lines[0].name, "y");
});

test("the eye of the still picture stands before, right of and above the bodies", () => {
  const [right, up, eye] = carom.StillDrawing.axes(false);
  const dot = (a, b) => a.reduce((sum, x, c) => sum + x * b[c], 0);
  for (const a of [right, up, eye]) assertNear([dot(a, a)], [1], 1e-15);
  assertNear([dot(right, up), dot(up, eye), dot(eye, right), right[2]], [0, 0, 0, 0], 1e-15);
  assert.ok(up[2] > 0);
  assertNear(eye.map((x) => x / eye[0]), directions(false).iso, 1e-15);
});

// Two right-angled triangles across the eye of a plane picture, the second 1 nearer.
const triangles = (more) => sceneOf([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]], [[0, 1, 2], [3, 4, 5]], more && more.fields, more);
const plane = { centre: [1, 1, 0], isPlane: true };

test("triangles of the still picture are about its centre, as bright as they face the eye", () => {
  const scene = triangles({ part: [0, 1] }), colouring = new carom.Colouring(scene);
  const faces = carom.StillDrawing.facesOf({ scene, isObstacle: false, hidden: new Set() }, { frame: 0, scale: 1, colouring }, plane);
  assert.deepEqual(faces[0].xy, [[-1, -1], [0, -1], [-1, 0]]);
  assert.deepEqual(faces.map((face) => face.depth), [0, 3]);
  // Twice the area is 1, the square of the longest side 2: 0.65 + 0.35 / 2 of the part's colour.
  const shaded = colouring.colour(0, 1).map((x) => Math.round(0.825 * x));
  assert.equal(faces[1].colour, `rgb(${shaded})`);
});

test("hidden parts, triangles that are not seen and values of obstacles are left out of it", () => {
  const field = fieldOf("f", [[[0, 6, 0, 6, 6, 6]]], { colours: "range" });
  const scene = triangles({ part: [0, 1], fields: [field], isSeen: (k, frame) => k === 0 || frame > 0 });
  const colouring = new carom.Colouring(scene, field, 0);
  const faces = (isObstacle, hidden, frame) => carom.StillDrawing.facesOf({ scene, isObstacle, hidden: new Set(hidden) }, { frame, scale: 1, colouring }, plane);
  assert.equal(faces(false, [0], 0).length, 0);
  const shaded = (rgb) => `rgb(${rgb.map((x) => Math.round(0.825 * x))})`;
  assert.deepEqual(faces(false, [], 0).map((face) => face.colour), [shaded(colouring.colour(1 / 3))]);  // the mean of 0, 6, 0
  assert.deepEqual(faces(true, [], 0).map((face) => face.colour), [shaded(carom.ColourScale.palettes.none)]);
});
