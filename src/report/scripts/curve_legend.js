// The legend of a chart: a button for every curve, with its value at the mouse, and the time there.
carom.CurveLegend = class {
  constructor(element, curves) {
    const more = document.createElement("details");
    const count = curves.filter((c) => !c.shown).length;
    more.append(Object.assign(document.createElement("summary"), { textContent: count + " more" }));
    this.entries = curves.map((curve) => {
      const button = document.createElement("button");
      button.type = "button";
      button.setAttribute("aria-pressed", String(curve.shown));
      const line = document.createElementNS("http://www.w3.org/2000/svg", "svg"), path = document.createElementNS(line.namespaceURI, "path");
      path.setAttribute("d", "M0 2H40");
      path.setAttribute("stroke-dasharray", carom.curveDashes(curve));
      line.append(path);
      const value = document.createElement("output");
      button.append(line, curve.name, value);
      (curve.shown ? element : more).append(button);
      return { button, line, value, name: curve.name };
    });
    if (count > 0) element.append(more);
    this.time = document.createElement("output");
    element.append(this.time);
  }

  // A click on curve k switches it on or off.
  listen(setVisibility) {
    this.entries.forEach(({ button }, k) => {
      button.addEventListener("click", () => {
        const on = button.getAttribute("aria-pressed") !== "true";
        button.setAttribute("aria-pressed", String(on));
        setVisibility(k, on);
      });
    });
  }

  // The curves that are switched on, or those that are not.
  names(isOn) {
    return this.entries.filter(({ button }) => (button.getAttribute("aria-pressed") === "true") === isOn).map(({ name }) => name);
  }

  // Switches curves of these names.
  choose({ on, off }) {
    const isOn = (button) => button.getAttribute("aria-pressed") === "true";
    for (const { button, name } of this.entries) if ((isOn(button) ? off : on).includes(name)) button.click();
  }

  show(time, values) {
    this.entries.forEach(({ value }, k) => (value.textContent = values[k]));
    this.time.textContent = time;
  }

  paint(colours) {
    this.entries.forEach(({ line }, k) => (line.style.stroke = colours[k]));
  }
};
