// Elements of the page, and clicks on them.
(function () {
  "use strict";

  // Makes one with its properties, or attributes where it has no such property, and its children.
  carom.create = function (tag, properties, ...children) {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(properties || {})) {
      if (name in element) element[name] = value;
      else element.setAttribute(name, value);
    }
    element.append(...children);
    return element;
  };

  // A press that is let go where it began: not the dragging of a view.
  carom.onClick = function (element, act) {
    let pressed = null;
    element.addEventListener("pointerdown", (e) => (pressed = [e.clientX, e.clientY]));
    element.addEventListener("pointerup", (e) => {
      if (pressed && Math.hypot(e.clientX - pressed[0], e.clientY - pressed[1]) < 4) act(e);
    });
  };
})();
