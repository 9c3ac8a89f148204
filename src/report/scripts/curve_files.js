// A chart as the text of a file, as it is shown (zoom and curves): SVG, or CSV. Both are made from title, chart, window
// (its ends [from, to] in time and [low, high] in value, ticks of both), rows, colours, time and the curves shown.
(function () {
  "use strict";
  const WIDTH = 800, HEIGHT = 420, LEFT = 78, RIGHT = 16, TOP = 34, BOTTOM = 52, LINE = 18;
  const bottom = HEIGHT - BOTTOM;
  const escaped = (text) => text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;");
  const svgText = (at, words, more) => `<text x="${at[0].toFixed(1)}" y="${at[1].toFixed(1)}" ${more || ""}>${escaped(words)}</text>`;

  // Where a time and a value are on the picture.
  function places({ from, to, low, high }) {
    return {
      x: (t) => LEFT + ((t - from) / (to - from)) * (WIDTH - LEFT - RIGHT),
      y: (v) => bottom - ((v - low) / (high - low)) * (bottom - TOP),
    };
  }

  function grid({ x, y }, { chart, time, window }) {
    return [
      ...window.timeTicks.map((t) => `<path class="grid" d="M${x(t)} ${TOP}V${bottom}"/>` + svgText([x(t), bottom + 16], carom.digits(t, time.power, 6), 'text-anchor="middle"')),
      ...window.valueTicks.map((v) => `<path class="grid" d="M${LEFT} ${y(v)}H${WIDTH - RIGHT}"/>` + svgText([LEFT - 6, y(v) + 4], carom.digits(v, chart.power, 6), 'text-anchor="end"')),
    ];
  }

  const dashes = (curve) => (carom.curveDashes(curve) ? ` stroke-dasharray="${carom.curveDashes(curve)}"` : "");

  function lines({ x, y }, { chart, window, rows, colours, shown }) {
    return shown.map((k) => {
      const points = carom.curvePoints(rows, k, window.from, window.to).map(([t, v]) => x(t).toFixed(2) + " " + y(v).toFixed(2));
      const curve = chart.curves[k];
      return points.length > 0 ? `<path d="M${points.join("L")}" stroke="${colours[k]}" stroke-width="${curve.kind === "raw" ? 1 : 2}"${dashes(curve)}/>` : "";
    });
  }

  function legend({ chart, colours, shown }) {
    return shown.map((k, i) => {
      const at = [LEFT + (i % 3) * 230, HEIGHT + 4 + LINE * Math.floor(i / 3)];
      return `<path d="M${at[0]} ${at[1]}h22" stroke="${colours[k]}" stroke-width="2"${dashes(chart.curves[k])}/>` + svgText([at[0] + 28, at[1] + 4], chart.curves[k].name);
    });
  }

  carom.chartSvg = function (what) {
    const { title, chart, time, shown, window } = what, scale = places(window);
    const height = HEIGHT + LINE * Math.ceil(shown.length / 3);
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${WIDTH}" height="${height}" viewBox="0 0 ${WIDTH} ${height}" font-family="system-ui, sans-serif" font-size="12">
<style>path { fill: none; stroke-linejoin: round; } .grid { stroke: #d9dcde; stroke-width: .7; }</style>
<rect width="100%" height="100%" fill="#fff"/>
${svgText([LEFT, 20], title, 'font-weight="600" font-size="14"')}
${grid(scale, what).join("\n")}
<svg x="${LEFT}" y="${TOP}" width="${WIDTH - LEFT - RIGHT}" height="${bottom - TOP}" viewBox="${LEFT} ${TOP} ${WIDTH - LEFT - RIGHT} ${bottom - TOP}">${lines(scale, what).join("\n")}</svg>
<path d="M${LEFT} ${TOP}V${bottom}H${WIDTH - RIGHT}" stroke="#555"/>
${svgText([(LEFT + WIDTH - RIGHT) / 2, bottom + 36], carom.axisTitle("time", time.unit), 'text-anchor="middle"')}
${svgText([16, (TOP + bottom) / 2], carom.axisTitle(chart.label, chart.unit), `text-anchor="middle" transform="rotate(-90 16 ${(TOP + bottom) / 2})"`)}
${legend(what).join("\n")}
</svg>`;
  };

  // A field with a comma or a quotation mark is quoted (RFC 4180).
  const quoted = (text) => (/[",]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);

  carom.chartCsv = function ({ chart, window, rows, time, shown }) {
    const title = (name, unit) => quoted(carom.axisTitle(name, unit));
    const number = (v, power) => (v === null ? "" : carom.digits(v, power, 8));
    const head = [title("time", time.unit), ...shown.map((k) => title(chart.curves[k].name, chart.unit))];
    const lines_ = rows.filter((row) => row[0] >= window.from && row[0] <= window.to)
      .map((row) => [number(row[0], time.power), ...shown.map((k) => number(row[k + 1], chart.power))].join(","));
    return [head.join(","), ...lines_].join("\n") + "\n";
  };

  // What the picture of a chart has room for; of values between these ends.
  const ticks = (low, high, pixels) => Dygraph.numericTicks(low, high, pixels, (n) => (n === "pixelsPerLabel" ? 70 : n === "axisLabelFormatter" ? String : null), {}, null)
    .map((t) => t.v).filter((v) => v >= low && v <= high);

  // The part of a chart that its graph shows.
  carom.chartWindow = function (graph) {
    const [from, to] = graph.xAxisRange(), [low, high] = graph.yAxisRange();
    return { from, to, low, high, timeTicks: ticks(from, to, WIDTH), valueTicks: ticks(low, high, HEIGHT) };
  };
})();
