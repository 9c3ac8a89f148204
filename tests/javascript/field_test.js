// What a view is coloured by.
"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const { load, fieldOf, sceneOf, assertNear } = require("./page.js");
const { Colouring } = load("view_field");

const one = (values, more) => {
  const field = fieldOf("f", [[values]], { colours: "range", ...more });
  return new Colouring(sceneOf(values.map(() => [0, 0, 0]), [], [field]), field, 0);
};

test("colours go from one end of the values to the other", () => {
  const colouring = one([2, 4, 6]);
  assert.deepEqual(colouring.range, [2, 6]);
  assert.deepEqual([...colouring.places(0)], [0, 0.5, 1]);
  // viridis begins with 440154, ends with fde725 and has 21918c in the middle (van der Walt, Smith, 2015); of 256
  // colours the middle one lies 0.02 stops beyond it, which is less than 1 of 255.
  assert.deepEqual(colouring.colour(0), [0x44, 0x01, 0x54]);
  assert.deepEqual(colouring.colour(1), [0xfd, 0xe7, 0x25]);
  assertNear(colouring.colour(0.5), [0x21, 0x91, 0x8c], 1);
});

test("between two stops colours are straight", () => {
  // Number 51 of 255 is 2 of the 10 steps of viridis; 38 is 1.490196: 0.490196 of the way from 482475 to 414487.
  const { viridis } = Colouring.palettes;
  assert.deepEqual(viridis[51], [0x41, 0x44, 0x87]);
  assert.deepEqual(viridis[38], [72 - 7 * 0.490196, 36 + 32 * 0.490196, 117 + 18 * 0.490196].map(Math.round));
});

test("what has no value has the colour of none, what is beyond the ends has theirs", () => {
  const colouring = one([2, 4, 6, 8]);
  colouring.cover([4, 6]);
  colouring.field = { ...colouring.field, value: (c, frame, i) => [2, 5, 8, NaN][i] };
  assert.deepEqual([...colouring.places(0)], [0, 0.5, 1, -1]);
  assert.deepEqual(colouring.colour(-1), Colouring.palettes.none);
});

test("values of both signs have zero in the middle", () => {
  for (const colouring of [one([-1, 4]), one([1, 4], { colours: "both_signs" })]) {
    assert.deepEqual(colouring.range, [-4, 4]);
    assertNear(colouring.colour(0.5), [0xf2, 0xf2, 0xf0], 1);  // f2f2f0, the middle of nine
  }
});

test("lengths begin at zero, values that are all alike stand at the lower end", () => {
  assert.deepEqual(one([3, 4], { colours: "from_zero" }).range, [0, 4]);
  assert.deepEqual([...one([3, 3]).places(0)], [0, 0]);
});

test("whole numbers have a colour each", () => {
  const colouring = one([0, 1, 2], { colours: "categories" });
  assert.deepEqual(colouring.ticks(), [2, 1, 0]);
  assert.deepEqual([0, 0.5, 1].map((place) => colouring.colour(place)), Colouring.palettes.parts.slice(0, 3));
});

test("a legend has five numbers, the largest first", () => {
  assert.deepEqual(one([2, 6]).ticks(), [6, 5, 4, 3, 2]);
});

test("without a field every part has its colour, in turn", () => {
  const colouring = new Colouring(sceneOf([[0, 0, 0]], []));
  const { parts } = Colouring.palettes;
  assert.deepEqual([0, 7, 8].map((part) => colouring.colour(0, part)), [parts[0], parts[7], parts[0]]);
});

test("the length of a vector is that of Pythagoras, over all times", () => {
  const velocity = fieldOf("velocity", [[[3, 0], [0, 0]], [[4, 0], [0, 5]], [[0, 1], [0, 12]]]);
  const scene = sceneOf([[0, 0, 0], [0, 0, 0]], [], [velocity], { frames: 2 });
  const [choice] = Colouring.choices(scene, velocity), speed = new Colouring(scene, velocity, choice.component);
  assert.equal(choice.label, "speed");
  assert.deepEqual([speed.value(0, 0), speed.value(0, 1), speed.value(1, 1)], [5, 1, 13]);
  assert.deepEqual(speed.range, [0, 13]);
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
