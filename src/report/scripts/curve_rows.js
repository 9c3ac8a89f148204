// The curves of one chart as rows: a time, and the value of every curve at that time.
(function () {
  "use strict";

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

  carom.curveRows = function (curves) {
    const times = [...new Set(curves.flatMap((c) => c.t))].sort((a, b) => a - b);
    const columns = curves.map((c) => resample(c, times));
    return times.map((t, i) => [t, ...columns.map((c) => c[i])]);
  };

  // The points of curve k within the times shown, and one beyond on each side, so that its line goes to the edge.
  carom.curvePoints = function (rows, k, from, to) {
    const points = rows.filter((row) => row[k + 1] !== null).map((row) => [row[0], row[k + 1]]);
    const begin = points.filter(([t]) => t <= from).length - 1, end = points.findIndex(([t]) => t >= to);
    return points.slice(Math.max(0, begin), end < 0 ? points.length : end + 1);
  };
})();
