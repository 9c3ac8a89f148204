// What a reader has chosen of the charts, kept until the page is read again: zoom, curves, instant.
(function () {
  "use strict";
  // As a text that JSON can hold; of each chart under its title.
  carom.stateOfCharts = function (drawn) {
    const charts = {};
    for (const { graph, legend, title } of drawn)
      charts[title] = { values: graph.isZoomed("y") ? graph.yAxisRange() : null, off: legend.names(false), on: legend.names(true) };
    const zoomed = drawn.find(({ graph }) => graph.isZoomed("x"));
    return { window: zoomed ? zoomed.graph.xAxisRange() : null, t: carom.t, charts };
  };

  // Charts and curves that were not there are as the page has them.
  carom.restoreCharts = function (drawn, state) {
    for (const own of drawn) {
      const known = state.charts[own.title];
      if (!known) continue;
      own.legend.choose(known);
      const zoom = { ...(state.window ? { dateWindow: state.window } : {}), ...(known.values ? { valueRange: known.values } : {}) };
      if (Object.keys(zoom).length > 0) own.graph.updateOptions(zoom);
    }
    if (state.t !== null) carom.show(state.t);
  };

  carom.keepCharts = function (drawn) {
    const key = "carom " + location.pathname;
    const known = sessionStorage.getItem(key);
    if (known) carom.restoreCharts(drawn, JSON.parse(known));
    window.addEventListener("pagehide", () => sessionStorage.setItem(key, JSON.stringify(carom.stateOfCharts(drawn))));
  };
})();
