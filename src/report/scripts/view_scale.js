// From a number to its place on a bar of colours, and the round numbers beside that.
carom.ColourScale = (function () {
  "use strict";
  const DECADES = 4;  // of a logarithmic scale: pages hold numbers of 16 bits

  // Stops of viridis (S. van der Walt, N. Smith, 2015) and of a blue - white - red scale for numbers of both signs.
  const VIRIDIS = ["440154", "482475", "414487", "355f8d", "2a788e", "21918c", "22a884", "44bf70", "7ad151", "bddf26", "fde725"];
  const BOTH_SIGNS = ["2c4fa0", "5b83c4", "9cb8dd", "d8e1ec", "f2f2f0", "f0d6cb", "e0a085", "c8604c", "a3262b"];
  const PARTS = ["6f9fd0", "d99a6c", "79b894", "b08fc0", "cbb45f", "79b3c2", "c9839f", "9aa0a6"];

  const rgb = (hex) => [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16));
  function table(stops, count) {
    const colours = stops.map(rgb);
    return Array.from({ length: count }, (_, i) => {
      const x = (i / (count - 1)) * (stops.length - 1);
      const k = Math.min(Math.floor(x), stops.length - 2);
      return [0, 1, 2].map((c) => Math.round(colours[k][c] + (x - k) * (colours[k + 1][c] - colours[k][c])));
    });
  }
  const palettes = { viridis: table(VIRIDIS, 256), signed: table(BOTH_SIGNS, 256), parts: PARTS.map(rgb), none: rgb("9aa4ac"), above: rgb("ff2fa0") };

  // One colour for each of the whole numbers from 0 to this one.
  const steps = (last) => Array.from({ length: 256 }, (_, i) => palettes.parts[Math.round((i / 255) * last) % palettes.parts.length]);

  // Multiples of 1, 2 or 5 times a power of ten from low to high, at most about so many.
  function roundTicks(low, high, most = 6) {
    if (!(high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high)))) return [low];  // nothing but round-off
    const power = Math.floor(Math.log10((high - low) / most)), exact = (k, factor) => Number(`${k * factor}e${power}`);
    const factor = [1, 2, 5, 10].find((f) => high - low <= most * exact(1, f) * (1 + 1e-9));
    const slack = 1e-3 * (high - low), ticks = [];  // ends are numbers of 12 bits or more
    for (let k = Math.ceil((low - slack) / exact(1, factor)); exact(k, factor) <= high + slack; k++) ticks.push(exact(k, factor) || 0);
    return ticks;
  }

  // Powers of ten, and 2 and 5 times them where there are few.
  function logTicks(low, high) {
    const factors = high / low > 1000 ? [1] : [1, 2, 5], ticks = [];
    for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high) + 1e-9; power++)
      ticks.push(...factors.map((f) => Number(`${f}e${power}`)).filter((x) => x >= low * (1 - 1e-9) && x <= high * (1 + 1e-9)));
    return ticks;
  }

  class ColourScale {
    // As the field wants it: from zero, about zero (which all numbers of both signs are), one colour for each whole
    // number, or just from the lowest to the highest.
    constructor(wanted) {
      Object.assign(this, { wanted, isLogarithmic: false, limit: Infinity });
      this.cover([0, 0]);
    }

    // From one of these numbers to the other. Those that were given are kept to, others are widened as the field wants it.
    cover([low, high], isGiven = false) {
      const isAboutZero = isGiven ? Math.abs(low + high) <= 1e-6 * (high - low) : this.wanted === "both_signs" || (low < 0 && high > 0);
      const isSigned = isAboutZero && !this.isLogarithmic;
      this.covered = [low, high];
      if (!isGiven && (this.wanted === "from_zero" || this.wanted === "categories")) low = Math.min(0, low);
      if (!isGiven && isSigned) [low, high] = [-Math.max(-low, high), Math.max(-low, high)];
      if (this.isLogarithmic) low = Math.max(low, high / 10 ** DECADES);
      this.range = [low, high];
      this.palette = this.wanted === "categories" ? steps(high) : isSigned ? palettes.signed : palettes.viridis;
    }

    // Its colour's: -1 where there is no number, 2 where it is above the limit.
    place(value) {
      return Number.isNaN(value) ? -1 : value > this.limit ? 2 : this.share(value);
    }

    // From 0 to 1 between the ends.
    share(value) {
      const [low, high] = this.range;
      if (!(high > low)) return 0;
      const share = this.isLogarithmic ? (value > 0 ? Math.log(value / low) / Math.log(high / low) : 0) : (value - low) / (high - low);
      return Math.min(1, Math.max(0, share));
    }

    // Round numbers of a legend, the largest first; unit: what is written as 1.
    ticks(unit = 1) {
      const [low, high] = this.range.map((x) => x / unit);
      if (this.wanted === "categories") return Array.from({ length: high + 1 }, (_, i) => high - i);
      const powers = this.isLogarithmic && high > low ? logTicks(low, high) : [];
      return (powers.length > 1 ? powers : roundTicks(low, high)).map((x) => x * unit).reverse();
    }

    colour(place) {
      return place < 0 ? palettes.none : place > 1 ? palettes.above : this.palette[Math.round(place * 255)];
    }
  }

  return Object.assign(ColourScale, { palettes, roundTicks, logTicks });
})();
