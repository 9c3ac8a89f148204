// The picture of a view where a browser has no WebGL: the same surfaces, drawn from the back to the front.
carom.drawStill = (function () {
  "use strict";

  // Directions right and up on the picture, and towards the eye.
  function axes(isPlane) {
    if (isPlane) return [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    const normalized = (v) => v.map((x) => x / Math.hypot(...v));
    const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    const eye = normalized([1, -1.4, 0.8]), right = normalized(cross([0, 0, 1], eye));
    return [right, cross(eye, right), eye];
  }

  const dot = (a, x, y, z) => a[0] * x + a[1] * y + a[2] * z;

  return function (canvas, models, { frame, scale, colouring, edges, centre, reach, isPlane }) {
    const context = canvas.getContext("2d");
    const [right, up, eye] = axes(isPlane);
    const unit = Math.min(canvas.width, canvas.height) / (2.1 * reach);
    context.clearRect(0, 0, canvas.width, canvas.height);
    const faces = [];
    for (const { scene, isObstacle, hidden } of models) {
      const at = carom.positions(scene, frame, scale);
      const places = !isObstacle && colouring.field ? colouring.places(frame) : null;
      for (let k = 0; k < scene.triangles; k++) {
        const part = scene.part[scene.cell[k]];
        if (hidden.has(part) || !scene.isSeen(k, frame)) continue;
        const nodes = [0, 1, 2].map((a) => scene.node[a][k]);
        const points = nodes.map((n) => [at[0][n] - centre[0], at[1][n] - centre[1], at[2][n] - centre[2]]);
        const place = places ? (colouring.field.at === "cell" ? places[scene.cell[k]] : (places[nodes[0]] + places[nodes[1]] + places[nodes[2]]) / 3) : 0;
        const depth = points.reduce((sum, p) => sum + dot(eye, ...p), 0);
        const xy = points.map((p) => [canvas.width / 2 + unit * dot(right, ...p), canvas.height / 2 - unit * dot(up, ...p)]);
        const turn = (xy[1][0] - xy[0][0]) * (xy[2][1] - xy[0][1]) - (xy[1][1] - xy[0][1]) * (xy[2][0] - xy[0][0]);
        const longest = Math.max(...[0, 1, 2].map((a) => Math.hypot(...points[a].map((x, c) => x - points[(a + 1) % 3][c]))));
        const light = 0.65 + 0.35 * Math.min(1, Math.abs(turn) / (unit * longest) ** 2);
        const colour = (isObstacle ? carom.Colouring.palettes.none : colouring.colour(place, part)).map((c) => Math.round(c * light));
        faces.push({ xy, depth, colour: "rgb(" + colour + ")", isObstacle, edges: scene.edges[k] });
      }
    }
    faces.sort((a, b) => a.depth - b.depth);
    for (const face of faces) {
      context.beginPath();
      face.xy.forEach(([x, y], a) => (a === 0 ? context.moveTo(x, y) : context.lineTo(x, y)));
      context.closePath();
      context.globalAlpha = face.isObstacle ? 0.35 : 1;
      context.fillStyle = context.strokeStyle = face.colour;
      context.lineWidth = 0.7;
      context.fill();
      if (!face.isObstacle) context.stroke();  // closes the hair lines between triangles
      context.strokeStyle = "rgba(0, 0, 0, 0.5)";
      context.beginPath();
      for (let e = 0; e < 3; e++) {
        if (!edges || !(face.edges & (1 << e))) continue;
        context.moveTo(...face.xy[e]);
        context.lineTo(...face.xy[(e + 1) % 3]);
      }
      context.stroke();
    }
    context.globalAlpha = 1;
  };
})();
