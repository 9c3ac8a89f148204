// Numbers and units as the page writes them.
(function () {
  "use strict";

  // A number in the readable unit of its axis, 10^power, with this many digits at most.
  carom.digits = (value, power, count) => String(Number((value / Math.pow(10, power)).toPrecision(count)));

  // The same beside a curve or a clock; nothing where there is no value.
  carom.short = function (value, power) {
    return value === null || value === undefined || Number.isNaN(value) ? "" : carom.digits(value, power, 7);
  };

  // The same in a table or a legend; a dash where there is no value.
  carom.four = (value, power = 0) => (Number.isNaN(value) ? "–" : carom.digits(value, power, 4));

  carom.axisTitle = (name, unit) => (unit === "" ? name : `${name} [${unit}]`);
})();
