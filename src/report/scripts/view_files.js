// Buttons of a view that save what it shows (a picture, a movie, every frame) or fill the screen with it.
carom.viewFiles = (function () {
  "use strict";
  const { create } = carom;
  const TYPES = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"];
  const wait = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));
  const blobOf = (canvas) => new Promise((done) => canvas.toBlob(done));

  // Shows every frame and does something with its picture; then the view is where it was.
  async function eachFrame(view, act) {
    const { player } = view, before = player.frame, canvas = create("canvas");
    player.pause();
    for (let frame = 0; frame <= player.last; frame++) {
      player.goTo(frame);
      await act(carom.viewPicture(view, canvas), frame);
    }
    player.goTo(before);
  }

  // The whole run in the time that playing it takes, recorded by the browser.
  async function movie(view) {
    const canvas = carom.viewPicture(view, create("canvas")), { player } = view;
    const recorder = new MediaRecorder(canvas.captureStream(), { mimeType: TYPES.find((type) => MediaRecorder.isTypeSupported(type)), videoBitsPerSecond: 8e6 });
    const pieces = [], ended = new Promise((done) => (recorder.onstop = done));
    recorder.ondataavailable = ({ data }) => pieces.push(data);
    recorder.start();
    const context = canvas.getContext("2d"), pause = Math.max(40, (1000 * player.speed.value) / player.times.length);
    await eachFrame(view, async (painted) => {
      context.setTransform(1, 0, 0, 1, 0, 0);
      context.drawImage(painted, 0, 0);
      await wait(pause);
    });
    recorder.stop();
    await ended;
    carom.saveFile("movie.webm", "video/webm", pieces);
  }

  async function frames(view) {
    const files = [];
    await eachFrame(view, async (painted, frame) => {
      const bytes = new Uint8Array(await (await blobOf(painted)).arrayBuffer());
      files.push({ name: `frame_${String(frame).padStart(4, "0")}.png`, bytes });
    });
    carom.saveFile("frames.zip", "application/zip", carom.zipFile(files));
  }

  async function picture(view) {
    view.draw();
    carom.saveFile("view.png", "image/png", [await blobOf(carom.viewPicture(view, create("canvas")))]);
  }

  function fillScreen({ section }) {
    return document.fullscreenElement ? document.exitFullscreen() : section.requestFullscreen();
  }

  // A button that can be pressed again when its work is done.
  function workButton(view, [name, title, work]) {
    const own = create("button", { type: "button", textContent: name, title });
    own.addEventListener("click", async () => {
      own.disabled = true;
      try {
        await work(view);
      } finally {
        own.disabled = false;
      }
    });
    return own;
  }

  // Movies need a browser that records, full screen one that has it.
  return function (view) {
    const buttons = [["PNG", "Save the picture", picture], ["frames", "Save every frame as PNG, in one .zip", frames]];
    if (window.MediaRecorder && HTMLCanvasElement.prototype.captureStream) buttons.push(["movie", "Save a movie (WebM) of the whole run at the speed that is chosen", movie]);
    if (document.fullscreenEnabled) buttons.push(["full screen", "Fill the screen with the view; Esc leaves", fillScreen]);
    return create("span", { className: "looks" }, ...buttons.map((button) => workButton(view, button)));
  };
})();
