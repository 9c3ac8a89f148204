// Numbers and units as the page writes them.
(function () {
  "use strict";

  // A number in the readable unit of its axis, 10^power, with this many digits at most.
  carom.digits = (value, power, count) => String(Number((value / Math.pow(10, power)).toPrecision(count)));

  const RAISED = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };
  carom.powerOfTen = (power) => "10" + String(power).split("").map((c) => RAISED[c]).join("");

  // The same to be read: a power of ten where there would be many zeros.
  function readable(value, power, count) {
    const number = Number(carom.digits(value, power, count)), size = Math.abs(number);
    if (number === 0 || (size >= 1e-3 && size < 1e6)) return String(number);
    const tens = Math.floor(Math.log10(size));
    return `${Number((number / 10 ** tens).toPrecision(count))} · ${carom.powerOfTen(tens)}`;
  }

  // Beside a curve; nothing where there is no value.
  carom.short = (value, power) => (value === null || value === undefined || Number.isNaN(value) ? "" : readable(value, power, 5));

  // A time among others, increasing, with as many digits as tell most of them from the next: more than four of 1 ms after a
  // preload of 1 s.
  carom.clock = (value, times, power) => {
    const last = times[times.length - 1], gaps = times.slice(1).map((t, k) => t - times[k]).sort((a, b) => a - b), gap = gaps[gaps.length >> 1];
    const digits = gap > 0 ? Math.ceil(Math.log10(last / gap)) + 1 : 4;
    return readable(value, power, Math.min(12, Math.max(4, digits)));
  };

  // In a table or a legend; a dash where there is no value.
  carom.four = (value, power = 0) => (Number.isNaN(value) ? "–" : readable(value, power, 4));

  // The power of ten, a multiple of three, in which numbers of up to this size are written; 0 where they need none.
  carom.powerFor = (size) => (size === 0 || (size >= 0.01 && size < 1e5) ? 0 : 3 * Math.floor(Math.log10(size) / 3));

  carom.axisTitle = (name, unit) => (unit === "" ? name : `${name} [${unit}]`);
})();
