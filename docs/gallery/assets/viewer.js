// The viewer: a dialog that opens from an image of the page, draws the state, and names its image in the address.
"use strict";

gallery.viewer = (() => {
  const { sheet, state, set, listen, show } = gallery.state;
  const byId = (id) => document.getElementById(id);
  const viewer = byId("viewer");
  const LARGEST_ZOOM = 32;
  let width = 1;
  let height = 1;

  async function draw() {
    if (!viewer.open) return;
    const entry = gallery.state.image();
    const other = gallery.state.reference();
    describe(entry);
    try {
      const image = await gallery.pixels.get(sheet.material, entry);
      const reference = other && (await gallery.pixels.get(sheet.material, other));
      if (entry !== gallery.state.image()) return; // the state went on meanwhile
      ({ width, height } = image);
      if (state.split === null) state.split = Math.round(height / 2);
      byId("message").textContent = "";
      paint(image, reference);
      layOut();
      gallery.cursor.follow({ image, reference });
    } catch (error) {
      complain(error);
    }
  }

  function paint(image, reference) {
    const canvas = byId("canvas");
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    canvas.getContext("2d", { willReadFrequently: true }).putImageData(painted(image, reference), 0, 0);
    canvas.dataset.drawn = `${gallery.state.image().id} ${gallery.state.view()}`;
  }

  function painted(image, reference) {
    const view = gallery.state.view();
    if (gallery.colours[view]) return gallery.display.difference(image, reference, view, state.range);
    if (view === "wipe") return gallery.display.wipe(image, reference, gallery.state.exposure(), state.split);
    return gallery.display.plain(image, gallery.state.exposure());
  }

  /** Sizes of the canvas and of what lies over it. */
  function layOut() {
    const scale = state.zoom || fitting();
    const line = byId("wipe-line");
    byId("canvas").style.width = `${scale * width}px`;
    byId("canvas").style.height = `${scale * height}px`;
    byId("zoom-value").textContent = `${scale}×`;
    line.hidden = gallery.state.view() !== "wipe";
    line.style.top = `${scale * state.split}px`;
    gallery.controls.followWipe(height);
  }

  function fitting() {
    const stage = byId("stage");
    const room = Math.min((stage.clientWidth - 24) / width, (stage.clientHeight - 24) / height);
    return Math.min(Math.max(Math.floor(room), 1), LARGEST_ZOOM);
  }

  function zoom(step) {
    set({ zoom: Math.min(Math.max((state.zoom || fitting()) + step, 1), LARGEST_ZOOM) });
  }

  function wipe(step) {
    set({ split: Math.min(Math.max(state.split + step, 0), height) });
  }

  function describe(entry) {
    const label = sheet.shows.find((item) => item.key === entry.shows).label;
    const light = sheet.lights.find((item) => item.key === entry.light_phi_deg);
    byId("viewer-title").textContent = `${sheet.material} ${entry.id}`;
    const texts = [label, light && `light ${light.label}`, ...figures(entry)];
    byId("viewer-figures").textContent = texts.filter(Boolean).join(" · ");
    byId("canvas").setAttribute("aria-label", `${entry.id}, ${label}; the arrow keys move over its pixels`);
  }

  function figures(entry) {
    const all = { relRMSE: entry.relrmse, FLIP: entry.flip, bias: entry.bias, "standard error": entry.standard_error };
    const texts = Object.entries(all).map(([name, value]) => Number.isFinite(value) && `${name} ${value.toFixed(4)}`);
    return [...texts, entry.spp && `${entry.spp} samples per pixel`];
  }

  function complain(error) {
    byId("message").textContent = `The linear data cannot be shown: ${error.message}.`;
  }

  function open(id) {
    if (!viewer.open) viewer.showModal();
    if (show(id)) byId("canvas").focus();
  }

  function nameInAddress() {
    if (viewer.open) history.replaceState(null, "", `#${gallery.state.image().id}`);
  }

  function openFromAddress() {
    const id = decodeURIComponent(location.hash.slice(1));
    if (sheet.images.some((image) => image.id === id)) open(id);
  }

  for (const link of document.querySelectorAll("a[data-image]")) {
    link.setAttribute("aria-haspopup", "dialog");
    link.addEventListener("click", (event) => {
      if (event.ctrlKey || event.metaKey || event.shiftKey) return;
      event.preventDefault();
      open(link.dataset.image);
    });
  }
  byId("close").addEventListener("click", () => viewer.close());
  viewer.addEventListener("close", () => {
    history.replaceState(null, "", location.pathname + location.search);
    const link = document.getElementById(gallery.state.image().id);
    if (link) link.focus();
  });
  byId("zoom-in").addEventListener("click", () => zoom(1));
  byId("zoom-out").addEventListener("click", () => zoom(-1));
  byId("zoom-fit").addEventListener("click", () => set({ zoom: null }));
  window.addEventListener("resize", draw);
  window.addEventListener("hashchange", openFromAddress);
  listen(draw);
  listen(nameInAddress);
  window.addEventListener("load", openFromAddress);

  return { zoom, wipe, complain };
})();
