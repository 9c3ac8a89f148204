// What is drawn to the size of the page on the screen is drawn anew while the page is printed, in the colours of paper.
carom.onPrint = (function () {
  "use strict";
  const redraws = [], root = document.documentElement;
  const turn = (isPrinting) => () => {
    root.classList.toggle("printing", isPrinting);
    for (const redraw of redraws) redraw();
  };
  window.addEventListener("beforeprint", turn(true));
  window.addEventListener("afterprint", turn(false));

  // redraw(): called when the printing begins and when it has ended.
  return (redraw) => redraws.push(redraw);
})();
