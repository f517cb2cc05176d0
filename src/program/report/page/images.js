// Pictures: half floats as they were packed, and the colours that they are shown in.
'use strict';
const halves = new Float32Array(65536); // the value of each 16-bit float
for (let i = 0; i < 65536; ++i) {
  const exponent = i >> 10 & 31, mantissa = i & 1023;
  const size = exponent === 0 ? mantissa * 2 ** -24 : exponent === 31 ? (mantissa ? NaN : Infinity)
    : (1 + mantissa / 1024) * 2 ** (exponent - 15);
  halves[i] = i & 0x8000 ? -size : size;
}
// For each channel the upper bytes, then the lower ones, as differences to the byte before; deflated.
async function unpack(made) {
  const packed = Uint8Array.from(atob(made.data), c => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const count = made.width * made.height, codes = [];
  for (let i = 1; i < bytes.length; ++i)
    bytes[i] = bytes[i] + bytes[i - 1];
  for (let c = 0; c < made.channels; ++c) {
    const plane = new Uint16Array(count);
    for (let i = 0; i < count; ++i)
      plane[i] = bytes[2 * c * count + i] << 8 | bytes[(2 * c + 1) * count + i];
    codes.push(plane);
  }
  return {name: made.name, reference: made.reference, width: made.width, height: made.height,
          codes: made.channels === 1 ? [codes[0], codes[0], codes[0]] : codes};
}
function srgb(value) {
  const v = value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055;
  return Math.round(255 * Math.min(Math.max(v, 0), 1)) || 0;
}
function valueAt(picture, x, y) {
  const i = y * picture.width + x;
  return picture.codes.map(plane => halves[plane[i]]);
}
function painted(picture, paint) {
  const canvas = new OffscreenCanvas(picture.width, picture.height), context = canvas.getContext('2d');
  const image = context.createImageData(picture.width, picture.height);
  paint(image.data);
  context.putImageData(image, 0, 0);
  return canvas;
}
// Hable 2010 as `aureole convert --tone filmic` has it: an exposure bias of 2, and white at 11.2.
function filmic(radiance) {
  const curve = x => (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 0.02 / 0.3;
  return radiance > 0 ? 2 * radiance >= 11.2 ? 1 : curve(2 * radiance) / curve(11.2) : 0;
}
const curves = {srgb: v => v, filmic};
function shown(picture, stops, curve) {
  const tone = new Uint8ClampedArray(65536), scale = 2 ** stops;
  for (let i = 0; i < 65536; ++i)
    tone[i] = srgb(curves[curve](halves[i] * scale));
  return painted(picture, data => {
    const [r, g, b] = picture.codes;
    for (let i = 0, k = 0; i < r.length; ++i, k += 4) {
      data[k] = tone[r[i]];
      data[k + 1] = tone[g[i]];
      data[k + 2] = tone[b[i]];
      data[k + 3] = 255;
    }
  });
}
function differenceShown(picture, reference, stops) {
  const scale = 2 ** stops;
  return painted(picture, data => {
    for (let i = 0, k = 0; i < picture.codes[0].length; ++i, k += 4) {
      for (let c = 0; c < 3; ++c)
        data[k + c] = srgb(scale * Math.abs(halves[picture.codes[c][i]] - halves[reference.codes[c][i]]));
      data[k + 3] = 255;
    }
  });
}
// The largest absolute difference of a pixel's channels in false colour, `largest` and more being white.
function errorShown(picture, reference, palette, largest) {
  return painted(picture, data => {
    for (let i = 0, k = 0; i < picture.codes[0].length; ++i, k += 4) {
      let off = 0;
      for (let c = 0; c < 3; ++c)
        off = Math.max(off, Math.abs(halves[picture.codes[c][i]] - halves[reference.codes[c][i]]));
      const index = 3 * Math.min(255, Math.round(255 * off / largest));
      data.set([palette[index], palette[index + 1], palette[index + 2], 255], k);
    }
  });
}
const grey = (picture, i) => (halves[picture.codes[0][i]] + halves[picture.codes[1][i]] + halves[picture.codes[2][i]]) / 3;
function largestValue(picture) {
  if (picture.largest === undefined) {
    picture.largest = 0;
    for (let i = 0; i < picture.codes[0].length; ++i) {
      const value = grey(picture, i);
      if (value < Infinity)
        picture.largest = Math.max(picture.largest, value);
    }
  }
  return picture.largest;
}
// Values in false colour up to `largest`; contours, eight of them, are where the pixel to the right or below lies in another band.
function valuesShown(picture, palette, largest, contours) {
  const {width, height} = picture, band = i => Math.floor(8 * Math.min(grey(picture, i) / largest, 1));
  return painted(picture, data => {
    for (let i = 0, k = 0; i < width * height; ++i, k += 4) {
      const index = 3 * Math.max(0, Math.min(255, Math.round(255 * grey(picture, i) / largest))) || 0;
      const edge = contours && ((i % width + 1 < width && band(i) !== band(i + 1)) || (i + width < width * height && band(i) !== band(i + width)));
      data.set(edge ? [255, 255, 255, 255] : [palette[index], palette[index + 1], palette[index + 2], 255], k);
    }
  });
}
function statistics(picture, reference) {
  let squares = 0, largest = 0;
  for (let c = 0; c < 3; ++c)
    for (let i = 0; i < picture.codes[c].length; ++i) {
      const off = Math.abs(halves[picture.codes[c][i]] - halves[reference.codes[c][i]]);
      squares += off * off;
      largest = Math.max(largest, off);
    }
  return {rmse: Math.sqrt(squares / (3 * picture.codes[0].length)), largest};
}
