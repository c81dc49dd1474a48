// The pixel under the pointer, or that the arrow keys moved to: a frame around it and its values.
"use strict";

gallery.cursor = (() => {
  const { state, set } = gallery.state;
  const byId = (id) => document.getElementById(id);
  let shown = null; // {image, reference, width, height}, as drawn

  /** Called when an image has been drawn. */
  function follow(drawn) {
    shown = drawn;
    if (state.cursor) state.cursor = inside(state.cursor);
    frame();
    read();
  }

  function inside([x, y]) {
    const within = (value, count) => Math.min(Math.max(value, 0), count - 1);
    return [within(x, shown.image.width), within(y, shown.image.height)];
  }

  function move(dx, dy) {
    if (!shown) return;
    const [x, y] = state.cursor || [Math.floor(shown.image.width / 2) - dx, Math.floor(shown.image.height / 2) - dy];
    place([x + dx, y + dy]);
    byId("announce").textContent = byId("readout").textContent;
  }

  function place(cursor) {
    state.cursor = inside(cursor);
    frame();
    read();
  }

  function frame() {
    const box = byId("cursor");
    box.hidden = !state.cursor;
    if (!state.cursor) return;
    const scale = byId("canvas").clientWidth / shown.image.width;
    const [x, y] = state.cursor.map((value) => value * scale);
    Object.assign(box.style, { left: `${x}px`, top: `${y}px`, width: `${scale}px`, height: `${scale}px` });
  }

  function read() {
    if (!state.cursor) return;
    const [x, y] = state.cursor;
    const at = 4 * (y * shown.image.width + x);
    byId("readout").textContent = `x ${x}, y ${y}: ${describe(at)}`;
  }

  function describe(at) {
    const { image, reference } = shown;
    if (!(image.rgba[at + 3] > 0)) return "off the sphere";
    if (!reference || reference === image) return values(image, at);
    const rms = gallery.display.rootMeanSquare(reference);
    const off = gallery.display.pixelDifference(image, reference, rms, at, "signed");
    const label = gallery.state.sheet.shows.find((item) => item.key === state.shows).label;
    const both = `${label} ${values(image, at)}; reference ${values(reference, at)}`;
    return `${both}; difference ${signed(off)} of its root mean square`;
  }

  function values(image, at) {
    return Array.from(image.rgba.subarray(at, at + 3), (value) => value.toPrecision(4)).join(" ");
  }

  function signed(value) {
    return `${value < 0 ? "−" : "+"}${Math.abs(value).toFixed(4)}`;
  }

  /** The pixel under a pointer's event; a half-open range of CSS pixels each. */
  function pixelAt(event) {
    const box = byId("canvas").getBoundingClientRect();
    const x = Math.floor(((event.clientX - box.left) / box.width) * shown.image.width);
    const y = Math.floor(((event.clientY - box.top) / box.height) * shown.image.height);
    return [x, y];
  }

  function onPointer(event) {
    if (!shown) return;
    const [x, y] = pixelAt(event);
    const wipes = event.buttons === 1 && gallery.state.view() === "wipe";
    if (wipes) set({ split: Math.min(Math.max(y, 0), shown.image.height) });
    place([x, y]);
  }

  byId("canvas").addEventListener("pointerdown", (event) => {
    byId("canvas").setPointerCapture(event.pointerId);
    onPointer(event);
  });
  byId("canvas").addEventListener("pointermove", onPointer);

  return { follow, move };
})();
