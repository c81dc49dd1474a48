// Files to take away: the canvas as PNG, the linear image as EXR, and what the sheet says of it as JSON.
"use strict";

(() => {
  const { sheet } = gallery.state;

  function save(blob, name) {
    const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  function name(ending) {
    return `${sheet.material}-${gallery.state.image().id}${ending}`;
  }

  function savePng() {
    const view = gallery.state.view();
    const suffix = view === "image" ? "" : `-${view === "wipe" ? "wipe" : `${view}-difference`}`;
    document.getElementById("canvas").toBlob((blob) => save(blob, name(`${suffix}.png`)), "image/png");
  }

  async function saveExr() {
    const bytes = await gallery.pixels.file(sheet.material, gallery.state.image());
    save(new Blob([bytes], { type: "image/x-exr" }), name(".exr"));
  }

  function saveJson() {
    const { shows, row, ...entry } = gallery.state.image();
    const text = `${JSON.stringify({ material: sheet.material, ...entry }, null, 2)}\n`;
    save(new Blob([text], { type: "application/json" }), name(".json"));
  }

  document.getElementById("save-png").addEventListener("click", savePng);
  document.getElementById("save-exr").addEventListener("click", () => saveExr().catch(gallery.viewer.complain));
  document.getElementById("save-json").addEventListener("click", saveJson);
})();
