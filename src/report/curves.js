// Draws the charts of the page with dygraphs. All of them share the time axis: zooming one zooms all.
(function () {
  "use strict";
  const data = JSON.parse(document.getElementById("charts").textContent);
  const { css, short } = carom;

  function axisTitle(name, unit) {
    return unit === "" ? name : name + " [" + unit + "]";
  }

  // Values of one curve at the times of all curves, straight between its own points as the line is drawn.
  function resample(curve, times) {
    const out = [];
    let i = 0;
    for (const t of times) {
      while (i < curve.t.length && curve.t[i] < t) i++;
      if (i === curve.t.length || (i === 0 && curve.t[0] > t)) out.push(null);
      else if (curve.t[i] === t) out.push(curve.y[i]);
      else {
        const w = (t - curve.t[i - 1]) / (curve.t[i] - curve.t[i - 1]);
        out.push(curve.y[i - 1] + w * (curve.y[i] - curve.y[i - 1]));
      }
    }
    return out;
  }

  function rows(chart) {
    const times = [...new Set(chart.curves.flatMap((c) => c.t))].sort((a, b) => a - b);
    const columns = chart.curves.map((c) => resample(c, times));
    return times.map((t, i) => [t, ...columns.map((c) => c[i])]);
  }

  // Exact curves are dashes in the colour of text: they lie over the computed curve of any colour. A filtered curve has
  // the colour of the raw one below it, which is pale.
  function colours(chart) {
    const numbered = chart.curves.filter((c) => c.kind === "computed" || c.kind === "raw").map((c) => c.name);
    return chart.curves.map((c) => {
      if (c.kind === "exact" || /(^|: )total: /.test(c.name)) return css("--ink");
      const own = css("--curve-" + ((numbered.indexOf(c.name.replace(/, filtered$/, "")) % 8) + 1));
      return c.kind === "raw" ? own + "70" : own;
    });
  }

  function makeLegend(element, chart) {
    const more = document.createElement("details");
    const count = chart.curves.filter((c) => !c.shown).length;
    more.append(Object.assign(document.createElement("summary"), { textContent: count + " more" }));
    const entries = chart.curves.map((curve, k) => {
      const button = document.createElement("button");
      button.type = "button";
      button.setAttribute("aria-pressed", String(curve.shown));
      const line = document.createElement("i");
      if (curve.kind === "exact") line.className = "dashed";
      const value = document.createElement("output");
      button.append(line, curve.name, value);
      (curve.shown ? element : more).append(button);
      return { button, line, value, k };
    });
    if (count > 0) element.append(more);
    return entries;
  }

  const stroke = {
    computed: { strokeWidth: 2 }, raw: { strokeWidth: 1 }, filtered: { strokeWidth: 2 }, exact: { strokePattern: [6, 5], strokeWidth: 1.3 },
  };
  const drawn = [];
  let syncing = false;

  function follow(source, window_) {
    if (syncing) return;
    syncing = true;
    for (const d of drawn) if (d.graph !== source) d.graph.updateOptions({ dateWindow: window_ });
    syncing = false;
  }

  const tick = (power) => (v) => String(Number((v / Math.pow(10, power)).toPrecision(6)));

  // Numbers that count have no ticks between them.
  function wholeTicks(...given) {
    return Dygraph.numericTicks(...given).filter((t) => Number.isInteger(t.v));
  }

  // Where another stage begins.
  function drawMarks(context, area, graph) {
    const [from, to] = graph.xAxisRange();
    context.save();
    context.strokeStyle = css("--soft");
    context.fillStyle = css("--soft");
    context.setLineDash([2, 3]);
    context.font = "11px system-ui, sans-serif";
    for (const mark of data.marks) {
      if (mark.t < from || mark.t > to) continue;
      const x = Math.round(graph.toDomXCoord(mark.t)) + 0.5;
      context.beginPath();
      context.moveTo(x, area.y);
      context.lineTo(x, area.y + area.h);
      context.stroke();
      const isRight = x > area.x + 0.6 * area.w;
      context.textAlign = isRight ? "right" : "left";
      context.fillText(mark.name, x + (isRight ? -4 : 4), area.y + 11, isRight ? x - area.x - 8 : area.x + area.w - x - 8);
    }
    context.restore();
  }

  // The line of the instant that is shown, over the picture.
  function makeCursor(element, graph) {
    const line = document.createElement("i");
    line.className = "cursor";
    element.append(line);
    return () => {
      const [from, to] = graph.xAxisRange();
      line.hidden = carom.t === null || carom.t < from || carom.t > to;
      if (line.hidden) return;
      const area = graph.getArea();
      line.style.cssText = `left: ${graph.toDomXCoord(carom.t)}px; top: ${area.y}px; height: ${area.h}px`;
    };
  }

  // Draws a chart; what is returned takes it away again.
  function draw(element, chart) {
    let placeCursor = null;
    const isCrowded = chart.curves.length > 5;
    const legend = makeLegend(element.parentElement.querySelector(".legend"), chart);
    const power = chart.power;
    const labels = ["t", ...chart.curves.map((c, k) => k + " " + c.name)];
    const series = {};
    chart.curves.forEach((c, k) => {
      series[labels[k + 1]] = isCrowded && c.kind === "computed" ? { strokeWidth: 1.2 } : stroke[c.kind];
    });
    const show = (t, row) => {
      for (const l of legend) l.value.textContent = row === null ? "" : short(row[l.k + 1], power);
      time.textContent = t === null ? "" : "t = " + short(t, data.time_power) + " " + data.time_unit;
    };
    const time = document.createElement("output");
    const content = rows(chart);
    const graph = new Dygraph(element, content, {
      labels, series, visibility: chart.curves.map((c) => c.shown), legend: "never", connectSeparatedPoints: true, animatedZooms: false, rightGap: 12, yRangePad: data.marks.length > 0 ? 18 : 8,
      xlabel: axisTitle("time", data.time_unit), ylabel: axisTitle(chart.label, chart.unit),
      xLabelHeight: 18, yLabelWidth: 18, highlightCircleSize: 3, labelsKMB: false, includeZero: false,
      axes: {
        x: { axisLabelFormatter: tick(data.time_power), pixelsPerLabel: 70 },
        y: { axisLabelFormatter: tick(power), axisLabelWidth: 52, pixelsPerLabel: 36, ...(chart.count ? { ticker: wholeTicks } : {}) },
      },
      underlayCallback: drawMarks,
      highlightCallback: (event, x, points, row) => show(x, content[row]),
      unhighlightCallback: () => show(null, null),
      clickCallback: (event, t) => carom.show(t),
      drawCallback: (g, first) => {
        if (placeCursor) placeCursor();
        if (!first) follow(g, g.isZoomed("x") ? g.xAxisRange() : null);
      },
      ...theme(chart),
    });
    element.parentElement.querySelector(".legend").append(time);
    for (const l of legend) {
      l.button.addEventListener("click", () => {
        const on = l.button.getAttribute("aria-pressed") !== "true";
        l.button.setAttribute("aria-pressed", String(on));
        graph.setVisibility(l.k, on);
      });
    }
    const own = { graph, chart, legend };
    drawn.push(own);
    paint(own);
    const caption = element.parentElement.querySelector("figcaption"), title = caption.firstChild.textContent.trim();
    carom.addExports(caption, () => ({
      title, chart, graph, rows: content, colours: colours(chart).map((c, k) => (chart.curves[k].kind === "exact" ? "#333" : c)), time: { unit: data.time_unit, power: data.time_power },
      shown: chart.curves.map((_, k) => k).filter((k) => graph.visibility()[k]),
    }));
    placeCursor = makeCursor(element, graph);
    own.placeCursor = placeCursor;
    placeCursor();
    return () => {
      drawn.splice(drawn.indexOf(own), 1);
      graph.destroy();
    };
  }

  function theme(chart) {
    return { colors: colours(chart), gridLineColor: css("--grid"), gridLineWidth: 0.6, axisLineColor: css("--line") };
  }

  function paint(d) {
    const own = colours(d.chart);
    for (const l of d.legend) l.line.style.borderColor = own[l.k];
  }

  function repaint() {
    syncing = true;
    for (const d of drawn) {
      d.graph.updateOptions(theme(d.chart));
      paint(d);
    }
    syncing = false;
  }

  for (const element of document.querySelectorAll("[data-chart]")) draw(element, data.charts[Number(element.dataset.chart)]);
  carom.drawChart = draw;
  carom.follow(() => {
    for (const d of drawn) d.placeCursor();
  });
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  // A canvas cannot be drawn again while the page is printed: the style turns dark ones light (page.css).
  const mark = () => document.documentElement.classList.toggle("drawn-dark", dark.matches);
  dark.addEventListener("change", () => {
    repaint();
    mark();
  });
  mark();
})();
