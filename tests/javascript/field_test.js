// What a view is coloured by.
"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const { load, fieldOf, sceneOf, assertNear } = require("./page.js");
const carom = load("view_scale", "view_means", "view_field"), { Colouring, ColourScale } = carom;

const one = (values, more) => {
  const field = fieldOf("f", [[values]], { colours: "range", ...more });
  return new Colouring(sceneOf(values.map(() => [0, 0, 0]), [], [field]), field, 0);
};
const scaleOver = (range, more, isGiven) => {
  const scale = Object.assign(new ColourScale("range"), more);
  scale.cover(range, isGiven);
  return scale;
};

test("colours go from one end of the values to the other", () => {
  const { scale } = one([2, 4, 6]);
  assert.deepEqual(scale.range, [2, 6]);
  assert.deepEqual([2, 4, 6].map((v) => scale.place(v)), [0, 0.5, 1]);
  // viridis begins with 440154, ends with fde725 and has 21918c in the middle (van der Walt, Smith, 2015); of 256
  // colours the middle one lies 0.02 stops beyond it, which is less than 1 of 255.
  assert.deepEqual(scale.colour(0), [0x44, 0x01, 0x54]);
  assert.deepEqual(scale.colour(1), [0xfd, 0xe7, 0x25]);
  assertNear(scale.colour(0.5), [0x21, 0x91, 0x8c], 1);
});

test("between two stops colours are straight", () => {
  // Number 51 of 255 is 2 of the 10 steps of viridis; 38 is 1.490196: 0.490196 of the way from 482475 to 414487.
  const { viridis } = ColourScale.palettes;
  assert.deepEqual(viridis[51], [0x41, 0x44, 0x87]);
  assert.deepEqual(viridis[38], [72 - 7 * 0.490196, 36 + 32 * 0.490196, 117 + 18 * 0.490196].map(Math.round));
});

test("what has no value has the colour of none, what is beyond the ends has theirs, what is above the limit has its own", () => {
  const scale = scaleOver([4, 6], { limit: 7 });
  assert.deepEqual([2, 5, 7, 7.1, NaN].map((v) => scale.place(v)), [0, 0.5, 1, 2, -1]);
  assert.deepEqual([-1, 2].map((place) => scale.colour(place)), [ColourScale.palettes.none, ColourScale.palettes.above]);
});

test("values of both signs have zero in the middle", () => {
  for (const { scale } of [one([-1, 4]), one([1, 4], { colours: "both_signs" })]) {
    assert.deepEqual(scale.range, [-4, 4]);
    assertNear(scale.colour(0.5), [0xf2, 0xf2, 0xf0], 1);  // f2f2f0, the middle of nine
  }
});

test("lengths begin at zero, values that are all alike stand at the lower end", () => {
  assert.deepEqual(one([3, 4], { colours: "from_zero" }).scale.range, [0, 4]);
  const { scale } = one([3, 3]);
  assert.equal(scale.place(3), 0);
  assert.deepEqual(scale.ticks(), [3]);
});

test("numbers that are given are the ends, whatever the field wants; its two colours stay about zero", () => {
  const given = (range) => Object.assign(scaleOver(range, { wanted: "from_zero" }, true));
  assert.deepEqual(given([3, 4]).range, [3, 4]);
  assert.deepEqual(given([-1, 4]).range, [-1, 4]);
  assert.equal(given([-1, 4]).palette, ColourScale.palettes.viridis);
  assert.equal(given([-4, 4]).palette, ColourScale.palettes.signed);
});

test("by logarithms, every power of ten is as long; four of them are shown at most", () => {
  const scale = scaleOver([1, 1000], { isLogarithmic: true });
  assertNear([1, 10, 100, 1000, 0, -5].map((v) => scale.place(v)), [0, 1 / 3, 2 / 3, 1, 0, 0], 1e-15);
  assert.deepEqual(scaleOver([0, 500], { isLogarithmic: true }).range, [0.05, 500]);
});

test("whole numbers have a colour each", () => {
  const { scale } = one([0, 1, 2], { colours: "categories" });
  assert.deepEqual(scale.ticks(), [2, 1, 0]);
  assert.deepEqual([0, 0.5, 1].map((place) => scale.colour(place)), ColourScale.palettes.parts.slice(0, 3));
});

test("a legend has round numbers, the largest first", () => {
  assert.deepEqual(one([2, 6]).scale.ticks(), [6, 5, 4, 3, 2]);
  assert.deepEqual(one([0, 315.7]).scale.ticks(), [300, 200, 100, 0]);
  assert.deepEqual(scaleOver([0.013, 0.0171]).ticks(), [0.017, 0.016, 0.015, 0.014, 0.013]);
  assert.deepEqual(scaleOver([-2.5e-7, 2.5e-7]).ticks(), [2e-7, 1e-7, 0, -1e-7, -2e-7]);
  assert.deepEqual(scaleOver([0, 3.1e6]).ticks(1e6), [3e6, 2e6, 1e6, 0]);  // in mega
  assert.deepEqual(scaleOver([3, 40], { isLogarithmic: true }).ticks(), [20, 10, 5]);
  assert.deepEqual(scaleOver([3, 4], { isLogarithmic: true }).ticks(), [4, 3.8, 3.6, 3.4, 3.2, 3]);  // too few powers of ten
  assert.deepEqual(scaleOver([300, 300 + 1e-10]).ticks(), [300]);
  assert.deepEqual(scaleOver([0.02, 300], { isLogarithmic: true }).ticks(), [100, 10, 1, 0.1]);
});

