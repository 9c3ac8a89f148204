// Draws the charts of the page with dygraphs. All of them share the time axis: zooming one zooms all.
(function () {
  "use strict";
  const data = JSON.parse(document.getElementById("charts").textContent);
  const { css, short } = carom;
  const drawn = [];
  let syncing = false;

  function follow(source, window_) {
    if (syncing) return;
    syncing = true;
    for (const d of drawn) if (d.graph !== source) d.graph.updateOptions({ dateWindow: window_ });
    syncing = false;
  }

  const tick = (power) => (v) => carom.digits(v, power, 6);

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

  function options(chart, own) {
    const { curves, power } = chart;
    const labels = ["t", ...curves.map((c, k) => k + " " + c.name)];
    const series = {};
    curves.forEach((c, k) => (series[labels[k + 1]] = carom.curveStroke(c, curves.length)));
    return {
      labels, series, visibility: curves.map((c) => c.shown), legend: "never", connectSeparatedPoints: true, animatedZooms: false, rightGap: 12, yRangePad: data.marks.length > 0 ? 18 : 8,
      xlabel: carom.axisTitle("time", data.time_unit), ylabel: carom.axisTitle(chart.label, chart.unit),
      xLabelHeight: 18, yLabelWidth: 18, highlightCircleSize: 3, labelsKMB: false, includeZero: false,
      axes: {
        x: { axisLabelFormatter: tick(data.time_power), pixelsPerLabel: 70 },
        y: { axisLabelFormatter: tick(power), axisLabelWidth: 52, pixelsPerLabel: 36, ...(chart.count ? { ticker: wholeTicks } : {}) },
      },
      underlayCallback: drawMarks,
      highlightCallback: (event, t, points, row) =>
        own.legend.show("t = " + short(t, data.time_power) + " " + data.time_unit, own.rows[row].slice(1).map((y) => short(y, power))),
      unhighlightCallback: () => own.legend.show("", curves.map(() => "")),
      clickCallback: (event, t) => carom.show(t),
      drawCallback: (g, first) => {
        if (own.placeCursor) own.placeCursor();
        if (!first) follow(g, g.isZoomed("x") ? g.xAxisRange() : null);
      },
      ...carom.chartTheme(chart),
    };
  }

  function paint(own) {
    own.legend.paint(carom.curveColours(own.chart.curves));
  }

  // What the files of a chart are made from.
  function shownOf({ chart, graph, rows }, title) {
    const { curves } = chart;
    return {
      title, chart, rows, window: carom.chartWindow(graph), time: { unit: data.time_unit, power: data.time_power },
      colours: carom.curveColours(curves).map((c, k) => (curves[k].kind === "exact" ? "#333" : c)),
      shown: curves.map((_, k) => k).filter((k) => graph.visibility()[k]),
    };
  }

  // Draws a chart; what is returned takes it away again.
  function draw(element, chart) {
    const figure = element.parentElement;
    const own = { chart, rows: carom.curveRows(chart.curves), legend: new carom.CurveLegend(figure.querySelector(".legend"), chart.curves) };
    own.graph = new Dygraph(element, own.rows, options(chart, own));
    own.legend.listen((k, on) => own.graph.setVisibility(k, on));
    drawn.push(own);
    paint(own);
    const caption = figure.querySelector("figcaption"), title = (own.title = caption.firstChild.textContent.trim());
    carom.addExports(caption, () => {
      const what = shownOf(own, title);
      return { title, svg: () => carom.chartSvg(what), csv: () => carom.chartCsv(what) };
    });
    own.placeCursor = makeCursor(element, own.graph);
    own.placeCursor();
    return () => {
      drawn.splice(drawn.indexOf(own), 1);
      own.graph.destroy();
    };
  }

  function repaint() {
    syncing = true;
    for (const d of drawn) {
      d.graph.updateOptions(carom.chartTheme(d.chart));
      paint(d);
    }
    syncing = false;
  }

  for (const element of document.querySelectorAll("[data-chart]")) draw(element, data.charts[Number(element.dataset.chart)]);
  carom.drawChart = draw;
  carom.follow(() => {
    for (const d of drawn) d.placeCursor();
  });
  function redraw() {
    repaint();
    syncing = true;
    for (const d of drawn) {
      d.graph.resize();
      d.placeCursor();
    }
    syncing = false;
  }

  // A page that reads itself again keeps what its reader has chosen.
  syncing = true;
  if (document.querySelector("meta[http-equiv=refresh]")) carom.keepCharts(drawn);
  syncing = false;
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", repaint);
  carom.onPrint(redraw);
  // What is unfolded had no size to be drawn in before.
  for (const folded of document.querySelectorAll("details.asked")) folded.addEventListener("toggle", redraw);
})();
