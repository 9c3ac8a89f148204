// How the colours of a view are chosen: over which values they go, by logarithms or not, what is marked, averages.
carom.ColourOptions = (function () {
  "use strict";
  const { create } = carom;
  const MODES = [["all", "all times"], ["instant", "this instant"], ["visible", "what is seen"], ["given", "from … to"]];
  const numberInput = (title) => create("input", { type: "number", step: "any", title });
  const numberOf = (input) => (input.value === "" ? NaN : Number(input.value));

  class ColourOptions {
    // chosen: what to do when something else is chosen.
    constructor(chosen) {
      this.mode = create("select", { title: "Which values the colours go over" }, ...MODES.map(([value, textContent]) => create("option", { value, textContent })));
      [this.low, this.high] = ["Lowest value of the colours", "Highest value of the colours"].map(numberInput);
      this.limit = numberInput("Cells with a larger value are marked");
      [this.logarithmic, this.smooth] = ["logarithmic", "averaged"].map(() => create("input", { type: "checkbox" }));
      this.given = create("span", { className: "given", hidden: true }, this.low, " ", this.high);
      this.smoothLabel = create("label", { title: "Values of cells averaged at the nodes of each part's surface" }, this.smooth, " averaged");
      this.element = create("span", { className: "options" }, create("label", {}, "over ", this.mode), this.given,
        create("label", {}, this.logarithmic, " logarithmic"), this.smoothLabel, create("label", {}, "mark above ", this.limit));
      for (const input of [this.mode, this.low, this.high, this.limit, this.logarithmic, this.smooth]) input.addEventListener("change", chosen);
    }

    // What is chosen, with numbers in the units that are shown.
    get state() {
      return { mode: this.mode.value, low: this.low.value, high: this.high.value, limit: this.limit.value,
        logarithmic: this.logarithmic.checked, smooth: this.smooth.checked };
    }

    // As another view has it.
    adopt(state) {
      for (const name of ["mode", "low", "high", "limit"]) this[name].value = state[name];
      for (const name of ["logarithmic", "smooth"]) this[name].checked = state[name];
    }

    // Another quantity: numbers that were given belong to the one before.
    forget() {
      for (const input of [this.low, this.high, this.limit]) input.value = "";
      if (this.mode.value === "given") this.mode.value = "all";
    }

    // Puts what is chosen into a colouring, and offers what that can be drawn with.
    apply(colouring) {
      const { field, scale, isAtCells } = colouring;
      this.element.hidden = !field || scale.wanted === "categories";
      if (this.element.hidden) return;
      this.smoothLabel.hidden = !isAtCells;
      this.logarithmic.disabled = !(colouring.ofAllTimes[0] >= 0 && colouring.ofAllTimes[1] > 0);
      this.given.hidden = this.mode.value !== "given";
      if (!this.given.hidden && this.low.value + this.high.value === "") this.fill(colouring);
      const limit = numberOf(this.limit);
      scale.limit = Number.isNaN(limit) ? Infinity : limit * 10 ** field.power;
      scale.isLogarithmic = this.logarithmic.checked && !this.logarithmic.disabled;
      colouring.isSmooth = this.smooth.checked;
    }

    // The numbers that the colours go over now.
    fill({ scale, field }) {
      const ticks = scale.range.map((x) => carom.digits(x, field.power, 4));
      [this.low.value, this.high.value] = ticks;
    }

    // The numbers that were given, or null: without two different ones there is nothing to go over.
    rangeGiven({ power }) {
      const [low, high] = [this.low, this.high].map((input) => numberOf(input) * 10 ** power);
      return this.mode.value === "given" && low < high ? [low, high] : null;
    }
  }

  return ColourOptions;
})();
