// A chart as a file: SVG and PNG as it is shown (zoom and curves), CSV of what is shown.
carom.addExports = (function () {
  "use strict";
  const WIDTH = 800, HEIGHT = 420, LEFT = 78, RIGHT = 16, TOP = 34, BOTTOM = 52, LINE = 18;
  const escaped = (text) => text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;");

  function save(name, type, content) {
    const url = URL.createObjectURL(new Blob([content], { type }));
    Object.assign(document.createElement("a"), { href: url, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(url), 10000);
  }

  // Pieces of a curve between gaps, within the times shown and one point beyond on each side.
  function pieces(rows, k, from, to) {
    const found = [];
    let piece = [];
    rows.forEach((row, i) => {
      const near = (j) => j >= 0 && j < rows.length && rows[j][0] >= from && rows[j][0] <= to;
      const isSeen = near(i) || near(i - 1) || near(i + 1);
      if (isSeen && row[k + 1] !== null) piece.push([row[0], row[k + 1]]);
      else if (row[k + 1] !== null && piece.length > 0) {
        found.push(piece);
        piece = [];
      }
    });
    return piece.length > 0 ? [...found, piece] : found;
  }

  function svg({ title, chart, graph, rows, colours, time, shown }) {
    const [from, to] = graph.xAxisRange(), [low, high] = graph.yAxisRange();
    const legendLines = Math.ceil(shown.length / 3);
    const height = HEIGHT + LINE * legendLines, bottom = HEIGHT - BOTTOM;
    const x = (t) => LEFT + ((t - from) / (to - from)) * (WIDTH - LEFT - RIGHT);
    const y = (v) => bottom - ((v - low) / (high - low)) * (bottom - TOP);
    const text = (at, words, more) => `<text x="${at[0].toFixed(1)}" y="${at[1].toFixed(1)}" ${more || ""}>${escaped(words)}</text>`;
    const number = (v, power) => String(Number((v / Math.pow(10, power)).toPrecision(6)));
    const ticks = (low_, high_, pixels) => Dygraph.numericTicks(low_, high_, pixels, (n) => (n === "pixelsPerLabel" ? 70 : n === "axisLabelFormatter" ? String : null), {}, null).filter((t) => t.v >= low_ && t.v <= high_);
    const grid = [
      ...ticks(from, to, WIDTH).map((t) => `<path class="grid" d="M${x(t.v)} ${TOP}V${bottom}"/>` + text([x(t.v), bottom + 16], number(t.v, time.power), 'text-anchor="middle"')),
      ...ticks(low, high, HEIGHT).map((t) => `<path class="grid" d="M${LEFT} ${y(t.v)}H${WIDTH - RIGHT}"/>` + text([LEFT - 6, y(t.v) + 4], number(t.v, chart.power), 'text-anchor="end"')),
    ];
    const curves = shown.flatMap((k) => pieces(rows, k, from, to).map((piece) =>
      `<path d="M${piece.map(([t, v]) => x(t).toFixed(2) + " " + y(v).toFixed(2)).join("L")}" stroke="${colours[k]}" stroke-width="${chart.curves[k].kind === "raw" ? 1 : 2}"${chart.curves[k].kind === "exact" ? ' stroke-dasharray="6 5"' : ""}/>`));
    const legend = shown.map((k, i) => {
      const at = [LEFT + (i % 3) * 230, HEIGHT + 4 + LINE * Math.floor(i / 3)];
      return `<path d="M${at[0]} ${at[1]}h22" stroke="${colours[k]}" stroke-width="2"/>` + text([at[0] + 28, at[1] + 4], chart.curves[k].name);
    });
    const label = (name, unit) => (unit === "" ? name : `${name} [${unit}]`);
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${WIDTH}" height="${height}" viewBox="0 0 ${WIDTH} ${height}" font-family="system-ui, sans-serif" font-size="12">
<style>path { fill: none; stroke-linejoin: round; } .grid { stroke: #d9dcde; stroke-width: .7; }</style>
<rect width="100%" height="100%" fill="#fff"/>
${text([LEFT, 20], title, 'font-weight="600" font-size="14"')}
${grid.join("\n")}
<svg x="${LEFT}" y="${TOP}" width="${WIDTH - LEFT - RIGHT}" height="${bottom - TOP}" viewBox="${LEFT} ${TOP} ${WIDTH - LEFT - RIGHT} ${bottom - TOP}">${curves.join("\n")}</svg>
<path d="M${LEFT} ${TOP}V${bottom}H${WIDTH - RIGHT}" stroke="#555"/>
${text([(LEFT + WIDTH - RIGHT) / 2, bottom + 36], label("time", time.unit), 'text-anchor="middle"')}
${text([16, (TOP + bottom) / 2], label(chart.label, chart.unit), `text-anchor="middle" transform="rotate(-90 16 ${(TOP + bottom) / 2})"`)}
${legend.join("\n")}
</svg>`;
  }

  function png(source, name) {
    const image = new Image();
    image.onload = () => {
      const canvas = Object.assign(document.createElement("canvas"), { width: 2 * image.width, height: 2 * image.height });
      canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
      canvas.toBlob((blob) => save(name, "image/png", blob));
    };
    image.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(source);
  }

  function csv({ chart, graph, rows, time, shown }) {
    const [from, to] = graph.xAxisRange();
    const quoted = (text) => (/[",]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);
    const label = (name, unit) => quoted(unit === "" ? name : `${name} [${unit}]`);
    const head = [label("time", time.unit), ...shown.map((k) => label(chart.curves[k].name, chart.unit))];
    const number = (v, power) => (v === null ? "" : String(Number((v / Math.pow(10, power)).toPrecision(8))));
    const lines = rows.filter((row) => row[0] >= from && row[0] <= to)
      .map((row) => [number(row[0], time.power), ...shown.map((k) => number(row[k + 1], chart.power))].join(","));
    return [head.join(","), ...lines].join("\n") + "\n";
  }

  // Buttons behind the title of a figure. what(): title, chart, graph, rows, colours, time, shown curves.
  return function (caption, what) {
    const box = Object.assign(document.createElement("span"), { className: "exports" });
    const button = (text, act) => {
      const made = Object.assign(document.createElement("button"), { type: "button", textContent: text, title: "Save as " + text });
      made.addEventListener("click", () => {
        const given = what();
        act(given, (given.title.replace(/[^A-Za-z0-9]+/g, "_") || "curve") + "." + text.toLowerCase());
      });
      box.append(made);
    };
    button("SVG", (given, name) => save(name, "image/svg+xml", svg(given)));
    button("PNG", (given, name) => png(svg(given), name));
    button("CSV", (given, name) => save(name, "text/csv", csv(given)));
    caption.append(box);
  };
})();
