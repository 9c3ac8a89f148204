// The instant that all curves and views of the page show.
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
    // A number in the readable unit of its axis.
    short(value, power) {
      if (value === null || value === undefined || Number.isNaN(value)) return "";
      return String(Number((value / Math.pow(10, power)).toPrecision(7)));
    },
  };
})();
