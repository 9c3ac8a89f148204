// The instant that all curves and views of the page show.
/* exported carom */
const carom = (function () {
  "use strict";
  const listeners = [];
  const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

  return {
    t: null,
    css,
    follow(listener) {
      listeners.push(listener);
      if (this.t !== null) listener(this.t);
    },
    show(t) {
      if (t === this.t) return;
      this.t = t;
      for (const listener of listeners) listener(t);
    },
  };
})();
