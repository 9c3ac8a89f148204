// What was clicked in a view: its values now in a table, and their curves over time beside the others of the page.
carom.Picks = (function () {
  "use strict";
  const { create } = carom;
  const MOST = 8;  // a newer one takes the place of the oldest

  function nodeAndCell(scene, pick) {
    return scene.numbered ? { node: scene.nodeNumber[pick.node], cell: scene.cellNumber[pick.cell] } : { node: "–", cell: "–" };
  }

  class Picks {
    // onChange: called when one has been added or forgotten.
    constructor(data, onChange) {
      Object.assign(this, { data, onChange, bodies: data.scenes[0], picks: [], forgetChart: null });
      this.rows = create("tbody");
      const titles = ["Node", "Cell", "Part", "Position", "Value", ""].map((text) => create("th", { textContent: text }));
      this.table = create("div", { className: "scroll picked", hidden: true }, create("table", {}, create("thead", {}, create("tr", {}, ...titles)), this.rows));
      this.curves = create("figure", { hidden: true });
    }

    add(found) {
      this.picks = [...this.picks.filter((p) => p.node !== found.node || p.cell !== found.cell), found].slice(-MOST);
      this.changed();
    }

    remove(pick) {
      this.picks = this.picks.filter((p) => p !== pick);
      this.changed();
    }

    changed() {
      this.drawRows();
      this.drawCurves();
      this.onChange();
    }

    // The quantity whose values and curves are shown.
    choose(colouring, name) {
      Object.assign(this, { colouring, name });
      this.drawRows();
      this.drawCurves();
    }

    drawRows() {
      this.table.hidden = this.picks.length === 0;
      this.rows.replaceChildren(...this.picks.map((pick, p) => {
        const { node, cell } = nodeAndCell(this.bodies, pick);
        const entry = (label, textContent = "") => create("td", { "data-label": label, textContent });
        pick.position = entry("Position");
        pick.value = entry("Value");
        const remove = create("button", { type: "button", textContent: "×", title: "Forget it", onclick: () => this.remove(pick) });
        return create("tr", {}, entry("Node", p + 1 + ": node " + node), entry("Cell", cell), entry("Part", this.bodies.parts[this.bodies.part[pick.cell]]),
          pick.position, pick.value, create("td", {}, remove));
      }));
    }

    drawCurves() {
      const { field } = this.colouring;
      this.curves.hidden = this.picks.length === 0 || !field;
      if (this.forgetChart) this.forgetChart();
      this.forgetChart = null;
      if (this.curves.hidden) return;
      const { at, unit, power } = field, { times } = this.data, chart = create("div", { className: "chart" });
      const curves = this.picks.map((pick) => ({
        name: at + " " + nodeAndCell(this.bodies, pick)[at], kind: "computed", shown: true, t: times,
        y: times.map((_, t) => this.colouring.value(t, pick[at])).map((y) => (Number.isNaN(y) ? null : y)),
      }));
      this.curves.replaceChildren(create("figcaption", { textContent: this.name + " of what was clicked" }), create("div", { className: "legend" }), chart);
      this.forgetChart = carom.drawChart(chart, { label: this.name, unit, power, curves });
    }

    // Values of this frame.
    show(frame) {
      const { field } = this.colouring, unit = this.data.length_unit ? " " + this.data.length_unit : "";
      for (const pick of this.picks) {
        const at = carom.positionOf(this.bodies, frame, pick.node);
        pick.position.textContent = "(" + at.map((x) => carom.four(x)).join(", ") + ")" + unit;
        pick.value.textContent = field ? carom.four(this.colouring.value(frame, pick[field.at]), field.power) + " " + field.unit : "–";
      }
    }

    // The nodes that were clicked; null for one that has gone.
    nodes(frame) {
      return this.picks.map(({ node }) => (Number.isNaN(carom.positionOf(this.bodies, frame, node)[0]) ? null : node));
    }
  }

  return Picks;
})();
