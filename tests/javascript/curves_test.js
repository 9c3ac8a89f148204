// Curves as numbers, rows and files.
"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const { load } = require("./page.js");
globalThis.getComputedStyle = () => ({ getPropertyValue: (name) => ` ${name}` });  // every colour is its own name
globalThis.document = {};
const carom = load("numbers", "curve_rows", "curve_files", "curve_style", "curve_memory");

const curve = (name, kind, t, y) => ({ name, kind, t, y });

test("numbers have the digits of their place, in the unit of their axis", () => {
  assert.equal(carom.digits(0.0123456, -3, 4), "12.35");  // 12.3456 ms
  assert.equal(carom.digits(2.5e9, 6, 6), "2500");
  assert.equal(carom.digits(1 / 3, 0, 3), "0.333");
  assert.equal(carom.short(1e-3 / 3, -3), "0.33333");
  assert.equal(carom.short(199.9998e-6, -6), "200");
  assert.equal(carom.four(1.186e-5), "1.186 · 10⁻⁵");
  assert.equal(carom.four(-6.66e-16), "-6.66 · 10⁻¹⁶");
  assert.equal(carom.four(2.5e7), "2.5 · 10⁷");
  assert.equal(carom.four(123456, 3), "123.5");
  assert.equal(carom.four(-0.5), "-0.5");
  assert.equal(carom.clock(2.253e-4, [0, 1e-4, 2.253e-4, 3e-4], -6), "225.3");
  assert.equal(carom.clock(1.00002, [0, 0.5, 1, 1.00002, 1.00004, 1.00006], 0), "1.00002");
});

test("what has no value has no number", () => {
  for (const none of [null, undefined, NaN]) assert.equal(carom.short(none, 0), "");
  assert.equal(carom.four(NaN), "–");
});

test("axes name their unit if they have one", () => {
  assert.equal(carom.axisTitle("time", "ms"), "time [ms]");
  assert.equal(carom.axisTitle("rows", ""), "rows");
});

test("rows hold all times, with straight lines between the points of a curve and nothing beyond its ends", () => {
  // The lines y = 10 t from 0 to 2 and y = 3 - t from 1 to 3.
  const curves = [curve("a", "computed", [0, 2], [0, 20]), curve("b", "computed", [1, 1.5, 3], [2, 1.5, 0])];
  assert.deepEqual(carom.curveRows(curves), [[0, 0, null], [1, 10, 2], [1.5, 15, 1.5], [2, 20, 1], [3, null, 0]]);
});

test("a window shows one point beyond each of its ends", () => {
  const rows = [[0, 5, null], [1, 6, 1], [2, null, 2], [3, 8, 3], [4, 9, 4]];
  assert.deepEqual(carom.curvePoints(rows, 0, 0, 4), [[0, 5], [1, 6], [3, 8], [4, 9]]);
  assert.deepEqual(carom.curvePoints(rows, 0, 1, 3), [[1, 6], [3, 8]]);  // its ends are points
  assert.deepEqual(carom.curvePoints(rows, 0, 2.5, 3.5), [[1, 6], [3, 8], [4, 9]]);
  assert.deepEqual(carom.curvePoints(rows, 0, 1.5, 2.5), [[1, 6], [3, 8]]);  // no point within, a line across
  assert.deepEqual(carom.curvePoints(rows, 1, -1, 0.5), [[1, 1]]);
  assert.deepEqual(carom.curvePoints([[0, null]], 0, 0, 1), []);
});

const chart = { label: "force", unit: "kN", power: 3, curves: [curve('the "left", z', "computed"), curve("exact", "exact"), curve("a < b", "raw")] };
const what = {
  title: "F & G", chart, rows: [[0, 0, 0, 0], [0.001, 1000, null, 500], [0.002, 2000, 4000, 250]], colours: ["red", "#333", "blue"],
  time: { unit: "ms", power: -3 }, shown: [0, 1], window: { from: 0, to: 0.002, low: 0, high: 4000, timeTicks: [0.001], valueTicks: [2000] },
};

test("a file of numbers has what is shown, in the units of the axes, quoted as RFC 4180 has it", () => {
  assert.equal(carom.chartCsv(what), 'time [ms],"the ""left"", z [kN]",exact [kN]\n0,0,0\n1,1,\n2,2,4\n');
  const window = { ...what.window, from: 0.0005, to: 0.0015 };
  assert.equal(carom.chartCsv({ ...what, window, shown: [2] }), "time [ms],a < b [kN]\n1,0.5\n");
});

test("a file of the picture has curves from corner to corner of its frame", () => {
  const svg = carom.chartSvg({ ...what, shown: [0, 1, 2] });
  // The frame reaches from 78 to 784 to the right and from 368 up to 34: 0 is below left, 2 ms and 4 kN above right.
  assert.match(svg, /<path d="M78\.00 368\.00L784\.00 34\.00" stroke="#333" stroke-width="2" stroke-dasharray="6 5"\/>/);
  // 1 kN at 1 ms: half the width, a quarter of the height.
  assert.match(svg, /<path d="M78\.00 368\.00L431\.00 284\.50L784\.00 201\.00" stroke="red" stroke-width="2"\/>/);
  assert.match(svg, /stroke="blue" stroke-width="1"\/>/);
  assert.match(svg, /class="grid" d="M431 34V368"\/><text x="431\.0" y="384\.0" text-anchor="middle">1<\/text>/);
  assert.match(svg, /class="grid" d="M78 201H784"\/><text x="72\.0" y="205\.0" text-anchor="end">2<\/text>/);
  for (const text of ["F &amp; G", "a &lt; b", "time [ms]", "force [kN]"]) assert.ok(svg.includes(`>${text}</text>`), text);
});

