// Pictures that the page has as they are (<svg class="plot">) can be saved as the charts can.
(function () {
  "use strict";
  const LOOKS = ["fill", "stroke", "stroke-width", "opacity"], LINE = 18;
  const svgElement = (tag, attributes, text) => {
    const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    if (text) element.textContent = text;
    return element;
  };

  // A copy that looks the same without the page's style.
  function standAlone(svg) {
    const copy = svg.cloneNode(true), originals = svg.querySelectorAll("*");
    copy.querySelectorAll("*").forEach((element, i) => {
      const style = getComputedStyle(originals[i]);
      for (const name of LOOKS) element.setAttribute(name, style.getPropertyValue(name));
      element.removeAttribute("style");
      element.removeAttribute("class");
    });
    return copy;
  }

  function legendOf(figure, height) {
    return [...figure.querySelectorAll(".legend span")].flatMap((entry, i) => {
      const y = height + LINE * (i + 0.5), colour = getComputedStyle(entry.querySelector("i")).borderTopColor, { opacity } = getComputedStyle(entry);
      return [svgElement("path", { d: `M62 ${y}h22`, stroke: colour, "stroke-width": 2, opacity }), svgElement("text", { x: 90, y: y + 4, fill: "#333" }, entry.textContent)];
    });
  }

  function svgOf(figure, title) {
    const svg = figure.querySelector("svg.plot"), { width, height } = svg.viewBox.baseVal, above = 28;
    const legend = legendOf(figure, height), whole = height + above + (LINE * legend.length) / 2 + 8, copy = standAlone(svg);
    copy.setAttribute("viewBox", `0 ${-above} ${width} ${whole}`);
    for (const [name, value] of Object.entries({ xmlns: "http://www.w3.org/2000/svg", width: 1.5 * width, height: 1.5 * whole, "font-family": "system-ui, sans-serif", "font-size": 12 }))
      copy.setAttribute(name, value);
    copy.removeAttribute("class");
    copy.prepend(svgElement("rect", { x: 0, y: -above, width, height: whole, fill: "#fff" }));
    copy.append(svgElement("text", { x: 62, y: -10, "font-weight": 600, "font-size": 14, fill: "#111" }, title), ...legend);
    return new XMLSerializer().serializeToString(copy);
  }

  // In the colours of paper, whatever the reader's are.
  function onPaper(act) {
    const { classList } = document.documentElement;
    classList.add("printing");
    const made = act();
    classList.remove("printing");
    return made;
  }

  for (const svg of document.querySelectorAll("svg.plot")) {
    const figure = svg.closest("figure"), caption = figure.querySelector("figcaption"), title = caption.textContent.trim();
    carom.addExports(caption, () => ({ title, svg: () => onPaper(() => svgOf(figure, title)), csv: () => figure.dataset.csv }));
  }
})();
