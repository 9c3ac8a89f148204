// Halves of bodies that a plane of symmetry has left out: where such planes are, and the pictures in them.
carom.Mirrors = (function () {
  "use strict";
  const AXES = ["x", "y", "z"];

  // All nodes at this end of the bodies stay in their plane, and some move in it: else the end is just held.
  function isSymmetry(scene, u, axis, end) {
    const xs = scene.at[axis], size = u.ranges.map(([low, high]) => Math.max(-low, high)), most = Math.max(...size);
    const slack = 1e-9 * most + (2 * (u.ranges[axis][1] - u.ranges[axis][0])) / 65534, nodes = [];
    for (let n = 0; n < scene.nodes; n++) if (Math.abs(xs[n] - end.at) <= 1e-6 * end.length) nodes.push(n);
    let within = 0;
    for (let t = 0; t < scene.frames; t++) {
      for (const n of nodes) {
        const here = [0, 1, 2].map((c) => u.value(c, t, n) || 0);
        if (Math.abs(here[axis]) > slack) return false;
        within = Math.max(within, ...here.map(Math.abs));
      }
    }
    return nodes.length > 1 && most > 0 && within > 1e-3 * most;
  }

  // The planes across an axis at which bodies seem to go on: axis, where, and a name. What moves along an axis nowhere has
  // none across it.
  function planesOf(scene) {
    const u = scene.field("displacement");
    if (!u || u.ranges.length !== 3) return [];
    const size = u.ranges.map(([low, high]) => Math.max(-low, high)), most = Math.max(...size);
    return AXES.flatMap((name, axis) => {
      const [low, high] = endsOf(scene.at[axis]);
      if (!(high > low) || size[axis] <= 1e-3 * most) return [];
      const found = [low, high].filter((at) => isSymmetry(scene, u, axis, { at, length: high - low }));
      return found.map((at) => ({ axis, at, name: found.length < 2 ? name : (at === low ? "low " : "high ") + name }));
    });
  }

  function endsOf(xs) {
    let low = Infinity, high = -Infinity;
    for (const x of xs) {
      if (x < low) low = x;
      if (x > high) high = x;
    }
    return [low, high];
  }

  function reflection({ axis, at }) {
    const scale = new THREE.Vector3(1, 1, 1).setComponent(axis, -1), shift = new THREE.Vector3().setComponent(axis, 2 * at);
    return new THREE.Matrix4().compose(shift, new THREE.Quaternion(), scale);
  }

  // Where the pictures are: one for each choice of some of the planes.
  function imagesOf(planes) {
    let all = [new THREE.Matrix4()];
    for (const plane of planes) all = [...all, ...all.map((m) => reflection(plane).multiply(m))];
    return all.slice(1);
  }

  // Draws an object in all of these places as well; it takes its pictures along when it is hidden.
  function repeat(object, images) {
    object.remove(...object.children);
    const copies = images.map((matrix) => Object.assign(object.clone(), { matrix, matrixAutoUpdate: false, matrixWorldNeedsUpdate: true }));
    if (copies.length > 0) object.add(...copies);
  }

  // A box with its points, and its pictures; across a plane they go apart, and the picture goes with none of them.
  function widened(box, planes) {
    const low = [...box.low], high = [...box.high];
    const isMirrored = new Set([...planes].map(({ axis }) => axis));
    let { points } = box;
    for (const { axis, at } of planes) {
      [low[axis], high[axis]] = [Math.min(low[axis], 2 * at - high[axis]), Math.max(high[axis], 2 * at - low[axis])];
      points = [...points, ...points.map((point) => point.map((x, c) => (c === axis ? 2 * at - x : x)))];
    }
    const wayTo = (...given) => box.wayTo(...given).map((way, c) => (isMirrored.has(c) ? 0 : way));
    return { ...carom.boxAbout(low, high), points, wayTo };
  }

  // The planes beyond which no node is.
  function oneSided(scene, planes) {
    return planes.filter(({ axis, at }) => {
      const [low, high] = endsOf(scene.at[axis]), slack = 1e-6 * (high - low);
      return low >= at - slack || high <= at + slack;
    });
  }

  return { planesOf, oneSided, imagesOf, repeat, widened };
})();