test("a picture without one curve does not name it", () => {
  const svg = carom.chartSvg(what);
  assert.ok(!svg.includes("a &lt; b") && !svg.includes("blue"));
});

test("exact curves and totals are ink, a filtered curve has the colour of the raw one below it", () => {
  const curves = [curve("z", "raw"), curve("z, filtered", "filtered"), curve("x", "computed"), curve("x, exact", "exact"), curve("run: total: x", "computed")];
  assert.deepEqual(carom.curveColours(curves), ["--curve-170", "--curve-1", "--curve-2", "--ink", "--ink"]);
  const many = Array.from({ length: 9 }, (_, k) => curve("c" + k, "computed"));
  assert.equal(carom.curveColours(many)[8], "--curve-1");  // there are eight
});

test("curves that have a colour have it in every chart, those below others of it are paler", () => {
  const of = (...colours) => colours.map((colour, k) => ({ ...curve("c" + k, "computed"), colour, shown: true }));
  assert.deepEqual(carom.curveColours(of(2, 0, 2, 9)), ["--curve-3b8", "--curve-1", "--curve-3", "--curve-2"]);
  assert.deepEqual(carom.curveColours(of(0)), ["--curve-1"]);
  const [last, hidden] = of(4, 4);
  assert.deepEqual(carom.curveColours([last, { ...hidden, shown: false }]), ["--curve-5", "--curve-558"]);
});

test("curves of one colour that are told apart by their lines are not paler", () => {
  const of = (...lines) => lines.map((line, k) => ({ ...curve("c" + k, "computed"), colour: 1, line, shown: true }));
  assert.deepEqual(carom.curveColours(of(0, 1)), ["--curve-2", "--curve-2"]);
  assert.deepEqual(carom.curveColours([{ ...of(0)[0], kind: "raw" }, { ...of(0)[0], kind: "filtered" }]), ["--curve-2b8", "--curve-2"]);
  assert.deepEqual(of(0, 1, 6).map(carom.curveDashes), ["", "9 4", ""]);
  assert.equal(carom.curveDashes(curve("a", "exact")), "6 5");
});

// A chart as curves.js draws it, with what dygraphs and the legend would say.
function drawnChart(title, names, { x = null, y = null } = {}) {
  const on = new Set(names), given = [];
  const graph = { isZoomed: (axis) => (axis === "x" ? x : y) !== null, xAxisRange: () => x, yAxisRange: () => y, updateOptions: (options) => given.push(options) };
  const legend = { names: (isOn) => names.filter((name) => on.has(name) === isOn), choose: (known) => (legend.chosen = known) };
  return { title, graph, legend, given, on };
}

test("zoom, instant and hidden curves of a page are kept over its next reading", () => {
  const before = [drawnChart("force", ["x", "z"], { x: [1, 2], y: [-5, 5] }), drawnChart("energy", ["kinetic"], { x: [1, 2] })];
  before[0].on.delete("x");
  const state = JSON.parse(JSON.stringify(carom.stateOfCharts(before)));
  assert.deepEqual(state, { window: [1, 2], t: carom.t, charts: {
    force: { values: [-5, 5], off: ["x"], on: ["z"] }, energy: { values: null, off: [], on: ["kinetic"] } } });
  const after = [drawnChart("force", ["x", "z"]), drawnChart("new", ["y"])], shown = [];
  const { show } = carom;
  carom.show = (t) => shown.push(t);
  carom.restoreCharts(after, { ...state, t: 1.5 });
  carom.show = show;
  assert.deepEqual(after[0].legend.chosen, state.charts.force);
  assert.deepEqual(after[0].given, [{ dateWindow: [1, 2], valueRange: [-5, 5] }]);
  assert.deepEqual([after[1].given, after[1].legend.chosen, shown], [[], undefined, [1.5]]);
});

test("many computed curves are thinner", () => {
  assert.deepEqual(carom.curveStroke(curve("a", "computed"), 5), { strokeWidth: 2 });
  assert.deepEqual(carom.curveStroke(curve("a", "computed"), 6), { strokeWidth: 1.2 });
  assert.deepEqual(carom.curveStroke(curve("a", "exact"), 6).strokePattern, [6, 5]);
});

test("who follows the page's time hears of it once, and of what it is at first", () => {
  const heard = [];
  carom.follow((t) => heard.push(["early", t]));
  carom.show(1);
  carom.show(1);
  carom.follow((t) => heard.push(["late", t]));
  carom.show(2);
  assert.deepEqual(heard, [["early", 1], ["late", 1], ["early", 2], ["late", 2]]);
});
