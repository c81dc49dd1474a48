// What the viewer shows: which image, how, and at what exposure and zoom. A change of it tells all that listen.
"use strict";

gallery.state = (() => {
  const sheet = JSON.parse(document.getElementById("sheet-data").textContent);
  const byKey = new Map(sheet.images.map((image) => [key(image.row, image.light_phi_deg, image.shows), image]));
  const state = {
    row: sheet.rows[0].key,
    light: sheet.lights.length ? sheet.lights[0].key : null,
    shows: "reference",
    view: "wipe",
    split: null, // rows of the reference in a wipe; null before the first image tells their number
    stops: 0,
    range: 0.5,
    zoom: null, // CSS pixels per pixel; null fits the window
    cursor: null, // [x, y]
  };
  const listeners = [];

  function key(row, light, shows) {
    return `${row} ${shows === "geometry" ? "" : light} ${shows}`;
  }

  function find(shows) {
    return byKey.get(key(state.row, state.light, shows));
  }

  function set(changes) {
    Object.assign(state, changes);
    if (!image()) state.shows = sheet.shows.map((item) => item.key).find(find) || state.shows;
    for (const listener of listeners) listener(state);
  }

  function image() {
    return find(state.shows);
  }

  /** Of the image shown; none for a picture of the geometry. */
  function reference() {
    return state.shows === "geometry" ? undefined : find("reference");
  }

  /** What is really drawn: a comparison needs a reference. */
  function view() {
    return reference() ? state.view : "image";
  }

  function exposure() {
    return image().exposure * 2 ** state.stops;
  }

  /** Goes to the image of this identifier; its model is compared at once where it is a filtered one. */
  function show(id) {
    const found = sheet.images.find((item) => item.id === id);
    if (!found) return false;
    const light = found.light_phi_deg === null ? state.light : found.light_phi_deg;
    set({ row: found.row, light, shows: found.shows });
    return true;
  }

  /** The key that stands `step` places after the current one, in a list that begins again. */
  function next(items, current, step) {
    const keys = items.map((item) => item.key);
    return keys[(keys.indexOf(current) + step + keys.length) % keys.length];
  }

  return { sheet, state, set, find, image, reference, view, exposure, show, next, listen: (f) => listeners.push(f) };
})();
