// The three-dimensional view of a run: bodies and obstacles through time, to be turned, cut and asked.
(function () {
  "use strict";
  const { create } = carom;
  const group = new carom.ViewGroup();
  const HELP = "Drag to turn, right button or two fingers to shift, wheel to zoom, click for values. Keys on the picture: space plays, ← → step, Home and End, + and − zoom, f fit, x y z i look along, e edges, a arrows of contact forces, c cut, shift and arrows turn.";
  const NO_WEBGL = "This browser has no WebGL: a still picture that follows the time, but cannot be turned.";

  class View {
    constructor(section, data) {
      Object.assign(this, { section, data, bodies: data.scenes[0] });
      this.extent = carom.extentOf(this.bodies);
      this.canvas = create("canvas", { tabIndex: 0, role: "img", "aria-label": "Bodies in motion" });
      this.overlay = new carom.Overlay(this.canvas);
      this.drawing = this.makeDrawing();
      this.panel = new carom.Panel(this.bodies, this.drawing, this.extent.isPlane,
        { chosen: () => this.choose(), partsChanged: () => this.update(), save: () => this.save() });
      this.player = new carom.Player(data.times);
      this.picks = new carom.Picks(data, () => {
        this.picks.show(this.player.frame);
        this.draw();
      });
      section.append(this.panel.element, this.overlay.stage, this.player.element,
        ...(group.views.length === 0 ? [create("p", { className: "note", textContent: HELP })] : []), this.picks.table, this.picks.curves);
      this.begin();
    }

    makeDrawing() {
      const { canvas, data, extent } = this;
      if (create("canvas").getContext("webgl")) return new carom.Drawing(canvas, data.scenes, extent, () => this.turned());
      this.overlay.stage.append(create("p", { className: "missing", textContent: NO_WEBGL }));
      return new carom.StillDrawing(canvas, data.scenes, extent);
    }

    // The last instant, from the front.
    begin() {
      const { eye } = this.drawing, { player, panel } = this;
      carom.listenToKeys(this.canvas, { player, panel, eye, chosen: () => this.choose() });
      if (eye) {
        carom.onClick(this.canvas, (event) => this.pickAt(event));
        const { iso, z } = carom.ViewCamera.directions(this.extent.isPlane);
        eye.look(this.extent.isPlane ? z : iso);
      }
      this.choose();
      new ResizeObserver(() => this.resize()).observe(this.overlay.stage);
      this.resize();
      carom.follow((t) => this.showTime(t));
      player.goTo(player.last);
      this.section.dataset.ready = "";
    }

    resize() {
      const { clientWidth: width, clientHeight: height } = this.overlay.stage;
      if (width === 0 || height === 0) return;
      this.drawing.resize(width, height);
      this.update();
    }

    showTime(t) {
      const { times, time_power: power, time_unit: unit } = this.data;
      this.player.showTime(t);
      this.overlay.clock.textContent = "t = " + carom.short(times[this.player.frame], power) + " " + unit;
      this.update();
    }

    // What the panel says is shown.
    choose() {
      const { quantity, fieldAndComponent: [field, component] } = this.panel;
      if (!this.colouring || this.chosen !== quantity.value) {
        this.colouring = new carom.Colouring(this.bodies, this.bodies.fields[field], component);
        this.chosen = quantity.value;
        group.agree(this);
        this.showColours();
        this.picks.choose(this.colouring, this.panel.quantityName);
      }
      this.panel.showCut();
      if (this.drawing.eye) this.drawing.cut(...this.panel.cut);
      this.update();
    }

    showColours() {
      this.overlay.showColours(this.colouring, this.panel.quantityName);
    }

    update() {
      const { panel, colouring } = this, { frame } = this.player;
      this.drawing.show({ frame, scale: panel.scale, colouring, edges: panel.edges.checked, arrows: panel.arrows.checked, arrowLength: 0.35 * this.extent.reach });
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

    turned() {
      this.draw();
      group.turn(this);
    }

    save() {
      this.draw();
      create("a", { download: "view.png", href: this.canvas.toDataURL("image/png") }).click();
    }

    pickAt(event) {
      const box = this.canvas.getBoundingClientRect();
      const found = this.drawing.pick((2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height);
      if (found) this.picks.add(found);
    }
  }

  async function start() {
    const sections = [...document.querySelectorAll("[data-view]")];
    if (sections.length === 0) return;
    await carom.load("three-js");
    await carom.load("orbit-js");
    for (const section of sections) {
      const data = await carom.unpack(JSON.parse(document.getElementById(section.dataset.view).textContent));
      group.views.push(new View(section, data));
    }
  }
  start().catch((error) => {
    for (const section of document.querySelectorAll("[data-view]"))
      section.append(create("p", { className: "note", textContent: "The view cannot be shown: " + error.message }));
    throw error;
  });
})();
