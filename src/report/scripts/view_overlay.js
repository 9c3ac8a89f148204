// What stands over the picture of a view: the clock, the axes, the scale of the colours.
carom.Overlay = (function () {
  "use strict";
  const { create } = carom;

  // Where the ends of the axes and their letters are in a square of 64, the farthest from the eye first. turn: from the
  // bodies' directions to those of the picture.
  function axisLines(turn) {
    return ["x", "y", "z"].map((name, c) => {
      const v = new THREE.Vector3().setComponent(c, 1).applyMatrix4(turn);
      return { name, x: 32 + 22 * v.x, y: 32 - 22 * v.y, tx: 32 + 29 * v.x, ty: 32 - 29 * v.y, depth: v.z };
    }).sort((a, b) => a.depth - b.depth);
  }

  // What a legend says: title with unit, colours from below, round numbers and where they stand on the bar, what is marked.
  function legendOf(colouring, name, frame) {
    const { field, scale } = colouring;
    if (!field) return null;
    const power = field.power + carom.powerFor(Math.max(...scale.range.map(Math.abs)) / 10 ** field.power);
    const unit = [power === field.power ? "" : carom.powerOfTen(power - field.power), field.unit].filter((text) => text !== "").join(" ");
    const ticks = scale.ticks(10 ** power).map((x) => ({ share: scale.share(x), text: carom.digits(x, power, 6) }));
    return { title: carom.axisTitle(name, unit), stops: scale.palette.filter((_, i) => i % 15 === 0), ticks, above: marked(colouring, frame) };
  }

  function marked(colouring, frame) {
    const { scale: { limit }, field, isAtCells } = colouring;
    if (limit === Infinity) return "";
    const count = colouring.values(frame).filter((v) => v > limit).length;
    return `${count} ${isAtCells ? "cell" : "node"}${count === 1 ? "" : "s"} above ${carom.four(limit, field.power)}`;
  }

  class Overlay {
    // Over a canvas.
    constructor(canvas) {
      this.axes = create("div", { className: "axes" });
      this.scaleBar = create("div", { className: "colours" });
      this.clock = create("output", { className: "clock" });
      this.stage = create("div", { className: "stage" }, canvas, this.clock, this.axes, this.scaleBar);
    }

    showAxes(camera) {
      const lines = axisLines(new THREE.Matrix4().extractRotation(camera.matrixWorldInverse));
      this.axes.innerHTML = "<svg viewBox='0 0 64 64'>" + lines.map((l) =>
        `<g class="axis-${l.name}"><line x1="32" y1="32" x2="${l.x}" y2="${l.y}"/><text x="${l.tx}" y="${l.ty}">${l.name}</text></g>`).join("") + "</svg>";
    }

    // Nothing where parts have colours of their own.
    showColours(legend) {
      this.legend = legend;
      this.scaleBar.hidden = !legend;
      if (!legend) return;
      this.scaleBar.replaceChildren(
        create("strong", { textContent: legend.title }),
        create("i", { style: "background: linear-gradient(to top, " + legend.stops.map((c) => "rgb(" + c + ")") + ")" }),
        create("span", {}, ...legend.ticks.map(({ share, text }) => create("b", { textContent: text, style: `top: ${100 - 100 * share}%` }))),
        ...(legend.above ? [create("em", { textContent: legend.above })] : []));
    }

    // Small numbers on the picture, at places from -1 to 1 to the right and upward; null for one that is not there.
    showMarks(places) {
      for (const mark of this.stage.querySelectorAll(".mark-of-node")) mark.remove();
      places.forEach((v, p) => {
        if (v !== null) this.stage.append(create("span", { className: "mark-of-node", textContent: p + 1, style: `left: ${50 + 50 * v.x}%; top: ${50 - 50 * v.y}%` }));
      });
    }
  }

  return Object.assign(Overlay, { axisLines, legendOf });
})();
