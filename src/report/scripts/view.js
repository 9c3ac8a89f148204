// The three-dimensional view of a run: bodies and obstacles through time, to be turned, cut and asked.
(function () {
  "use strict";
  const { create } = carom;
  const group = new carom.ViewGroup();
  const LONGEST = 0.25;  // arrow, in reaches of what the picture is fitted to
  const HELP = "Drag to turn, right button or two fingers to shift, wheel to zoom, click for values. Keys on the picture: space plays, ← → step, Home and End, + and − zoom, f fit, x y z i look along, e edges, a arrows of contact forces, c cut, shift and arrows turn.";
  const NO_WEBGL = "This browser has no WebGL: a still picture that follows the time, but cannot be turned.";

  class View {
    constructor(section, data) {
      Object.assign(this, { section, data, bodies: data.scenes[0] });
      this.fitted = this.extent = carom.extentOf(this.bodies);
      this.moving = carom.movingParts(this.bodies);
      this.canvas = create("canvas", { tabIndex: 0, role: "img", "aria-label": "Bodies in motion" });
      this.overlay = new carom.Overlay(this.canvas);
      this.drawing = this.makeDrawing();
      this.player = new carom.Player(data.times);
      this.panel = new carom.Panel(this.bodies, this.drawing, this.extent.isPlane, {
        chosen: () => this.choose(), fit: () => this.fit(), files: carom.viewFiles(this),
        partsChanged: () => {
          if (this.drawing.fill) this.drawing.fill.update();
          group.recolour();
        },
        mirrored: () => {
          this.drawing.mirror([...this.panel.mirrors]);
          this.fit();
        },
      });
      this.picks = new carom.Picks(data, () => {
        this.picks.show(this.player.frame);
        this.draw();
      });
      section.append(this.panel.element, this.overlay.stage, this.player.element,
        ...(group.views.length === 0 ? [create("p", { className: "note", textContent: HELP })] : []), this.picks.table, this.picks.curves);
      group.views.push(this);
    }

    makeDrawing() {
      const { canvas, data, extent } = this;
      if (create("canvas").getContext("webgl")) return new carom.Drawing(canvas, data.scenes, extent, () => {
        this.draw();
        group.turn(this);
      });
      this.overlay.stage.append(create("p", { className: "missing", textContent: NO_WEBGL }));
      return new carom.StillDrawing(canvas, data.scenes, extent);
    }
    // From the front, at the instant that is shown.
    begin() {
      const { drawing: { eye }, player, panel } = this;
      carom.listenToKeys(this.canvas, { player, panel, eye, chosen: () => this.choose(), fit: () => this.fit() });
      if (eye) {
        carom.onClick(this.canvas, (event) => pickAt(this, event));
        const { iso, z } = carom.ViewCamera.directions(this.extent.isPlane);
        eye.look(this.extent.isPlane ? z : iso);
      }
      this.fit();
      new ResizeObserver(() => this.resize()).observe(this.overlay.stage);
      this.resize();
      this.section.dataset.ready = "";
    }

    fit() {
      const { drawing, panel, bodies, player: { frame } } = this, { hidden, arrows } = drawing.models[0];
      const box = carom.fitOf(bodies, frame, panel.scale, { hidden, moving: this.moving });
      if (arrows && panel.arrows.checked) box.points = box.points.concat(arrows.tails(frame, carom.positions(bodies, frame, panel.scale), LONGEST * box.reach));
      this.fitted = carom.Mirrors.widened(box, panel.mirrors);
      this.way = [0, 0, 0];
      drawing.fit(this.fitted);
      this.update();
    }

    // Goes with what the picture is fitted to.
    follow() {
      if (!this.fitted.wayTo) return;
      const before = this.way;
      this.way = this.fitted.wayTo(this.player.frame, this.panel.scale);
      const step = this.way.map((x, c) => x - before[c]);
      if (step.some((x) => x !== 0)) this.drawing.shift(step);
    }

    resize() {
      const { clientWidth: width, clientHeight: height } = this.overlay.stage;
      if (width === 0 || height === 0) return;
      this.drawing.resize(width, height);
      this.update();
    }

    moveTo(t) {
      const { times, time_power: power, time_unit: unit } = this.data;
      this.player.showTime(t);
      this.overlay.clock.textContent = "t = " + carom.clock(times[this.player.frame], times, power) + " " + unit;
    }

    // What the panel says is shown.
    choose() {
      const { panel, bodies } = this, { quantity, fieldAndComponent: [field, component] } = panel;
      if (!this.colouring || this.chosen !== quantity.value) {
        this.colouring = new carom.Colouring(bodies, bodies.fields[field], component);
        this.chosen = quantity.value;
        this.picks.choose(this.colouring, panel.quantityName);
      }
      panel.colours.apply(this.colouring);
      panel.showCut();
      if (this.drawing.eye) this.drawing.cut(...panel.cut);
      group.agree(this);
    }

    // The values that the colours are to go over, as the panel says; null where there are none.
    rangeNow() {
      const { colouring, bodies, panel: { colours, scale }, player: { frame } } = this, { mode } = colours.state;
      if (colouring.scale.wanted === "categories") return colouring.ofAllTimes;
      if (mode === "instant") return colouring.rangeAmong(frame, (k) => bodies.isSeen(k, frame));
      if (mode === "visible") return colouring.rangeAmong(frame, this.drawing.sight(frame, scale));
      return colours.rangeGiven(colouring.field) || colouring.ofAllTimes;
    }

    cover(range) {
      this.colouring.scale.cover(range, Boolean(this.panel.colours.rangeGiven(this.colouring.field)));
    }

    update() {
      const { panel, colouring } = this, { frame } = this.player;
      this.follow();
      this.drawing.show({ frame, scale: panel.scale, colouring, edges: panel.edges.checked, arrows: panel.arrows.checked, arrowLength: LONGEST * this.fitted.reach });
      this.overlay.showColours(carom.Overlay.legendOf(colouring, panel.quantityName, frame));
      this.draw();
      this.picks.show(frame);
    }

    // The picture again, of the same numbers.
    draw() {
      const { drawing, overlay } = this;
      if (!drawing.eye) return;
      drawing.draw();
      overlay.showAxes(drawing.eye.camera);
      overlay.showMarks(this.picks.nodes(this.player.frame).map((node) => (node === null ? null : drawing.placeOf(node))));
    }
  }

  function pickAt(view, event) {
    const box = view.canvas.getBoundingClientRect();
    const found = view.drawing.pick((2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height);
    if (found) view.picks.add(found);
  }

  // The instant of the largest contact force. Where there is none, or where it is the start, at which nothing has happened
  // yet, that of the largest value that is shown, else the last one.
  function openingFrame({ data, colouring, player }) {
    const frame = data.opening === undefined ? 0 : carom.nearestFrame(data.times, data.opening);
    return frame > 0 || !colouring.field ? frame || player.last : colouring.largestFrame(player.last);
  }

  async function start() {
    const sections = [...document.querySelectorAll("[data-view]")];
    if (sections.length === 0) return;
    await carom.load("three-js");
    await carom.load("orbit-js");
    for (const section of sections) {
      const data = await carom.unpack(JSON.parse(document.getElementById(section.dataset.view).textContent));
      new View(section, data).choose();
    }
    carom.onPrint(() => group.views.forEach((view) => view.resize()));
    carom.follow((t) => group.showTime(t));
    const [first] = group.views;
    first.player.goTo(openingFrame(first));
    for (const view of group.views) view.begin();
  }
  start().catch((error) => {
    for (const section of document.querySelectorAll("[data-view]"))
      section.append(create("p", { className: "note", textContent: "The view cannot be shown: " + error.message }));
    throw error;
  });
})();
