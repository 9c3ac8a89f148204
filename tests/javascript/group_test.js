// Views side by side.
"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const { load } = require("./page.js");
const carom = load("view_group");

// A view that knows these quantities, and the ends of each.
function viewOf(group, quantities, first) {
  const view = { drawn: 0, updated: 0, panel: { quantityName: first }, drawing: { eye: { follow: (other) => (view.follows = other) } } };
  view.choose = () => {
    view.colouring = { field: quantities[view.panel.quantityName], covered: quantities[view.panel.quantityName], cover: (range) => (view.range = range) };
    group.agree(view);
  };
  view.panel.chooseQuantity = (name) => {
    if (name in quantities) view.panel.quantityName = name;
    return name in quantities;
  };
  Object.assign(view, { draw: () => view.drawn++, update: () => view.updated++, showColours() {} });
  return view;
}

test("views that have a quantity show it, over the values of all of them", () => {
  const group = new carom.ViewGroup();
  const [a, b, c] = [{ speed: [0, 3], force: [1, 2] }, { speed: [1, 7], force: [0, 5] }, { speed: [-2, 1] }].map((q) => viewOf(group, q, "speed"));
  for (const view of [a, b, c]) {
    view.choose();
    group.views.push(view);
  }
  assert.deepEqual([a.range, b.range, c.range], [[-2, 7], [-2, 7], [-2, 7]]);
  a.panel.quantityName = "force";
  a.choose();
  assert.deepEqual([a, b, c].map((v) => v.panel.quantityName), ["force", "force", "speed"]);
  assert.deepEqual([a.range, b.range, c.range], [[0, 5], [0, 5], [-2, 7]]);
});

test("all views are turned with one, and do not turn it again", () => {
  const group = new carom.ViewGroup();
  const [a, b, still] = [0, 1, 2].map(() => viewOf(group, {}, ""));
  still.drawing.eye = undefined;
  group.views.push(a, b, still);
  b.drawing.eye.follow = (eye) => {
    b.follows = eye;
    group.turn(b);  // as its own eye tells
  };
  group.turn(a);
  assert.equal(b.follows, a.drawing.eye);
  assert.deepEqual([a.follows, a.drawn, b.drawn, still.drawn], [undefined, 0, 1, 0]);
});
