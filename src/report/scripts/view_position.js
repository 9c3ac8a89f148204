// Where the nodes of a scene are: reference and displacement times a scale.
(function () {
  "use strict";

  // One node; NaN once it has gone with its cells.
  carom.positionOf = function (scene, frame, node, scale = 1) {
    const u = scene.field("displacement");
    return scene.at.map((xs, c) => xs[node] + (u ? scale * u.value(c, frame, node) : 0));
  };

  // All of them by component; those that have gone are at rest, where nothing is drawn.
  carom.positions = function (scene, frame, scale) {
    const u = scene.field("displacement");
    return scene.at.map((xs, c) => (u ? xs.map((x, i) => x + scale * (u.value(c, frame, i) || 0)) : xs));
  };

  // The box about a scene over all times, and a ball about that: what "fit" shows.
  carom.extentOf = function (scene) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (let t = 0; t < scene.frames; t++) {
      carom.positions(scene, t, 1).forEach((xs, c) => {
        for (const x of xs) {
          if (x < low[c]) low[c] = x;
          if (x > high[c]) high[c] = x;
        }
      });
    }
    const reach = Math.hypot(...low.map((l, c) => high[c] - l)) / 2 || 1;
    return { low, high, reach, centre: low.map((l, c) => (l + high[c]) / 2), isPlane: !(high[2] - low[2] > 1e-9 * reach) };
  };

  // The number of the recorded instant next to t; the earlier one of two that are as near.
  carom.nearestFrame = function (times, t) {
    let best = 0;
    for (let i = 1; i < times.length; i++) if (Math.abs(times[i] - t) < Math.abs(times[best] - t)) best = i;
    return best;
  };
})();
