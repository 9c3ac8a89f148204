// The views of a page side by side: one time, turned together, the same quantity in the same colours.
carom.ViewGroup = class {
  constructor() {
    Object.assign(this, { views: [], isTurning: false, isAgreeing: false });
  }

  // One has been turned.
  turn(view) {
    if (this.isTurning) return;
    this.isTurning = true;
    for (const other of this.views) {
      if (other === view || !other.drawing.eye) continue;
      other.drawing.eye.follow(view.drawing.eye);
      other.draw();
    }
    this.isTurning = false;
    if (view.panel.colours.state.mode === "visible") this.recolour();
  }

  // One shows another quantity, or in another way: so do all that have it.
  agree(view) {
    if (this.isAgreeing) return;
    this.isAgreeing = true;
    for (const other of this.views) {
      if (other === view || !other.panel.chooseQuantity(view.panel.quantityName)) continue;
      other.panel.colours.adopt(view.panel.colours.state);
      other.choose();
    }
    this.isAgreeing = false;
    this.recolour();
  }

  // All pictures again: the colours of a quantity go over its values in all views.
  recolour() {
    const ranges = new Map(), known = this.views.filter((view) => view.colouring && view.colouring.field);
    for (const view of known) {
      const range = view.rangeNow(), name = view.panel.quantityName;
      if (!range) continue;
      const [low, high] = ranges.get(name) || range;
      ranges.set(name, [Math.min(low, range[0]), Math.max(high, range[1])]);
    }
    for (const view of known) view.cover(ranges.get(view.panel.quantityName) || [0, 0]);
    for (const view of this.views) view.update();
  }

  // All views go there.
  showTime(t) {
    for (const view of this.views) view.moveTo(t);
    this.recolour();
  }
};
