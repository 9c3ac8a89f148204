// The three-dimensional view of a run: bodies and obstacles through time, to be turned, cut and asked.
(function () {
  "use strict";
  const viewers = [];

  function create(tag, properties, ...children) {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(properties || {})) {
      if (name in element) element[name] = value;
      else element.setAttribute(name, value);
    }
    element.append(...children);
    return element;
  }

  const four = (x) => (Number.isNaN(x) ? "–" : String(Number(x.toPrecision(4))));

  class Viewer {
    constructor(section, data) {
      Object.assign(this, { section, data, frame: 0, picks: [], clipAxis: "", clipShare: 0.5, clipTurned: false });
      this.bodies = data.scenes[0];
      this.measure();
      this.canvas = create("canvas", { tabIndex: 0, role: "img", "aria-label": "Bodies in motion" });
      this.makeStage();
      this.makeDrawing();
      this.makePanel();
      this.makeTimeBar();
      this.makePicks();
      this.choose();
      new ResizeObserver(() => this.resize()).observe(this.stage);
      this.resize();
      carom.follow((t) => this.showTime(t));
      this.goTo(data.times.length - 1);
      section.dataset.ready = "";
    }

    // Where the bodies are over all times: what "fit" shows.
    measure() {
      const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
      for (let t = 0; t < this.bodies.frames; t++) {
        carom.positions(this.bodies, t, 1).forEach((xs, c) => {
          for (const x of xs) {
            if (x < low[c]) low[c] = x;
            if (x > high[c]) high[c] = x;
          }
        });
      }
      this.low = low;
      this.high = high;
      this.centre = low.map((l, c) => (l + high[c]) / 2);
      this.reach = Math.hypot(...low.map((l, c) => high[c] - l)) / 2 || 1;
      this.isPlane = !(high[2] - low[2] > 1e-9 * this.reach);
    }

    makeStage() {
      this.axes = create("div", { className: "axes" });
      this.scaleBar = create("div", { className: "colours" });
      this.clock = create("output", { className: "clock" });
      this.stage = create("div", { className: "stage" }, this.canvas, this.clock, this.axes, this.scaleBar);
      this.section.append(this.stage);
    }

    makeDrawing() {
      if (!create("canvas").getContext("webgl")) {
        this.renderer = null;
        this.models = this.data.scenes.map((scene, s) => ({ scene, isObstacle: s > 0, hidden: new Set() }));
        this.stage.append(create("p", { className: "missing", textContent: "This browser has no WebGL: a still picture that follows the time, but cannot be turned." }));
        return;
      }
      this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
      this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
      this.renderer.localClippingEnabled = true;
      this.plane = new THREE.Plane(new THREE.Vector3(1, 0, 0), 0);
      this.clipping = [];
      this.models = this.data.scenes.map((scene, s) => new carom.SceneModel(scene, s > 0, this.clipping));
      this.world = new THREE.Scene();
      for (const model of this.models) this.world.add(...model.objects);
      this.camera = new THREE.OrthographicCamera();
      this.camera.up.set(...(this.isPlane ? [0, 1, 0] : [0, 0, 1]));
      const light = new THREE.DirectionalLight(0xffffff, 0.5);
      light.position.set(0.4, 0.6, 1);
      this.camera.add(light, light.target);
      this.world.add(this.camera, new THREE.AmbientLight(0xffffff, 0.62));
      this.controls = new THREE.OrbitControls(this.camera, this.canvas);
      this.controls.enableKeys = false;
      this.controls.screenSpacePanning = true;
      this.controls.addEventListener("change", () => this.turned());
      this.look(this.isPlane ? [0, 0, 1] : [1, -1.4, 0.8]);
      this.canvas.addEventListener("pointerdown", (e) => (this.pressed = [e.clientX, e.clientY]));
      this.canvas.addEventListener("pointerup", (e) => {
        if (this.pressed && Math.hypot(e.clientX - this.pressed[0], e.clientY - this.pressed[1]) < 4) this.pickAt(e);
      });
    }

    // From this direction, everything in the picture.
    look(direction) {
      if (!this.renderer) return;
      const away = new THREE.Vector3(...direction).normalize();
      const centre = new THREE.Vector3(...this.centre);
      this.camera.position.copy(centre).addScaledVector(away, 20 * this.reach);
      this.camera.near = 0.1 * this.reach;
      this.camera.far = 40 * this.reach;
      this.camera.zoom = 1;
      this.controls.target.copy(centre);
      this.camera.updateProjectionMatrix();
      this.controls.update();
      this.turned();
    }

    fit() {
      if (this.renderer) this.look(this.camera.position.clone().sub(this.controls.target).toArray());
    }

    // About the upright axis, and over the horizontal one.
    turn(around, over) {
      if (!this.renderer) return;
      const away = this.camera.position.clone().sub(this.controls.target);
      const level = new THREE.Vector3().crossVectors(this.camera.up, away).normalize();
      away.applyAxisAngle(this.camera.up, around).applyAxisAngle(level, over);
      this.camera.position.copy(this.controls.target).add(away);
      this.controls.update();
    }

    // All views of the page are turned together.
    turned() {
      this.draw();
      if (Viewer.isFollowing) return;
      Viewer.isFollowing = true;
      for (const other of viewers) {
        if (other === this || !other.renderer) continue;
        const away = this.camera.position.clone().sub(this.controls.target).normalize();
        other.camera.position.copy(other.controls.target).addScaledVector(away, 20 * other.reach);
        other.camera.zoom = this.camera.zoom;
        other.camera.updateProjectionMatrix();
        other.controls.update();
        other.draw();
      }
      Viewer.isFollowing = false;
    }

    resize() {
      const { clientWidth: width, clientHeight: height } = this.stage;
      if (width === 0 || height === 0) return;
      if (this.renderer) {
        const half = this.reach * 1.05, aspect = width / height;
        const [across, up] = aspect > 1 ? [half * aspect, half] : [half, half / aspect];
        Object.assign(this.camera, { left: -across, right: across, top: up, bottom: -up });
        this.camera.updateProjectionMatrix();
        this.renderer.setSize(width, height, false);
      } else {
        const ratio = Math.min(window.devicePixelRatio, 2);
        this.canvas.width = width * ratio;
        this.canvas.height = height * ratio;
      }
      this.update();
    }

    makePanel() {
      this.quantity = create("select", { title: "What the colours show" });
      this.bodies.fields.forEach((field, f) => {
        for (const choice of carom.Colouring.choices(this.bodies, field))
          this.quantity.append(create("option", { value: f + " " + choice.component, textContent: choice.label }));
      });
      this.quantity.append(create("option", { value: "", textContent: "parts" }));
      const first = ["von_mises", "stress", "velocity", "displacement"].map((name) => this.bodies.fields.findIndex((f) => f.name === name)).find((f) => f >= 0);
      if (first !== undefined) this.quantity.value = first + " " + carom.Colouring.choices(this.bodies, this.bodies.fields[first])[0].component;
      this.scale = create("input", { type: "number", value: 1, min: 0, step: "any", title: "Displacements are drawn times this" });
      this.edges = create("input", { type: "checkbox", checked: this.bodies.triangles < 60000 });
      this.arrows = create("input", { type: "checkbox", checked: true });
      this.clip = create("select", { title: "Cut the bodies open" }, ...["", "x", "y", ...(this.isPlane ? [] : ["z"])].map((a) => create("option", { value: a, textContent: a === "" ? "no cut" : "cut along " + a })));
      this.cut = create("input", { type: "range", min: 0, max: 1, step: 0.005, value: 0.5, title: "Where the cut is" });
      this.flip = create("button", { type: "button", textContent: "other half" });
      const directions = { iso: [1, -1.4, 0.8], x: [1, 0, 0], y: [0, -1, 0], z: [0, 0, 1] };
      const looks = Object.entries(directions).map(([name, direction]) =>
        create("button", { type: "button", textContent: name, title: "Look along " + name, onclick: () => this.look(name === "z" && !this.isPlane ? [0, -1e-6, 1] : direction) }));
      const fit = create("button", { type: "button", textContent: "fit", onclick: () => this.fit() });
      const picture = create("button", { type: "button", textContent: "PNG", title: "Save the picture", onclick: () => this.save() });
      const label = (text, ...inputs) => create("label", {}, text + " ", ...inputs);
      const is3D = Boolean(this.renderer);
      this.panel = create("div", { className: "panel" },
        label("colours", this.quantity), label("deformation ×", this.scale), create("label", {}, this.edges, " edges"),
        ...(is3D && this.models[0].force ? [create("label", {}, this.arrows, " contact forces")] : []),
        ...(is3D ? [label("", this.clip), this.cut, this.flip] : []),
        ...(is3D ? [create("span", { className: "looks" }, ...looks, fit, picture)] : []));
      this.panel.append(this.partSwitches());
      this.section.insertBefore(this.panel, this.stage);
      for (const input of [this.quantity, this.scale, this.edges, this.arrows, this.clip]) input.addEventListener("change", () => this.choose());
      this.cut.addEventListener("input", () => this.choose());
      this.flip.addEventListener("click", () => {
        this.clipTurned = !this.clipTurned;
        this.choose();
      });
      this.cut.hidden = this.flip.hidden = true;
    }

    partSwitches() {
      const box = create("span", { className: "parts" });
      for (const model of this.models) {
        const there = new Set(model.scene.part);
        model.scene.parts.forEach((name, part) => {
          if (!there.has(part)) return;
          const button = create("button", { type: "button", textContent: name, title: "Show or hide", "aria-pressed": "true" });
          button.addEventListener("click", () => {
            const isShown = button.getAttribute("aria-pressed") !== "true";
            button.setAttribute("aria-pressed", String(isShown));
            isShown ? model.hidden.delete(part) : model.hidden.add(part);
            this.update();
          });
          box.append(button);
        });
      }
      return box;
    }

    makeTimeBar() {
      this.play = create("button", { type: "button", textContent: "▶", title: "Play (space)" });
      this.slider = create("input", { type: "range", min: 0, max: this.data.times.length - 1, step: 1, title: "Time" });
      this.speed = create("select", { title: "Time that the whole run takes" }, ...[[20, "slow"], [8, "normal"], [3, "fast"]].map(([seconds, name]) => create("option", { value: seconds, textContent: name })));
      this.speed.value = 8;
      this.play.addEventListener("click", () => this.toggle());
      this.slider.addEventListener("input", () => this.goTo(Number(this.slider.value)));
      this.section.append(create("div", { className: "time" }, this.play, this.slider, this.speed));
      this.canvas.addEventListener("keydown", (event) => {
        const act = this.keys()[(event.shiftKey && event.key.startsWith("Arrow") ? "shift " : "") + event.key];
        if (!act || event.ctrlKey || event.altKey || event.metaKey) return;
        event.preventDefault();
        act();
      });
      if (viewers.length === 0) this.section.append(create("p", { className: "note", textContent: "Drag to turn, right button or two fingers to shift, wheel to zoom, click for values. Keys on the picture: space plays, ← → step, Home and End, + and − zoom, f fit, x y z i look along, e edges, a arrows of contact forces, c cut, shift and arrows turn." }));
    }

    keys() {
      const last = this.data.times.length - 1;
      const press = (input) => {
        input.checked = !input.checked;
        this.choose();
      };
      const look = (direction) => () => this.look(direction);
      const zoom = (factor) => () => {
        if (!this.renderer) return;
        this.camera.zoom *= factor;
        this.camera.updateProjectionMatrix();
        this.turned();
      };
      return {
        " ": () => this.toggle(), ArrowRight: () => this.goTo(Math.min(last, this.frame + 1)), ArrowLeft: () => this.goTo(Math.max(0, this.frame - 1)),
        "shift ArrowLeft": () => this.turn(-0.1, 0), "shift ArrowRight": () => this.turn(0.1, 0), "shift ArrowUp": () => this.turn(0, -0.1), "shift ArrowDown": () => this.turn(0, 0.1),
        Home: () => this.goTo(0), End: () => this.goTo(last), f: () => this.fit(), e: () => press(this.edges), a: () => press(this.arrows),
        "+": zoom(1.2), "-": zoom(1 / 1.2), x: look([1, 0, 0]), y: look([0, -1, 0]), z: look(this.isPlane ? [0, 0, 1] : [0, -1e-6, 1]), i: look([1, -1.4, 0.8]),
        c: () => {
          this.clip.selectedIndex = (this.clip.selectedIndex + 1) % this.clip.options.length;
          this.choose();
        },
      };
    }

    toggle() {
      if (this.timer) return this.pause();
      if (this.frame === this.data.times.length - 1) this.goTo(0);
      this.play.textContent = "❚❚";
      const tick = () => {
        if (this.frame === this.data.times.length - 1) return this.pause();
        this.goTo(this.frame + 1);
        this.timer = setTimeout(tick, (1000 * this.speed.value) / this.data.times.length);
      };
      this.timer = setTimeout(tick, 0);
    }

    pause() {
      clearTimeout(this.timer);
      this.timer = null;
      this.play.textContent = "▶";
    }

    goTo(frame) {
      carom.show(this.data.times[frame]);
    }

    // The recorded instant next to t.
    showTime(t) {
      const { times } = this.data;
      let best = 0;
      for (let i = 1; i < times.length; i++) if (Math.abs(times[i] - t) < Math.abs(times[best] - t)) best = i;
      this.frame = best;
      this.slider.value = best;
      this.clock.textContent = "t = " + carom.short(times[best], this.data.time_power) + " " + this.data.time_unit;
      this.update();
    }

    choose() {
      const [field, component] = this.quantity.value === "" ? [] : this.quantity.value.split(" ").map(Number);
      if (!this.colouring || this.chosen !== this.quantity.value) {
        this.colouring = new carom.Colouring(this.bodies, this.bodies.fields[field], component);
        this.chosen = this.quantity.value;
        this.agree();
        this.drawColours();
        this.drawPicks();
      }
      this.cut.hidden = this.flip.hidden = this.clip.value === "";
      if (this.renderer) this.placeClip();
      this.update();
    }

    quantityName() {
      return this.quantity.selectedOptions[0].textContent;
    }

    // Views side by side show the same quantity, in the same colours.
    agree() {
      if (Viewer.isAgreeing) return;
      Viewer.isAgreeing = true;
      const name = this.quantityName();
      for (const other of viewers) {
        const option = [...other.quantity.options].find((o) => o.textContent === name);
        if (other === this || !option) continue;
        other.quantity.value = option.value;
        other.choose();
      }
      const same = [...new Set([this, ...viewers])].filter((v) => v.colouring.field && v.quantityName() === name);
      const low = Math.min(...same.map((v) => v.colouring.covered[0])), high = Math.max(...same.map((v) => v.colouring.covered[1]));
      for (const view of same) {
        view.colouring.cover([low, high]);
        view.drawColours();
        if (view !== this) view.update();
      }
      Viewer.isAgreeing = false;
    }

    placeClip() {
      const axis = ["x", "y", "z"].indexOf(this.clip.value);
      this.clipping.length = 0;
      if (axis >= 0) {
        const sign = this.clipTurned ? 1 : -1, at = this.low[axis] + Number(this.cut.value) * (this.high[axis] - this.low[axis]);
        this.plane.normal.fromArray([0, 1, 2].map((c) => (c === axis ? sign : 0)));
        this.plane.constant = -sign * at;
        this.clipping.push(this.plane);
      }
      for (const model of this.models) for (const object of model.objects) object.material.needsUpdate = true;
    }

    drawColours() {
      const { field, palette } = this.colouring;
      this.scaleBar.hidden = !field;
      if (!field) return;
      const stops = palette.filter((_, i) => i % 15 === 0).map((c) => "rgb(" + c + ")").reverse();
      this.scaleBar.replaceChildren(
        create("strong", { textContent: this.quantityName() + (field.unit ? " [" + field.unit + "]" : "") }),
        create("i", { style: "background: linear-gradient(" + stops + ")" }),
        create("span", {}, ...this.colouring.ticks().map((x) => create("b", { textContent: four(x / 10 ** field.power) }))));
    }

    update() {
      if (!this.slider) return;
      const number = Number(this.scale.value);
      const scale = this.scale.value !== "" && Number.isFinite(number) ? number : 1;
      const what = { frame: this.frame, scale, colouring: this.colouring, edges: this.edges.checked, arrows: this.arrows.checked, arrowLength: 0.35 * this.reach };
      if (this.renderer) {
        const plain = (this.plain = this.plain || new carom.Colouring(this.bodies));
        for (const model of this.models) model.show(model.isObstacle ? { ...what, colouring: plain, arrows: false } : what);
        this.draw();
      } else if (this.canvas.width > 0) {
        carom.drawStill(this.canvas, this.models, { ...what, centre: this.centre, reach: this.reach, isPlane: this.isPlane });
      }
      this.showPicks();
    }

    draw() {
      if (!this.renderer) return;
      this.renderer.render(this.world, this.camera);
      this.drawAxes();
      this.placeMarks();
    }

    drawAxes() {
      const turn = new THREE.Matrix4().extractRotation(this.camera.matrixWorldInverse);
      const lines = ["x", "y", "z"].map((name, c) => {
        const v = new THREE.Vector3(c === 0 ? 1 : 0, c === 1 ? 1 : 0, c === 2 ? 1 : 0).applyMatrix4(turn);
        return { name, x: 32 + 22 * v.x, y: 32 - 22 * v.y, tx: 32 + 29 * v.x, ty: 32 - 29 * v.y, depth: v.z };
      }).sort((a, b) => a.depth - b.depth);
      this.axes.innerHTML = "<svg viewBox='0 0 64 64'>" + lines.map((l) =>
        `<g class="axis-${l.name}"><line x1="32" y1="32" x2="${l.x}" y2="${l.y}"/><text x="${l.tx}" y="${l.ty}">${l.name}</text></g>`).join("") + "</svg>";
    }

    save() {
      this.draw();
      const link = create("a", { download: "view.png", href: this.canvas.toDataURL("image/png") });
      link.click();
    }

    // Values of what was clicked, and their curves beside the others.
    makePicks() {
      this.table = create("tbody");
      this.pickTable = create("div", { className: "scroll picked", hidden: true }, create("table", {},
        create("thead", {}, create("tr", {}, ...["Node", "Cell", "Part", "Position", "Value", ""].map((text) => create("th", { textContent: text })))), this.table));
      this.pickCurves = create("figure", { hidden: true });
      this.section.append(this.pickTable, this.pickCurves);
    }

    pickAt(event) {
      const box = this.canvas.getBoundingClientRect();
      const place = new THREE.Vector2((2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height);
      const raycaster = new THREE.Raycaster();
      raycaster.setFromCamera(place, this.camera);
      const found = this.models[0].pick(raycaster, (point) => this.clipping.every((plane) => plane.distanceToPoint(point) >= 0));
      if (!found) return;
      this.picks = [...this.picks.filter((p) => p.node !== found.node || p.cell !== found.cell), found].slice(-8);
      this.drawPicks();
      this.showPicks();
      this.draw();
    }

    number(pick, what) {
      const scene = this.bodies;
      return scene.numbered ? (what === "node" ? scene.nodeNumber : scene.cellNumber)[pick[what]] : "–";
    }

    drawPicks() {
      if (!this.table) return;
      const { field } = this.colouring;
      this.pickTable.hidden = this.picks.length === 0;
      this.table.replaceChildren(...this.picks.map((pick, p) => {
        const cell = (label) => create("td", { "data-label": label });
        pick.cells = { position: cell("Position"), value: cell("Value") };
        const remove = create("button", { type: "button", textContent: "×", title: "Forget it", onclick: () => {
          this.picks.splice(p, 1);
          this.drawPicks();
          this.showPicks();
          this.draw();
        } });
        const row = create("tr", {}, cell("Node"), cell("Cell"), cell("Part"), pick.cells.position, pick.cells.value, create("td", {}, remove));
        row.children[0].textContent = p + 1 + ": node " + this.number(pick, "node");
        row.children[1].textContent = this.number(pick, "cell");
        row.children[2].textContent = this.bodies.parts[this.bodies.part[pick.cell]];
        return row;
      }));
      this.pickCurves.hidden = this.picks.length === 0 || !field;
      if (this.forget) this.forget();
      this.forget = null;
      if (this.pickCurves.hidden) return;
      const at = field.at, name = this.quantityName();
      const curves = this.picks.map((pick) => ({
        name: at + " " + this.number(pick, at), kind: "computed", shown: true, t: this.data.times,
        y: this.data.times.map((_, t) => this.colouring.value(t, pick[at])).map((y) => (Number.isNaN(y) ? null : y)),
      }));
      const chart = create("div", { className: "chart" });
      this.pickCurves.replaceChildren(create("figcaption", { textContent: name + " of what was clicked" }), create("div", { className: "legend" }), chart);
      this.forget = carom.drawChart(chart, { label: name, unit: field.unit, power: field.power, curves });
    }

    showPicks() {
      if (!this.table) return;
      const { field } = this.colouring;
      for (const pick of this.picks) {
        const at = carom.positionOf(this.bodies, this.frame, pick.node);
        const unit = this.data.length_unit ? " " + this.data.length_unit : "";
        pick.cells.position.textContent = "(" + at.map(four).join(", ") + ")" + unit;
        pick.cells.value.textContent = field ? four(this.colouring.value(this.frame, pick[field.at]) / 10 ** field.power) + " " + field.unit : "–";
      }
    }

    // A small number on the picture at every node that was clicked.
    placeMarks() {
      for (const mark of this.stage.querySelectorAll(".mark-of-node")) mark.remove();
      const { at } = this.models[0];
      this.picks.forEach((pick, p) => {
        if (Number.isNaN(carom.positionOf(this.bodies, this.frame, pick.node)[0])) return;
        const v = new THREE.Vector3(at[0][pick.node], at[1][pick.node], at[2][pick.node]).project(this.camera);
        this.stage.append(create("span", { className: "mark-of-node", textContent: p + 1, style: `left: ${50 + 50 * v.x}%; top: ${50 - 50 * v.y}%` }));
      });
    }
  }

  async function start() {
    const sections = [...document.querySelectorAll("[data-view]")];
    if (sections.length === 0) return;
    await carom.load("three-js");
    await carom.load("orbit-js");
    for (const section of sections) {
      const data = await carom.unpack(JSON.parse(document.getElementById(section.dataset.view).textContent));
      viewers.push(new Viewer(section, data));
    }
  }
  start().catch((error) => {
    for (const section of document.querySelectorAll("[data-view]"))
      section.append(create("p", { className: "note", textContent: "The view cannot be shown: " + error.message }));
    throw error;
  });
})();