// Two cells side by side over four nodes, a third of another part at the first edge.
const three = (values, more) => {
  const field = fieldOf("f", [[values]], { at: "cell", colours: "range" });
  const scene = sceneOf([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], [[0, 1, 2], [1, 3, 2], [1, 0, 3]], [field], { part: [0, 0, 1], ...more });
  return Object.assign(new Colouring(scene, field, 0), { isSmooth: true });
};

test("averaged, nodes have the mean of their cells within a part", () => {
  assert.deepEqual([...three([1, 3, 10]).corners(0)], [1, 2, 2, 2, 3, 2, 10, 10, 10]);
  assert.deepEqual([...three([1, NaN, 10]).corners(0)], [1, 1, 1, 1, NaN, 1, 10, 10, 10]);
  assert.deepEqual([...Object.assign(three([1, 3, 10]), { isSmooth: false }).corners(0)], [1, 1, 1, 3, 3, 3, 10, 10, 10]);
});

test("a triangle with a corner above the limit or without a value is marked as a whole", () => {
  const colouring = three([1, 3, NaN]);
  colouring.scale.cover([1, 3]);
  colouring.scale.limit = 2.5;
  assert.deepEqual([...colouring.places(0)], [0, 0.5, 0.5, 2, 2, 2, -1, -1, -1]);
});

test("ranges go over the triangles that are wanted, and over none where they have no values", () => {
  const colouring = three([1, 3, NaN]);
  assert.deepEqual(colouring.rangeAmong(0, (k) => k === 0), [1, 2]);
  assert.deepEqual(colouring.rangeAmong(0, () => true), [1, 3]);
  assert.equal(colouring.rangeAmong(0, (k) => k === 2), null);
});

test("the frame of the largest magnitude is the first of several; none where all is zero", () => {
  const frames = (values) => {
    const field = fieldOf("f", [values], { colours: "range" });
    return new Colouring(sceneOf([[0, 0, 0]], [], [field], { frames: values.length }), field, 0).largestFrame(9);
  };
  assert.equal(frames([[1], [-3], [3]]), 1);
  assert.equal(frames([[0], [0]]), 9);
});

test("without a field every part has its colour, in turn", () => {
  const colouring = new Colouring(sceneOf([[0, 0, 0]], []));
  const { parts } = ColourScale.palettes;
  assert.deepEqual([0, 7, 8].map((part) => colouring.colour(0, part)), [parts[0], parts[7], parts[0]]);
});

test("the length of a vector is that of Pythagoras, over all times", () => {
  const velocity = fieldOf("velocity", [[[3, 0], [0, 0]], [[4, 0], [0, 5]], [[0, 1], [0, 12]]]);
  const scene = sceneOf([[0, 0, 0], [0, 0, 0]], [], [velocity], { frames: 2 });
  const [choice] = Colouring.choices(scene, velocity), speed = new Colouring(scene, velocity, choice.component);
  assert.equal(choice.label, "speed");
  assert.deepEqual([speed.value(0, 0), speed.value(0, 1), speed.value(1, 1)], [5, 1, 13]);
  assert.deepEqual(speed.ofAllTimes, [0, 13]);
});

// Stresses xx, yy, zz, xy, yz, zx of one cell.
function vonMises(...stress) {
  const field = fieldOf("stress", stress.map((s) => [[s]]), { at: "cell", components: ["xx", "yy", "zz", "xy", "yz", "zx"] });
  const scene = sceneOf([[0, 0, 0]], [[0, 0, 0]], [field]);
  const [choice] = Colouring.choices(scene, field);
  assert.equal(choice.label, "von Mises stress");
  return new Colouring(scene, field, choice.component).value(0, 0);
}

test("the von Mises stress is that of tension, nothing of pressure, sqrt(3) times that of shear", () => {
  assert.equal(vonMises(0, -7, 0, 0, 0, 0), 7);
  assert.equal(vonMises(5, 5, 5, 0, 0, 0), 0);
  for (const shear of [[0, 0, 0, 2, 0, 0], [0, 0, 0, 0, 2, 0], [0, 0, 0, 0, 0, 2]])
    assertNear([vonMises(...shear)], [2 * Math.sqrt(3)], 1e-15);
});

test("a field is chosen whole, by its components, or as what is made of them", () => {
  const labels = (field, ...others) => Colouring.choices(sceneOf([], [], [field, ...others]), field).map((c) => c.label);
  const zeros = (count) => Array.from({ length: count }, () => [[0]]);
  assert.deepEqual(labels(fieldOf("pressure", zeros(1))), ["pressure"]);
  assert.deepEqual(labels(fieldOf("displacement", zeros(3))), ["displacement, length", "displacement x", "displacement y", "displacement z"]);
  const stress = fieldOf("stress", zeros(2), { components: ["xx", "yy"] });
  assert.deepEqual(labels(stress, fieldOf("von_mises", zeros(1))), ["stress xx", "stress yy"]);
});
