// SPDX-License-Identifier: Apache-2.0
// The picture: its size on the screen, drawing, and pointer events.

export class Stage {
  // on: {drag(dx, dy) in fractions of the picture, zoom(factor), click(x, y), hover(x, y)}
  constructor(canvas, on) {
    this.canvas = canvas;
    this.context = canvas.getContext("bitmaprenderer", {alpha: false});  // takes decoded pictures without a copy
    this.aspect = 1;  // height over width of the requested picture
    this.shown = 1;   // height over width of the drawn picture
    this.latest = 0;
    this.pointers = new Map();
    this.listen(on);
  }

  // Returns the largest width that fits for an aspect ratio.
  width(aspect) {
    const room = this.canvas.parentElement.getBoundingClientRect(), across = room.width - 12, down = room.height - 12;
    return Math.max(16, Math.floor(Math.min(across, down / aspect)));
  }

  // Fits the drawn picture into the window. Returns the width of the requested picture in device pixels.
  fit() {
    const width = this.width(this.shown);
    this.canvas.style.width = `${width}px`;
    this.canvas.style.height = `${Math.max(1, Math.round(width * this.shown))}px`;
    this.pixels = Math.min(2048, Math.round(this.width(this.aspect) * (window.devicePixelRatio || 1)));
    return this.pixels;
  }

  // Pictures are decoded concurrently; one that completes after a newer one is dropped. Returns whether it was drawn.
  async draw(blob, number, aspect) {
    const bitmap = await createImageBitmap(blob);
    if (number < this.latest) return false;
    this.latest = number;
    if (this.shown !== aspect) { this.shown = aspect; this.fit(); }
    // The style's size stays: the browser scales coarse pictures.
    if (this.canvas.width !== bitmap.width || this.canvas.height !== bitmap.height)
      Object.assign(this.canvas, {width: bitmap.width, height: bitmap.height});
    this.context.transferFromImageBitmap(bitmap);
    return true;
  }

  spot(event) {
    const box = this.canvas.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
  }

  listen(on) {
    const {canvas, pointers} = this;
    let travelled = 0, spread = 0;
    const apart = () => { const [a, b] = [...pointers.values()]; return Math.hypot(a[0] - b[0], a[1] - b[1]); };
    canvas.addEventListener("pointerdown", event => {
      if (event.button !== 0) return;
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, this.spot(event));
      if (pointers.size === 1) travelled = 0;
      if (pointers.size === 2) { spread = apart(); travelled = 1; }
    });
    canvas.addEventListener("pointermove", event => {
      const now = this.spot(event), before = pointers.get(event.pointerId);
      if (!before) return void on.hover(...now);
      pointers.set(event.pointerId, now);
      if (pointers.size === 1) {
        travelled += Math.hypot(now[0] - before[0], now[1] - before[1]);
        on.drag(now[0] - before[0], now[1] - before[1]);
      } else if (pointers.size === 2) {
        const wider = apart();
        if (spread > 0 && wider > 0) on.zoom(spread / wider);
        spread = wider;
      }
    });
    const up = event => {
      const known = pointers.delete(event.pointerId);
      if (known && event.type === "pointerup" && pointers.size === 0 && travelled < 0.01) on.click(...this.spot(event));
    };
    canvas.addEventListener("pointerup", up);
    canvas.addEventListener("pointercancel", up);
    canvas.addEventListener("wheel", event => {
      event.preventDefault();
      on.zoom(Math.exp(event.deltaY * (event.deltaMode === 1 ? 0.03 : 0.001)));
    }, {passive: false});
  }
}
