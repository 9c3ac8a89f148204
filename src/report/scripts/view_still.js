// The picture of a view where a browser has no WebGL: the same surfaces, drawn from the back to the front.
carom.StillDrawing = (function () {
  "use strict";
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const normalized = (v) => v.map((x) => x / Math.hypot(...v));

  // Directions right and up on the picture, and towards the eye.
  function axes(isPlane) {
    if (isPlane) return [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    const eye = normalized([1, -1.4, 0.8]), right = normalized(cross([0, 0, 1], eye));
    return [right, cross(eye, right), eye];
  }

  // How bright a triangle is that stands so to the picture: its area there, with sides of this length in space.
  function light(xy, points) {
    const turn = (xy[1][0] - xy[0][0]) * (xy[2][1] - xy[0][1]) - (xy[1][1] - xy[0][1]) * (xy[2][0] - xy[0][0]);
    const longest = Math.max(...[0, 1, 2].map((a) => Math.hypot(...points[a].map((x, c) => x - points[(a + 1) % 3][c]))));
    return 0.65 + 0.35 * Math.min(1, Math.abs(turn) / longest ** 2);
  }

  // The triangles of a scene that are seen: corners to the right and upward of the centre, how near the eye, colour.
  function facesOf({ scene, isObstacle, hidden }, { frame, scale, colouring }, { centre, isPlane }) {
    const [right, up, eye] = axes(isPlane);
    const at = carom.positions(scene, frame, scale);
    const places = !isObstacle && colouring.field ? colouring.places(frame) : null;
    const faces = [];
    for (let k = 0; k < scene.triangles; k++) {
      const part = scene.part[scene.cell[k]];
      if (hidden.has(part) || !scene.isSeen(k, frame)) continue;
      const nodes = [0, 1, 2].map((a) => scene.node[a][k]);
      const points = nodes.map((n) => [at[0][n] - centre[0], at[1][n] - centre[1], at[2][n] - centre[2]]);
      const xy = points.map((p) => [dot(right, p), dot(up, p)]), brightness = light(xy, points);
      const place = places ? (places[3 * k] + places[3 * k + 1] + places[3 * k + 2]) / 3 : 0;
      const colour = (isObstacle ? carom.ColourScale.palettes.none : colouring.colour(place, part)).map((c) => Math.round(c * brightness));
      faces.push({ xy, depth: points.reduce((sum, p) => sum + dot(eye, p), 0), colour: "rgb(" + colour + ")", isObstacle, edges: scene.edges[k], width: carom.CellEdges.widthOf(scene, k) });
    }
    return faces;
  }

  function drawFace(context, { xy, colour, isObstacle, edges }, withEdges) {
    context.beginPath();
    xy.forEach(([x, y], a) => (a === 0 ? context.moveTo(x, y) : context.lineTo(x, y)));
    context.closePath();
    context.globalAlpha = isObstacle ? 0.35 : 1;
    context.fillStyle = context.strokeStyle = colour;
    context.lineWidth = 0.7;
    context.fill();
    if (!isObstacle) context.stroke();  // closes the hair lines between triangles
    if (!withEdges) return;
    context.strokeStyle = "rgba(0, 0, 0, 0.5)";
    context.beginPath();
    for (let e = 0; e < 3; e++) {
      if (!(edges & (1 << e))) continue;
      context.moveTo(...xy[e]);
      context.lineTo(...xy[(e + 1) % 3]);
    }
    context.stroke();
  }

  class StillDrawing {
    constructor(canvas, scenes, extent) {
      Object.assign(this, { canvas, extent });
      this.models = scenes.map((scene, s) => ({ scene, isObstacle: s > 0, hidden: new Set() }));
    }

    resize(width, height) {
      const ratio = Math.min(window.devicePixelRatio, 2);
      this.canvas.width = width * ratio;
      this.canvas.height = height * ratio;
    }

    // What the picture is fitted to.
    fit(box) {
      this.extent = { ...box, isPlane: this.extent.isPlane };
    }

    shift(way) {
      this.extent.centre = this.extent.centre.map((x, c) => x + way[c]);
    }

    sight(frame) {
      const [{ scene, hidden }] = this.models;
      return (k) => !hidden.has(scene.part[scene.cell[k]]) && scene.isSeen(k, frame);
    }

    show(what) {
      const { width, height } = this.canvas, context = this.canvas.getContext("2d");
      const unit = Math.min(width, height) / (2.1 * this.extent.reach);
      context.clearRect(0, 0, width, height);
      const faces = this.models.flatMap((model) => facesOf(model, what, this.extent)).sort((a, b) => a.depth - b.depth);
      const ratio = width / (this.canvas.clientWidth || width);
      for (const face of faces) {
        const xy = face.xy.map(([x, y]) => [width / 2 + unit * x, height / 2 - unit * y]);
        drawFace(context, { ...face, xy }, what.edges && unit * face.width >= carom.CellEdges.LEAST * ratio);
      }
      context.globalAlpha = 1;
    }
  }

  return Object.assign(StillDrawing, { axes, facesOf });
})();
