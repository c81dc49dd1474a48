// From linear images to display pixels: as `slopemix render --png` shows them, a wipe of two, differences in colour.
"use strict";

gallery.display = (() => {
  const BACKGROUND = [58, 110, 176];

  /** IEC 61966-2-1. */
  function srgb(linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
  }

  /** One pixel of `image` at `exposure`, over the blue background where its alpha is 0, into `out`. */
  function tone(image, exposure, at, out) {
    const alpha = Math.min(Math.max(image.rgba[at + 3], 0), 1);
    for (let c = 0; c < 3; ++c) {
      const shown = 255 * srgb(Math.min(Math.max(exposure * image.rgba[at + c], 0), 1));
      out[at + c] = Math.floor(shown * alpha + BACKGROUND[c] * (1 - alpha) + 0.5);
    }
    out[at + 3] = 255;
  }

  /** The reference in the rows above `split`, the image from there on: the lights leave the two halves alike. */
  function wipe(image, reference, exposure, split) {
    const pixels = new ImageData(image.width, image.height);
    for (let at = 0; at < pixels.data.length; at += 4)
      tone(at / 4 < split * image.width ? reference : image, exposure, at, pixels.data);
    return pixels;
  }

  function plain(image, exposure) {
    return wipe(image, image, exposure, 0);
  }

  /** Root mean square of the reference over the sphere's pixels and the channels, as in relRMSE. */
  function rootMeanSquare(image) {
    let sum = 0;
    let count = 0;
    for (let at = 0; at < image.rgba.length; at += 4) {
      if (!(image.rgba[at + 3] > 0)) continue;
      for (let c = 0; c < 3; ++c) sum += image.rgba[at + c] ** 2;
      count += 3;
    }
    return count ? Math.sqrt(sum / count) : 0;
  }

  /** What a pixel is off by, relative to `rms`: over the channels the mean, signed, or the root mean square. */
  function pixelDifference(image, reference, rms, at, view) {
    let sum = 0;
    for (let c = 0; c < 3; ++c) {
      const difference = (image.rgba[at + c] - reference.rgba[at + c]) / rms;
      sum += view === "signed" ? difference : difference ** 2;
    }
    return view === "signed" ? sum / 3 : Math.sqrt(sum / 3);
  }

  /** In the colours of the view's map, `range` being its end; nothing off the sphere. */
  function difference(image, reference, view, range) {
    const colours = gallery.colours[view];
    const rms = rootMeanSquare(reference);
    const pixels = new ImageData(image.width, image.height);
    for (let at = 0; at < pixels.data.length; at += 4) {
      if (!(reference.rgba[at + 3] > 0)) continue;
      const share = pixelDifference(image, reference, rms, at, view) / range;
      const place = view === "signed" ? (share + 1) / 2 : share;
      const colour = colours[Math.round(255 * Math.min(Math.max(place, 0), 1))];
      pixels.data.set([...(colour || [0, 0, 0]), 255], at);
    }
    return pixels;
  }

  return { plain, wipe, difference, pixelDifference, rootMeanSquare };
})();
