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

  // The box about such nodes in such frames, and a ball about that.
  function boxOf(scene, nodes, frames, scale) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (const t of frames) {
      carom.positions(scene, t, scale).forEach((xs, c) => {
        for (const n of nodes) {
          if (xs[n] < low[c]) low[c] = xs[n];
          if (xs[n] > high[c]) high[c] = xs[n];
        }
      });
    }
    return carom.boxAbout(low, high);
  }

  // A box and a ball about it.
  carom.boxAbout = function (low, high) {
    const reach = Math.hypot(...low.map((l, c) => high[c] - l)) / 2 || 1;
    return { low, high, reach, centre: low.map((l, c) => (l + high[c]) / 2) };
  };

  const upTo = (count) => Array.from({ length: count }, (_, i) => i);

  const MOST = 20000;  // points that a picture is fitted to

  // Some of the places of such nodes in such frames: of fewer frames, the first and the last among them, rather than of fewer
  // nodes, since of the nodes at a rim every second one may be all of the rim.
  function pointsOf(scene, nodes, frames, scale) {
    const count = Math.min(frames.length, Math.max(2, Math.floor(MOST / nodes.length))), points = [];
    const some = new Set(upTo(count).map((k) => frames[Math.round((k * (frames.length - 1)) / Math.max(1, count - 1))]));
    const step = Math.ceil((nodes.length * some.size) / MOST);
    for (const t of some) {
      const at = carom.positions(scene, t, scale);
      for (let i = 0; i < nodes.length; i += step) points.push(at.map((xs) => xs[nodes[i]]));
    }
    return points;
  }

  // The box about a scene over all times.
  carom.extentOf = function (scene) {
    const box = boxOf(scene, upTo(scene.nodes), upTo(scene.frames), 1);
    return { ...box, isPlane: !(box.high[2] - box.low[2] > 1e-9 * box.reach) };
  };

  // The nodes of the parts that are wanted.
  function nodesOf(scene, isWanted) {
    const nodes = new Set();
    for (let k = 0; k < scene.triangles; k++)
      if (isWanted(scene.part[scene.cell[k]])) for (let a = 0; a < 3; a++) nodes.add(scene.node[a][k]);
    return [...nodes];
  }

  // How far the nodes of a part go from their places, in the mean, at the instant at which that is most.
  function travelOf(scene, part) {
    const u = scene.field("displacement"), nodes = nodesOf(scene, (p) => p === part);
    if (!u) return 0;
    return Math.max(...upTo(scene.frames).map((t) =>
      nodes.reduce((sum, n) => sum + Math.hypot(...u.ranges.map((_, c) => u.value(c, t, n) || 0)), 0) / nodes.length));
  }

  // The parts that move: at least a twentieth as far as the one that goes farthest.
  carom.movingParts = function (scene) {
    const parts = [...new Set(scene.part)], travel = parts.map((part) => travelOf(scene, part)), most = Math.max(...travel);
    return new Set(parts.filter((_, i) => travel[i] >= 0.05 * most));
  };

  // By how much nodes have moved on the mean from one frame to another, of those that are there in both.
  function meanWay(scene, nodes, [from, to], scale) {
    const u = scene.field("displacement");
    if (!u) return [0, 0, 0];
    return scene.at.map((_, c) => {
      const ways = nodes.map((n) => u.value(c, to, n) - u.value(c, from, n)).filter((way) => !Number.isNaN(way));
      return ways.length === 0 ? 0 : (scale * ways.reduce((sum, way) => sum + way, 0)) / ways.length;
    });
  }

  const LEAST = 1 / 3;  // of a picture of all ways, what bodies are to fill of it

  // What a picture of this frame is fitted to: of the parts that are not hidden those that move (all where none does),
  // over all times unless they were too small on it. Then it is them as they are now, and `wayTo` another frame is how far
  // the picture goes with them.
  carom.fitOf = function (scene, frame, scale, { hidden, moving }) {
    const isMoving = (part) => moving.has(part) && !hidden.has(part), isShown = (part) => !hidden.has(part);
    const nodes = [isMoving, isShown, () => true].map((isWanted) => nodesOf(scene, isWanted)).find((list) => list.length > 0);
    const now = boxOf(scene, nodes, [frame], scale), always = boxOf(scene, nodes, upTo(scene.frames), scale);
    const isWhole = now.reach >= LEAST * always.reach, [box, frames] = isWhole ? [always, upTo(scene.frames)] : [now, [frame]];
    return { ...box, points: pointsOf(scene, nodes, frames, scale), wayTo: (to, by) => (isWhole ? [0, 0, 0] : meanWay(scene, nodes, [frame, to], by)) };
  };

  // The number of the recorded instant next to t; the earlier one of two that are as near.
  carom.nearestFrame = function (times, t) {
    let best = 0;
    for (let i = 1; i < times.length; i++) if (Math.abs(times[i] - t) < Math.abs(times[best] - t)) best = i;
    return best;
  };
})();
