// Views side by side.
"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const { load } = require("./page.js");
const carom = load("view_group");

// A view that knows these quantities, and the ends of each.
function viewOf(group, quantities, first) {
  const view = { drawn: 0, updated: 0, drawing: { eye: { follow: (other) => (view.follows = other) } } };
  view.panel = { quantityName: first, colours: { state: { mode: "all" }, adopt: (state) => (view.panel.colours.state = state) } };
  view.choose = () => {
    view.colouring = { field: quantities[view.panel.quantityName] };
    group.agree(view);
  };
  view.panel.chooseQuantity = (name) => {
    if (!(name in quantities)) return false;
    view.panel.quantityName = name;
    return true;
  };
  Object.assign(view, { draw: () => view.drawn++, update: () => view.updated++, moveTo: (t) => (view.t = t),
    rangeNow: () => quantities[view.panel.quantityName], cover: (range) => (view.range = range) });
  return view;
}

const QUANTITIES = [{ speed: [0, 3], force: [1, 2] }, { speed: [1, 7], force: [0, 5] }, { speed: [-2, 1] }];
function groupOf(...given) {
  const group = new carom.ViewGroup(), views = given.map((quantities) => viewOf(group, quantities, "speed"));
  group.views.push(...views);
  for (const view of views) view.choose();
  return [group, ...views];
}

test("views that have a quantity show it, over the values of all of them", () => {
  const [, a, b, c] = groupOf(...QUANTITIES);
  assert.deepEqual([a.range, b.range, c.range], [[-2, 7], [-2, 7], [-2, 7]]);
  a.panel.quantityName = "force";
  a.choose();
  assert.deepEqual([a, b, c].map((v) => v.panel.quantityName), ["force", "force", "speed"]);
  assert.deepEqual([a.range, b.range, c.range], [[0, 5], [0, 5], [-2, 1]]);
});

test("colours are chosen in one view for all that show the same", () => {
  const [, a, b, c] = groupOf(...QUANTITIES);
  a.panel.quantityName = "force";
  a.panel.colours.state = { mode: "instant" };
  a.choose();
  assert.deepEqual([a, b, c].map((v) => v.panel.colours.state.mode), ["instant", "instant", "all"]);
});

test("a view without values does not count, and is covered by the others", () => {
  const [group, a, b] = groupOf(QUANTITIES[0], QUANTITIES[1]);
  b.rangeNow = () => null;
  group.recolour();
  assert.deepEqual([a.range, b.range], [[0, 3], [0, 3]]);
});

test("all views go to an instant before one is drawn", () => {
  const [group, a, b] = groupOf(QUANTITIES[0], QUANTITIES[1]), seen = [];
  a.update = b.update = () => seen.push([a.t, b.t]);
  group.showTime(4);
  assert.deepEqual(seen, [[4, 4], [4, 4]]);
});

test("all views are turned with one, and do not turn it again; colours of what is seen follow", () => {
  const [group, a, b, still] = groupOf(...QUANTITIES);
  still.drawing.eye = undefined;
  b.drawing.eye.follow = (eye) => {
    b.follows = eye;
    group.turn(b);  // as its own eye tells
  };
  const before = a.updated;
  group.turn(a);
  assert.equal(b.follows, a.drawing.eye);
  assert.deepEqual([a.follows, a.drawn, b.drawn, still.drawn, a.updated], [undefined, 0, 1, 0, before]);
  a.panel.colours.state = { mode: "visible" };
  group.turn(a);
  assert.equal(a.updated, before + 1);
});
