// Numbers and units as the page writes them.
(function () {
  "use strict";

  // A number in the readable unit of its axis, 10^power, with this many digits at most.
  carom.digits = (value, power, count) => String(Number((value / Math.pow(10, power)).toPrecision(count)));

  // The same beside a curve or a clock; nothing where there is no value.
  carom.short = function (value, power) {
    return value === null || value === undefined || Number.isNaN(value) ? "" : carom.digits(value, power, 7);
  };

  const RAISED = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };
  carom.powerOfTen = (power) => "10" + String(power).split("").map((c) => RAISED[c]).join("");

  // The same in a table or a legend; a dash where there is no value, a power of ten where there would be many zeros.
  carom.four = function (value, power = 0) {
    if (Number.isNaN(value)) return "–";
    const text = carom.digits(value, power, 4), number = Number(text), size = Math.abs(number);
    if (number === 0 || (size >= 1e-3 && size < 1e6)) return text;
    const tens = Math.floor(Math.log10(size));
    return `${Number((number / 10 ** tens).toPrecision(4))} · ${carom.powerOfTen(tens)}`;
  };

  // The power of ten, a multiple of three, in which numbers of up to this size are written; 0 where they need none.
  carom.powerFor = (size) => (size === 0 || (size >= 0.01 && size < 1e5) ? 0 : 3 * Math.floor(Math.log10(size) / 3));

  carom.axisTitle = (name, unit) => (unit === "" ? name : `${name} [${unit}]`);
})();
