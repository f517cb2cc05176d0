// Images: packed half floats, and their display colours.
'use strict';
const halves = new Float32Array(65536); // the value of each 16-bit float
for (let i = 0; i < 65536; ++i) {
  const exponent = i >> 10 & 31, mantissa = i & 1023;
  const size = exponent === 0 ? mantissa * 2 ** -24 : exponent === 31 ? (mantissa ? NaN : Infinity)
    : (1 + mantissa / 1024) * 2 ** (exponent - 15);
  halves[i] = i & 0x8000 ? -size : size;
}
// Packed for each channel: the upper bytes, then the lower ones, as differences to the previous byte; deflated.
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
function valueAt(image, x, y) {
  const i = y * image.width + x;
  return image.codes.map(plane => halves[plane[i]]);
}
function painted(image, paint) {
  const canvas = new OffscreenCanvas(image.width, image.height), context = canvas.getContext('2d');
  const pixels = context.createImageData(image.width, image.height);
  paint(pixels.data);
  context.putImageData(pixels, 0, 0);
  return canvas;
}
// Hable 2010 as in `aureole convert --tone filmic`: an exposure bias of 2, and white at 11.2.
function filmic(radiance) {
  const curve = x => (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 0.02 / 0.3;
  return radiance > 0 ? 2 * radiance >= 11.2 ? 1 : curve(2 * radiance) / curve(11.2) : 0;
}
const curves = {srgb: v => v, filmic};
function shown(image, stops, curve) {
  const tone = new Uint8ClampedArray(65536), scale = 2 ** stops;
  for (let i = 0; i < 65536; ++i)
    tone[i] = srgb(curves[curve](halves[i] * scale));
  return painted(image, data => {
    const [r, g, b] = image.codes;
    for (let i = 0, k = 0; i < r.length; ++i, k += 4) {
      data[k] = tone[r[i]];
      data[k + 1] = tone[g[i]];
      data[k + 2] = tone[b[i]];
      data[k + 3] = 255;
    }
  });
}
function differenceShown(image, reference, stops) {
  const scale = 2 ** stops;
  return painted(image, data => {
    for (let i = 0, k = 0; i < image.codes[0].length; ++i, k += 4) {
      for (let c = 0; c < 3; ++c)
        data[k + c] = srgb(scale * Math.abs(halves[image.codes[c][i]] - halves[reference.codes[c][i]]));
      data[k + 3] = 255;
    }
  });
}
// The largest absolute difference of a pixel's channels in false colour; `largest` and above are white.
function errorShown(image, reference, palette, largest) {
  return painted(image, data => {
    for (let i = 0, k = 0; i < image.codes[0].length; ++i, k += 4) {
      let off = 0;
      for (let c = 0; c < 3; ++c)
        off = Math.max(off, Math.abs(halves[image.codes[c][i]] - halves[reference.codes[c][i]]));
      const index = 3 * Math.min(255, Math.round(255 * off / largest));
      data.set([palette[index], palette[index + 1], palette[index + 2], 255], k);
    }
  });
}
const grey = (image, i) => (halves[image.codes[0][i]] + halves[image.codes[1][i]] + halves[image.codes[2][i]]) / 3;
function largestValue(image) {
  if (image.largest === undefined) {
    image.largest = 0;
    for (let i = 0; i < image.codes[0].length; ++i) {
      const value = grey(image, i);
      if (value < Infinity)
        image.largest = Math.max(image.largest, value);
    }
  }
  return image.largest;
}
// Values in false colour up to `largest`. Eight contours are drawn where the pixel to the right or below is in another band.
function valuesShown(image, palette, largest, contours) {
  const {width, height} = image, band = i => Math.floor(8 * Math.min(grey(image, i) / largest, 1));
  return painted(image, data => {
    for (let i = 0, k = 0; i < width * height; ++i, k += 4) {
      const index = 3 * Math.max(0, Math.min(255, Math.round(255 * grey(image, i) / largest))) || 0;
      const edge = contours && ((i % width + 1 < width && band(i) !== band(i + 1)) || (i + width < width * height && band(i) !== band(i + width)));
      data.set(edge ? [255, 255, 255, 255] : [palette[index], palette[index + 1], palette[index + 2], 255], k);
    }
  });
}
function statistics(image, reference) {
  let squares = 0, largest = 0;
  for (let c = 0; c < 3; ++c)
    for (let i = 0; i < image.codes[c].length; ++i) {
      const off = Math.abs(halves[image.codes[c][i]] - halves[reference.codes[c][i]]);
      squares += off * off;
      largest = Math.max(largest, off);
    }
  return {rmse: Math.sqrt(squares / (3 * image.codes[0].length)), largest};
}
