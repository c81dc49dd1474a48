// The viewer's keys, each of which does what a control does too. Lists keep theirs, and so do arrows off the image.
"use strict";

(() => {
  const { sheet, state, set, next } = gallery.state;
  const views = { i: "image", w: "wipe", d: "signed", a: "absolute" };
  const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  const actions = {
    l: () => set({ light: next(sheet.lights, state.light, 1) }),
    "[": () => set({ row: next(sheet.rows, state.row, -1) }),
    "]": () => set({ row: next(sheet.rows, state.row, 1) }),
    ",": () => gallery.viewer.wipe(-1),
    ".": () => gallery.viewer.wipe(1),
    "-": () => stops(-0.25),
    "+": () => stops(0.25),
    "=": () => stops(0.25),
    0: () => set({ stops: 0 }),
    z: () => gallery.viewer.zoom(-1),
    x: () => gallery.viewer.zoom(1),
  };

  function stops(step) {
    set({ stops: Math.min(Math.max(state.stops + step, -8), 8) });
  }

  function onKey(event) {
    if (!document.getElementById("viewer").open) return;
    if (event.ctrlKey || event.metaKey || event.altKey || event.target instanceof HTMLSelectElement) return;
    if (event.target.id === "canvas" && arrows[event.key]) {
      const [dx, dy] = arrows[event.key].map((step) => step * (event.shiftKey ? 8 : 1));
      gallery.cursor.move(dx, dy);
    } else if (/^[1-9]$/.test(event.key)) {
      if (sheet.shows[event.key - 1]) set({ shows: sheet.shows[event.key - 1].key });
    } else if (views[event.key.toLowerCase()]) {
      set({ view: views[event.key.toLowerCase()] });
    } else if (actions[event.key.toLowerCase()]) {
      actions[event.key.toLowerCase()]();
    } else {
      return;
    }
    event.preventDefault();
  }

  document.addEventListener("keydown", onKey);
})();
