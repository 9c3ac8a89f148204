// A list of what is on a long page, below its head.
(function () {
  "use strict";
  const LONG = 5;  // headings
  const headings = [...document.querySelectorAll("main h2")], header = document.querySelector("main > header");
  if (headings.length < LONG || !header) return;
  const nav = Object.assign(document.createElement("nav"), { className: "contents" });
  nav.setAttribute("aria-label", "On this page");
  headings.forEach((heading, i) => {
    heading.id = heading.id || "section-" + (i + 1);
    nav.append(Object.assign(document.createElement("a"), { href: "#" + heading.id, textContent: heading.textContent }));
  });
  header.after(nav);
})();
