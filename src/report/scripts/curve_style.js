// How curves look: their colours and widths of line.
(function () {
  "use strict";
  const { css } = carom;

  // Of curves that have one colour in all charts, those that lie below others of it and of the same dashes are paler:
  // opacities in hexadecimal.
  const PALER = ["", "b8", "80", "58"];

  function ownColour(curves, k) {
    const { colour, line, shown } = curves[k], above = curves.slice(k + 1).filter((c) => c.colour === colour && c.line === line && c.shown).length;
    return css("--curve-" + ((colour % 8) + 1)) + PALER[shown ? Math.min(above, PALER.length - 1) : PALER.length - 1];
  }

  // Exact curves are dashes in the colour of text: they lie over the computed curve of any colour. A filtered curve has
  // the colour of the raw one below it, which is pale.
  carom.curveColours = function (curves) {
    const numbered = curves.filter((c) => c.kind === "computed" || c.kind === "raw").map((c) => c.name);
    return curves.map((c, k) => {
      if (c.colour !== undefined) return ownColour(curves, k);
      if (c.kind === "exact" || /(^|: )total: /.test(c.name)) return css("--ink");
      const own = css("--curve-" + ((numbered.indexOf(c.name.replace(/, filtered$/, "")) % 8) + 1));
      return c.kind === "raw" ? own + "70" : own;
    });
  };

  carom.chartTheme = (chart) => ({
    colors: carom.curveColours(chart.curves), gridLineColor: css("--grid"), gridLineWidth: 0.6, axisLineColor: css("--line"),
  });

  const strokes = {
    computed: { strokeWidth: 2 }, raw: { strokeWidth: 1 }, filtered: { strokeWidth: 2 }, exact: { strokePattern: [6, 5], strokeWidth: 1.3 },
  };

  // Dashes and gaps in pixels, by the number of a line.
  const DASHES = [[], [9, 4], [3, 3], [11, 4, 3, 4], [6, 3, 2, 3, 2, 3], [16, 4]];

  // Many curves are thinner.
  carom.curveStroke = function (curve, count) {
    const stroke = count > 5 && curve.kind === "computed" ? { strokeWidth: 1.2 } : strokes[curve.kind];
    return curve.line === undefined ? stroke : { ...stroke, strokePattern: DASHES[curve.line % DASHES.length] };
  };

  carom.curveDashes = (curve) => (carom.curveStroke(curve, 1).strokePattern || []).join(" ");
})();
