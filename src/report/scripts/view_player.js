// The time of a view: the bar below the picture, and playing it. Which frame is shown is the page's to say (cursor.js).
carom.Player = (function () {
  "use strict";
  const { create } = carom;
  const SPEEDS = [[20, "slow"], [8, "normal"], [3, "fast"]];  // s for the whole run

  class Player {
    constructor(times) {
      Object.assign(this, { times, frame: 0, timer: null });
      this.button = create("button", { type: "button", textContent: "▶", title: "Play (space)" });
      this.slider = create("input", { type: "range", min: 0, max: this.last, step: 1, title: "Time" });
      this.speed = create("select", { title: "Time that the whole run takes" }, ...SPEEDS.map(([seconds, name]) => create("option", { value: seconds, textContent: name })));
      this.speed.value = 8;
      this.button.addEventListener("click", () => this.toggle());
      this.slider.addEventListener("input", () => this.goTo(Number(this.slider.value)));
      this.element = create("div", { className: "time" }, this.button, this.slider, this.speed);
    }

    get last() {
      return this.times.length - 1;
    }

    // All views and curves of the page go there, this one as well; not beyond the ends.
    goTo(frame) {
      carom.show(this.times[Math.min(this.last, Math.max(0, frame))]);
    }

    // The recorded instant next to t is the one that is shown.
    showTime(t) {
      this.frame = carom.nearestFrame(this.times, t);
      this.slider.value = this.frame;
    }

    // Plays from here, or from the start at the end; or stops.
    toggle() {
      if (this.timer) return this.pause();
      if (this.frame === this.last) this.goTo(0);
      this.button.textContent = "❚❚";
      const tick = () => {
        if (this.frame === this.last) return this.pause();
        this.goTo(this.frame + 1);
        this.timer = setTimeout(tick, (1000 * this.speed.value) / this.times.length);
      };
      this.timer = setTimeout(tick, 0);
    }

    pause() {
      clearTimeout(this.timer);
      this.timer = null;
      this.button.textContent = "▶";
    }
  }

  return Player;
})();
