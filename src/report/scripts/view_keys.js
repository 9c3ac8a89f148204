// What keys do while the picture of a view has the focus.
carom.listenToKeys = (function () {
  "use strict";

  function keysOfTime(player) {
    return {
      " ": () => player.toggle(), ArrowRight: () => player.goTo(player.frame + 1), ArrowLeft: () => player.goTo(player.frame - 1),
      Home: () => player.goTo(0), End: () => player.goTo(player.last),
    };
  }

  function keysOfPanel(panel, chosen) {
    const press = (input) => () => {
      input.checked = !input.checked;
      chosen();
    };
    return {
      e: press(panel.edges), a: press(panel.arrows),
      c: () => {
        panel.cutAxis.selectedIndex = (panel.cutAxis.selectedIndex + 1) % panel.cutAxis.options.length;
        chosen();
      },
    };
  }

  function keysOfEye(eye, fit) {
    const { iso, x, y, z } = carom.ViewCamera.directions(eye.extent.isPlane);
    const look = (direction) => () => eye.look(direction);
    return {
      "shift ArrowLeft": () => eye.turn(-0.1, 0), "shift ArrowRight": () => eye.turn(0.1, 0), "shift ArrowUp": () => eye.turn(0, -0.1), "shift ArrowDown": () => eye.turn(0, 0.1),
      "+": () => eye.zoom(1.2), "-": () => eye.zoom(1 / 1.2), f: fit, x: look(x), y: look(y), z: look(z), i: look(iso),
    };
  }

  // eye: null where a picture cannot be turned.
  return function (canvas, { player, panel, eye, chosen, fit }) {
    const keys = { ...keysOfTime(player), ...keysOfPanel(panel, chosen), ...(eye ? keysOfEye(eye, fit) : {}) };
    canvas.addEventListener("keydown", (event) => {
      const act = keys[(event.shiftKey && event.key.startsWith("Arrow") ? "shift " : "") + event.key];
      if (!act || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      act();
    });
  };
})();
