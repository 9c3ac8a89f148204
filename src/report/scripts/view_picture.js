// The picture of a view with what stands over it, as one canvas: for files of pictures and movies.
carom.viewPicture = (function () {
  "use strict";
  const { css } = carom;
  const TALL = 176;  // of the bar of colours, in pixels of the page

  function write(context, text, x, y, more) {
    Object.assign(context, { fillStyle: css("--ink"), textAlign: "left", textBaseline: "middle", font: "13px system-ui, sans-serif" }, more);
    context.fillText(text, x, y);
  }

  function paintLegend(context, { title, stops, ticks, above }, width) {
    const right = width - 12, top = 36, left = right - 13;
    const gradient = context.createLinearGradient(0, top + TALL, 0, top);
    stops.forEach((colour, i) => gradient.addColorStop(i / (stops.length - 1), "rgb(" + colour + ")"));
    context.fillStyle = gradient;
    context.fillRect(left, top, 13, TALL);
    write(context, title, right, 18, { textAlign: "right", font: "600 13px system-ui, sans-serif" });
    for (const { share, text } of ticks) write(context, text, left - 6, top + TALL * (1 - share), { textAlign: "right" });
    if (above) write(context, above, right, top + TALL + 16, { textAlign: "right", fillStyle: "rgb(" + carom.ColourScale.palettes.above + ")" });
  }

  // onto: a canvas that is painted over; made to the size of the view's picture.
  return function ({ canvas, overlay }, onto) {
    const width = overlay.stage.clientWidth, ratio = canvas.width / width, context = onto.getContext("2d");
    if (onto.width !== canvas.width || onto.height !== canvas.height) Object.assign(onto, { width: canvas.width, height: canvas.height });
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = css("--panel");
    context.fillRect(0, 0, onto.width, onto.height);
    context.drawImage(canvas, 0, 0);
    context.scale(ratio, ratio);
    write(context, overlay.clock.textContent, 12, 20);
    if (overlay.legend) paintLegend(context, overlay.legend, width);
    return onto;
  };
})();
