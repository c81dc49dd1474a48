// The viewer's controls: what they are set to follows the state, and what a person does with them changes it.
"use strict";

gallery.controls = (() => {
  const { sheet, state, set } = gallery.state;
  const byId = (id) => document.getElementById(id);
  const RANGES = [0.05, 0.1, 0.2, 0.5, 1, 2, 5];

  function fillChoices(fieldset, name, items) {
    const choices = byId(fieldset).querySelector(".choices");
    for (const item of items) {
      const label = document.createElement("label");
      const input = Object.assign(document.createElement("input"), { type: "radio", name, value: item.key });
      const text = Object.assign(document.createElement("span"), { textContent: item.label });
      label.append(input, text);
      choices.append(label);
    }
  }

  function fillOptions(select, items) {
    for (const item of items) byId(select).add(new Option(item.label, item.key));
  }

  function onChoice(name, change) {
    for (const input of document.getElementsByName(name)) input.addEventListener("change", () => change(input.value));
  }

  function check(name, value) {
    for (const input of document.getElementsByName(name)) input.checked = input.value === String(value);
  }

  function number(value, digits = 2) {
    return value.toFixed(digits).replace("-", "−");
  }

  function follow() {
    const compared = Boolean(gallery.state.reference());
    const view = gallery.state.view();
    check("shows", state.shows);
    check("view", view);
    check("light", state.light);
    byId("row").value = state.row;
    byId("choose-view").disabled = !compared;
    byId("choose-light").disabled = !compared;
    byId("wipe").disabled = view !== "wipe";
    byId("stops").disabled = view === "signed" || view === "absolute";
    byId("range").disabled = !byId("stops").disabled;
    byId("stops").value = state.stops;
    byId("stops-value").textContent = `${state.stops > 0 ? "+" : ""}${number(state.stops)}`;
    byId("range").value = state.range;
    byId("legend").hidden = byId("range").disabled;
    drawLegend(view);
  }

  /** The wipe's slider has a step per row of pixels. */
  function followWipe(height) {
    byId("wipe").max = height;
    byId("wipe").value = state.split;
    byId("wipe-value").textContent = `${state.split} of ${height}`;
    byId("wipe").setAttribute("aria-valuetext", `the reference down to row ${state.split} of ${height}`);
  }

  function legendEnd(value) {
    const text = number(value, 3).replace(/\.?0+$/, "");
    return Object.assign(document.createElement("span"), { textContent: text });
  }

  function drawLegend(view) {
    const colours = gallery.colours[view];
    if (!colours) return;
    const stops = colours.filter((_, at) => at % 5 === 0).map((colour) => `rgb(${colour.join(" ")})`);
    byId("legend-bar").style.background = `linear-gradient(to right, ${stops.join(", ")})`;
    const ends = view === "signed" ? [-state.range, 0, state.range] : [0, state.range / 2, state.range];
    byId("legend-ends").replaceChildren(...ends.map(legendEnd));
    const what = view === "signed" ? "mean" : "root mean square";
    const of = "of a − b over the channels";
    byId("legend-text").textContent = `${what} ${of}, relative to the reference's root mean square over the sphere`;
  }

  fillChoices("choose-shows", "shows", sheet.shows);
  fillChoices("choose-light", "light", sheet.lights);
  fillOptions("row", sheet.rows);
  fillOptions("range", RANGES.map((range) => ({ key: range, label: `up to ${range}` })));

  onChoice("shows", (shows) => set({ shows }));
  onChoice("view", (view) => set({ view }));
  onChoice("light", (light) => set({ light: Number(light) }));
  byId("row").addEventListener("change", (event) => set({ row: event.target.value }));
  byId("range").addEventListener("change", (event) => set({ range: Number(event.target.value) }));
  byId("wipe").addEventListener("input", (event) => set({ split: Number(event.target.value) }));
  byId("stops").addEventListener("input", (event) => set({ stops: Number(event.target.value) }));
  gallery.state.listen(follow);

  return { followWipe };
})();
