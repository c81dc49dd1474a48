// The linear images, a table's row at a time: data/NAME/T.R.js is loaded when the first of its images is asked for.
"use strict";

gallery.pixels = (() => {
  const files = new Map(); // id -> bytes of an EXR file
  const loading = new Map(); // row -> promise
  const decoded = new Map(); // id -> promise of an image

  /** Called by the scripts of the rows. */
  function receive(row, images) {
    for (const [id, text] of Object.entries(images)) files.set(id, Uint8Array.from(atob(text), (c) => c.charCodeAt(0)));
  }

  function load(material, row) {
    if (!loading.has(row)) loading.set(row, run(`data/${material}/${row}.js`, () => loading.delete(row)));
    return loading.get(row);
  }

  function run(source, forget) {
    return new Promise((resolve, reject) => {
      const script = document.createElement("script");
      script.src = source;
      script.onload = resolve;
      script.onerror = () => {
        forget();
        reject(new Error(`${source} could not be loaded`));
      };
      document.head.append(script);
    });
  }

  /** The bytes of an image's EXR file. */
  async function file(material, image) {
    await load(material, image.row);
    return files.get(image.id);
  }

  /** The image, decoded once. */
  function get(material, image) {
    if (!decoded.has(image.id)) decoded.set(image.id, file(material, image).then(gallery.exr.decode));
    decoded.get(image.id).catch(() => decoded.delete(image.id));
    return decoded.get(image.id);
  }

  return { receive, file, get };
})();
