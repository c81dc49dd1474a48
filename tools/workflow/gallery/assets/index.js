// The index: which materials it shows, in which order, as tiles or as a table.
"use strict";

(() => {
  const byId = (id) => document.getElementById(id);
  const lists = [document.querySelector(".tiles"), document.querySelector(".materials tbody")];
  const absent = [...document.querySelectorAll(".absent li")];
  const headers = [...document.querySelectorAll("th[data-key]")];

  function sort() {
    const key = byId("sort").value;
    const direction = Number(byId("direction").value);
    for (const list of lists) list.append(...[...list.children].sort((a, b) => compare(a, b, key, direction)));
    for (const header of headers) mark(header, header.dataset.key === key, direction);
  }

  /** What has no value comes last in either direction; equals go by name. */
  function compare(a, b, key, direction) {
    const [first, second] = [a, b].map((item) => item.getAttribute(`data-${key}`));
    if (first === null || second === null) return (first === null) - (second === null) || byName(a, b);
    const numeric = Number(first) - Number(second);
    return direction * (Number.isNaN(numeric) ? first.localeCompare(second) : numeric) || byName(a, b);
  }

  function byName(a, b) {
    return a.dataset.name.localeCompare(b.dataset.name);
  }

  function mark(header, sorted, direction) {
    if (sorted) header.setAttribute("aria-sort", direction > 0 ? "ascending" : "descending");
    else header.removeAttribute("aria-sort");
  }

  function filter() {
    const text = byId("search").value.trim().toLowerCase();
    const kind = byId("kind").value;
    const items = [...lists.flatMap((list) => [...list.children]), ...absent];
    const matches = ({ dataset }) => dataset.name.toLowerCase().includes(text) && (!kind || dataset.kind === kind);
    for (const item of items) item.hidden = !matches(item);
    if (byId("absent")) byId("absent").hidden = absent.every((item) => item.hidden);
    const all = [...lists[0].children];
    byId("count").textContent = `${all.filter((item) => !item.hidden).length} of ${all.length} materials`;
  }

  function show() {
    for (const input of document.getElementsByName("show")) byId(input.value).hidden = !input.checked;
  }

  /** A column's heading sorts by it, and turns its order if it is sorted by already. */
  function sortBy(key) {
    const again = byId("sort").value === key;
    byId("direction").value = again ? -byId("direction").value : 1;
    byId("sort").value = key;
    sort();
  }

  for (const header of headers)
    header.querySelector("button").addEventListener("click", () => sortBy(header.dataset.key));
  for (const id of ["sort", "direction"]) byId(id).addEventListener("change", sort);
  byId("search").addEventListener("input", filter);
  byId("kind").addEventListener("change", filter);
  for (const input of document.getElementsByName("show")) input.addEventListener("change", show);
  document.querySelector(".filters").addEventListener("submit", (event) => event.preventDefault());
  document.querySelector(".filters").hidden = false;
  sort();
  filter();
  show();
})();
