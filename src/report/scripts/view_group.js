// The views of a page side by side: turned together, the same quantity in the same colours.
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
  }

  // One shows another quantity: so do all that have it, and the colours are those of all their values.
  agree(view) {
    if (this.isAgreeing) return;
    this.isAgreeing = true;
    const name = view.panel.quantityName;
    for (const other of this.views) if (other !== view && other.panel.chooseQuantity(name)) other.choose();
    const same = [...new Set([view, ...this.views])].filter((v) => v.colouring.field && v.panel.quantityName === name);
    const low = Math.min(...same.map((v) => v.colouring.covered[0])), high = Math.max(...same.map((v) => v.colouring.covered[1]));
    for (const each of same) {
      each.colouring.cover([low, high]);
      each.showColours();
      if (each !== view) each.update();
    }
    this.isAgreeing = false;
  }
};
