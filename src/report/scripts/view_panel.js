// What may be chosen of a view: the quantity, the deformation, edges and arrows, a cut, from where to look, the parts.
carom.Panel = (function () {
  "use strict";
  const { create } = carom;
  const FIRST = ["von_mises", "stress", "velocity", "displacement"];  // what is shown at first: the first that is there

  const label = (text, ...inputs) => create("label", {}, text + " ", ...inputs);
  const button = (text, more) => create("button", { type: "button", textContent: text, ...more });

  // What is rarely used: on small screens it is folded away.
  const rare = (...controls) => create("span", { className: "rare" }, ...controls);

  function moreButton() {
    const own = button("more", { className: "more", title: "What is rarely used", "aria-expanded": "false" });
    own.addEventListener("click", () => {
      const isOpen = own.parentElement.classList.toggle("whole");
      own.setAttribute("aria-expanded", String(isOpen));
      own.textContent = isOpen ? "less" : "more";
    });
    return own;
  }

  // The values of options are a field's number and a component of it.
  function quantitySelect(bodies) {
    const options = bodies.fields.flatMap((field, f) => carom.Colouring.choices(bodies, field).map((choice) =>
      create("option", { value: f + " " + choice.component, textContent: choice.label })));
    const select = create("select", { title: "What the colours show" }, ...options, create("option", { value: "", textContent: "parts" }));
    const first = FIRST.map((name) => bodies.fields.findIndex((f) => f.name === name)).find((f) => f >= 0);
    if (first !== undefined) select.value = first + " " + carom.Colouring.choices(bodies, bodies.fields[first])[0].component;
    return select;
  }

  function cutSelect(isPlane) {
    const axes = ["", "x", "y", ...(isPlane ? [] : ["z"])];
    return create("select", { title: "Cut the bodies open" }, ...axes.map((a) => create("option", { value: a, textContent: a === "" ? "no cut" : "cut along " + a })));
  }

  function lookButtons(eye, fit) {
    const looks = Object.entries(carom.ViewCamera.directions(eye.extent.isPlane)).map(([name, direction]) =>
      button(name, { title: "Look along " + name, onclick: () => eye.look(direction) }));
    return create("span", { className: "looks" }, ...looks, button("fit", { title: "All that is shown and moves", onclick: fit }));
  }

  // A button for each plane at which bodies seem to go on; planes: those that are chosen.
  function mirrorButtons(found, planes, mirrored) {
    if (found.length === 0) return [];
    const buttons = found.map((plane) => {
      const own = button("mirror " + plane.name, { title: "Draw the other half as well", "aria-pressed": "false" });
      own.addEventListener("click", () => {
        const isOn = planes.delete(plane) ? false : Boolean(planes.add(plane));
        own.setAttribute("aria-pressed", String(isOn));
        mirrored();
      });
      return own;
    });
    return [create("span", { className: "mirrors" }, ...buttons)];
  }

  function partSwitch(name, hidden, part, changed) {
    const own = button(name, { title: "Show or hide", "aria-pressed": "true" });
    own.addEventListener("click", () => {
      const isShown = own.getAttribute("aria-pressed") !== "true";
      own.setAttribute("aria-pressed", String(isShown));
      if (isShown) hidden.delete(part);
      else hidden.add(part);
      changed();
    });
    return own;
  }

  // Parts without a surface have none.
  function partSwitches(models, changed) {
    const switches = models.flatMap(({ scene, hidden }) => {
      const there = new Set(scene.part);
      return scene.parts.map((name, part) => (there.has(part) ? partSwitch(name, hidden, part, changed) : null));
    });
    return create("span", { className: "parts" }, ...switches.filter((own) => own !== null));
  }

  class Panel {
    // acts: what to do when something else is chosen, when parts come or go, to fit, when mirrors come or go; files: the
    // buttons that save.
    constructor(bodies, drawing, isPlane, acts) {
      this.quantity = quantitySelect(bodies);
      this.colours = new carom.ColourOptions(acts.chosen);
      this.deformation = create("input", { type: "number", value: 1, min: 0, step: "any", title: "Displacements are drawn times this" });
      this.edges = create("input", { type: "checkbox", checked: true, title: "Those of cells that are large enough on the picture" });
      this.arrows = create("input", { type: "checkbox", checked: true });
      this.cutAxis = cutSelect(isPlane);
      this.cutShare = create("input", { type: "range", min: 0, max: 1, step: 0.005, value: 0.5, title: "Where the cut is" });
      this.otherHalf = button("other half");
      Object.assign(this, { isOtherHalf: false, mirrors: new Set() });
      this.element = create("div", { className: "panel" }, ...this.rows(bodies, drawing, acts), partSwitches(drawing.models, acts.partsChanged), rare(acts.files));
      this.listen(acts.chosen);
      this.showCut();
    }

    rows(bodies, drawing, { fit, mirrored }) {
      const always = [label("colours", this.quantity), moreButton(),
        rare(this.colours.element, label("deformation ×", this.deformation), create("label", {}, this.edges, " edges"))];
      if (!drawing.eye) return always;
      const arrows = drawing.models[0].arrows ? [create("label", {}, this.arrows, " contact forces")] : [];
      return [...always, rare(...arrows), label("", this.cutAxis), this.cutShare, this.otherHalf,
        rare(...mirrorButtons(carom.Mirrors.planesOf(bodies), this.mirrors, mirrored)), lookButtons(drawing.eye, fit)];
    }

    listen(chosen) {
      this.quantity.addEventListener("change", () => this.colours.forget());
      for (const input of [this.quantity, this.deformation, this.edges, this.arrows, this.cutAxis]) input.addEventListener("change", chosen);
      this.cutShare.addEventListener("input", chosen);
      this.otherHalf.addEventListener("click", () => {
        this.isOtherHalf = !this.isOtherHalf;
        chosen();
      });
    }

    showCut() {
      this.cutShare.hidden = this.otherHalf.hidden = this.cutAxis.value === "";
    }

    // Where the bodies are cut: axis (-1: nowhere), share of the way, which half is seen.
    get cut() {
      return [["x", "y", "z"].indexOf(this.cutAxis.value), Number(this.cutShare.value), this.isOtherHalf];
    }

    get scale() {
      const number = Number(this.deformation.value);
      return this.deformation.value !== "" && Number.isFinite(number) ? number : 1;
    }

    get quantityName() {
      return this.quantity.selectedOptions[0].textContent;
    }

    // The number of a field and its component; nothing for the parts.
    get fieldAndComponent() {
      return this.quantity.value === "" ? [] : this.quantity.value.split(" ").map(Number);
    }

    // Chooses the quantity of this name; whether there is one.
    chooseQuantity(name) {
      const option = [...this.quantity.options].find((o) => o.textContent === name);
      if (option) this.quantity.value = option.value;
      return Boolean(option);
    }
  }

  return Panel;
})();
