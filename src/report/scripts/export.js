// Saves the pieces of a file on the reader's disk.
carom.saveFile = function (name, type, pieces) {
  "use strict";
  const url = URL.createObjectURL(new Blob(pieces, { type }));
  Object.assign(document.createElement("a"), { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
};

// Buttons that save a chart as a file.
carom.addExports = (function () {
  "use strict";
  const save = (name, type, content) => carom.saveFile(name, type, [content]);

  function savePng(name, source) {
    const image = new Image();
    image.onload = () => {
      const canvas = Object.assign(document.createElement("canvas"), { width: 2 * image.width, height: 2 * image.height });
      canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
      canvas.toBlob((blob) => save(name, "image/png", blob));
    };
    image.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(source);
  }

  const kinds = {
    SVG: (name, { svg }) => save(name, "image/svg+xml", svg()),
    PNG: (name, { svg }) => savePng(name, svg()),
    CSV: (name, { csv }) => save(name, "text/csv", csv()),
  };

  // Behind the title of a figure. what(): the title, and the texts of the files as functions.
  return function (caption, what) {
    const box = Object.assign(document.createElement("span"), { className: "exports" });
    for (const [kind, act] of Object.entries(kinds)) {
      const button = Object.assign(document.createElement("button"), { type: "button", textContent: kind, title: "Save as " + kind });
      button.addEventListener("click", () => {
        const given = what();
        act((given.title.replace(/[^A-Za-z0-9]+/g, "_") || "curve") + "." + kind.toLowerCase(), given);
      });
      box.append(button);
    }
    caption.append(box);
  };
})();
