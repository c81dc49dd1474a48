// Reads the EXR files of this gallery: one part, scanlines, ZIP, channels of half or float. The page's scripts are
// classic ones that share the object `gallery`, since pages opened from a file may not import modules.
"use strict";

const gallery = {};

gallery.exr = (() => {
  const MAGIC = 20000630;
  const VERSION = 2; // no flags: neither tiles, nor several parts, nor long names
  const ZIP = 3;
  const LINES_PER_CHUNK = 16;
  const HALF = 1;
  const FLOAT = 2;

  /** The pixels of an EXR file's bytes: {width, height, rgba}, 4 floats per pixel, rows from the top. */
  async function decode(bytes) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const { header, end } = readHeader(view);
    const { width, height } = header;
    const image = { width, height, rgba: new Float32Array(4 * width * height) };
    for (let chunk = 0; chunk * LINES_PER_CHUNK < header.height; ++chunk) {
      const at = Number(view.getBigUint64(end + 8 * chunk, true));
      const top = view.getInt32(at, true) - header.top;
      const packed = bytes.subarray(at + 8, at + 8 + view.getInt32(at + 4, true));
      const lines = Math.min(LINES_PER_CHUNK, header.height - top);
      spread(await unpack(packed, lines * bytesPerLine(header)), lines, top, header, image);
    }
    return image;
  }

  function readHeader(view) {
    const isScanlines = view.getInt32(0, true) === MAGIC && view.getInt32(4, true) === VERSION;
    if (!isScanlines) throw new Error("not an EXR file of scanlines");
    const header = {};
    let at = 8;
    while (view.getUint8(at) !== 0) {
      const name = readText(view, at);
      const type = readText(view, name.end);
      const size = view.getInt32(type.end, true);
      readAttribute(name.text, view, type.end + 4, header);
      at = type.end + 4 + size;
    }
    if (header.compression !== ZIP) throw new Error(`an EXR file of compression ${header.compression}, not ZIP`);
    return { header, end: at + 1 };
  }

  function readAttribute(name, view, at, header) {
    if (name === "compression") header.compression = view.getUint8(at);
    if (name === "channels") header.channels = readChannels(view, at);
    if (name !== "dataWindow") return;
    header.top = view.getInt32(at + 4, true);
    header.width = view.getInt32(at + 8, true) - view.getInt32(at, true) + 1;
    header.height = view.getInt32(at + 12, true) - header.top + 1;
  }

  function readChannels(view, at) {
    const channels = [];
    while (view.getUint8(at) !== 0) {
      const name = readText(view, at);
      const type = view.getInt32(name.end, true);
      if (type !== HALF && type !== FLOAT) throw new Error(`channel ${name.text} is neither half nor float`);
      channels.push({ index: "RGBA".indexOf(name.text), bytes: type === HALF ? 2 : 4 });
      at = name.end + 16;
    }
    return channels;
  }

  function readText(view, at) {
    let text = "";
    for (; view.getUint8(at) !== 0; ++at) text += String.fromCharCode(view.getUint8(at));
    return { text, end: at + 1 };
  }

  function bytesPerLine(header) {
    return header.channels.reduce((sum, channel) => sum + channel.bytes * header.width, 0);
  }

  /** Undoes ZIP: deflate, differences of neighbours, the two halves of the bytes. What would not shrink is stored. */
  async function unpack(packed, size) {
    if (packed.length === size) return packed;
    const data = await inflate(packed);
    for (let at = 1; at < data.length; ++at) data[at] += data[at - 1] - 128;
    const bytes = new Uint8Array(size);
    const half = size / 2; // even, as no channel has values of one byte
    for (let at = 0; at < size; ++at) bytes[at] = data[(at >> 1) + (at & 1) * half];
    return bytes;
  }

  async function inflate(packed) {
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  /** A chunk's lines hold their channels one after the other. */
  function spread(bytes, lines, top, header, image) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    let at = 0;
    for (let y = top; y < top + lines; ++y)
      for (const channel of header.channels)
        for (let x = 0; x < header.width; ++x, at += channel.bytes) {
          const value = channel.bytes === 2 ? toFloat(view.getUint16(at, true)) : view.getFloat32(at, true);
          if (channel.index >= 0) image.rgba[4 * (y * header.width + x) + channel.index] = value;
        }
  }

  /** IEEE 754 binary16. */
  function toFloat(half) {
    const sign = half & 0x8000 ? -1 : 1;
    const exponent = (half >> 10) & 31;
    const fraction = half & 1023;
    if (exponent === 0) return sign * fraction * 2 ** -24;
    if (exponent === 31) return fraction ? NaN : sign * Infinity;
    return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
  }

  return { decode };
})();
