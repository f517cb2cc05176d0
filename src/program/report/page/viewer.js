// The viewer of images of one scene: flip, split, side by side, differences. The URL's fragment stores its state.
'use strict';
const modes = [['flip', 'One', 'f'], ['split', 'Slider', 's'], ['side', 'Side by side', 'g'], ['difference', 'Difference', 'd'],
               ['error', 'False colour', 'c'], ['values', 'Values', 'v'], ['contours', 'Contours', 'l']];
const viewers = [];
class Viewer {
  constructor(figure, index, images) {
    Object.assign(this, {figure, index, images});
    this.palette = document.getElementById('palette').textContent.trim().match(/../g).map(h => parseInt(h, 16));
    const reference = images.findIndex(p => p.reference);
    this.b = Math.max(reference, 0);
    this.a = this.b === 0 && images.length > 1 ? 1 : 0;
    this.unit = figure.dataset.unit || '';
    this.mode = this.unit ? 'values' : 'flip';
    this.valueStops = 0;
    this.exposure = Number(figure.dataset.exposure || 0);
    this.errorStops = 0;
    this.split = 0.5;
    this.curve = 'srgb';
    this.cache = new Map();
    this.build();
    this.fit();
  }
  build() {
    const bar = (...items) => {
      const made = document.createElement('div');
      made.className = 'bar';
      made.append(...items);
      return made;
    };
    const button = (text, title, act) => {
      const made = document.createElement('button');
      Object.assign(made, {type: 'button', textContent: text, title});
      made.addEventListener('click', () => { act(); this.draw(); });
      return made;
    };
    this.names = this.images.map((p, i) => button(p.name, `key ${i + 1}`, () => this.choose(i)));
    this.modes = modes.map(([name, text, key]) => button(text, `key ${key}`, () => { this.mode = name; }));
    this.range = document.createElement('input');
    Object.assign(this.range, {type: 'range', min: -10, max: 10, step: 0.5});
    this.range.addEventListener('input', () => { this.setStops(Number(this.range.value)); this.draw(); });
    this.stopsText = document.createElement('span');
    const label = document.createElement('label');
    label.append('Exposure', this.range, this.stopsText);
    this.curves = document.createElement('select');
    this.curves.append(new Option('sRGB', 'srgb'), new Option('Filmic', 'filmic'));
    this.curves.addEventListener('change', () => { this.curve = this.curves.value; this.draw(); });
    const tone = document.createElement('label');
    tone.append('Tone', this.curves);
    this.canvas = document.createElement('canvas');
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute('role', 'img');
    this.output = document.createElement('output');
    const help = document.createElement('details');
    help.innerHTML = '<summary>Keys</summary>1 to 9, left, right: image. Space: to and fro. f, s, g, d, c, v, l: one, slider, side by side, ' +
      'difference, its false colour, values in false colour, with contours. [ ]: move the slider. e, E: exposure. + - 0: zoom. Shift and arrows: move. Drag, wheel and two fingers work too.';
    this.bar = bar(...this.names);
    this.figure.append(this.bar,
      bar(...this.modes, label, tone, button('\u2212', 'key -', () => this.zoomBy(0.5)), button('+', 'key +', () => this.zoomBy(2)),
          button('Fit', 'key 0', () => this.fit())), this.canvas, this.output, help);
    this.figure.addEventListener('keydown', event => this.key(event));
    this.listen();
    new ResizeObserver(() => { if (this.fitted) this.fit(); this.draw(); }).observe(this.canvas);
  }
  choose(i) {
    if (i === this.a || i < 0 || i >= this.images.length)
      return;
    if (!this.images[this.b].reference)
      this.b = this.a;
    this.a = i;
  }
  isError() { return this.mode === 'difference' || this.mode === 'error'; }
  isMap() { return this.mode === 'values' || this.mode === 'contours'; }
  stops() { return this.isError() ? this.errorStops : this.isMap() ? this.valueStops : this.exposure; }
  setStops(stops) {
    if (this.isError())
      this.errorStops = stops;
    else if (this.isMap())
      this.valueStops = stops;
    else
      this.exposure = stops;
  }
  // Rectangles of images in pixels of the canvas: [image, x, y, width, height].
  cells() {
    const {width, height} = this.canvas, n = this.images.length;
    if (this.mode !== 'side')
      return [[this.a, 0, 0, width, height]];
    let best = 1, largest = 0;
    for (let columns = 1; columns <= n; ++columns) {
      const cell = Math.min(width / columns / this.images[0].width, height / Math.ceil(n / columns) / this.images[0].height);
      if (cell > largest)
        [best, largest] = [columns, cell];
    }
    const w = Math.floor(width / best), h = Math.floor(height / Math.ceil(n / best));
    return this.images.map((_, i) => [i, i % best * w, Math.floor(i / best) * h, w - 2, h - 2]);
  }
  fit() {
    this.resize();
    const [, , , w, h] = this.cells()[0], {width, height} = this.images[0];
    this.zoom = Math.min(w / width, h / height);
    [this.x, this.y] = [width / 2, height / 2];
    this.fitted = true;
  }
  zoomBy(factor) {
    this.zoom = Math.min(Math.max(this.zoom * factor, 0.05), 400);
    this.fitted = false;
  }
  resize() {
    const scale = window.devicePixelRatio || 1, box = this.canvas.getBoundingClientRect();
    const width = Math.max(1, Math.round(box.width * scale)), height = Math.max(1, Math.round(box.height * scale));
    if (width !== this.canvas.width || height !== this.canvas.height)
      Object.assign(this.canvas, {width, height});
  }
  source(i) {
    const key = [i, this.isError() ? this.b : -1, this.isError() || this.isMap() ? this.mode : '', this.stops(), this.curve].join();
    if (!this.cache.has(key)) {
      if (this.cache.size > 3 * this.images.length)
        this.cache.clear();
      const [p, r] = [this.images[i], this.images[this.b]];
      this.cache.set(key, this.isMap() ? valuesShown(p, this.palette, this.scale(), this.mode === 'contours') : this.mode === 'error' ? errorShown(p, r, this.palette, this.scale())
        : this.mode === 'difference' ? differenceShown(p, r, this.stops()) : shown(p, this.stops(), this.curve));
    }
    return this.cache.get(key);
  }
  // The value or difference of the brightest colour.
  scale() {
    if (this.isMap())
      return Math.max(...this.images.map(largestValue)) * 2 ** -this.valueStops || 1;
    return (statistics(this.images[this.a], this.images[this.b]).largest || 1) * 2 ** -this.errorStops;
  }
  draw() {
    this.resize();
    const context = this.canvas.getContext('2d'), scale = window.devicePixelRatio || 1;
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    context.imageSmoothingEnabled = this.zoom < 1;
    context.font = `${12 * scale}px system-ui, sans-serif`;
    const cells = this.cells();
    for (const [i, x, y, w, h] of cells) {
      this.paint(context, i, x, y, w, h, x, w);
      if (this.mode === 'side')
        this.caption(context, this.images[i].name, x, y + 16 * scale, scale);
    }
    if (this.mode === 'split') {
      const at = Math.round(this.split * this.canvas.width);
      this.paint(context, this.b, 0, 0, this.canvas.width, this.canvas.height, at, this.canvas.width - at);
      context.fillStyle = '#fff';
      context.fillRect(at - scale, 0, 2 * scale, this.canvas.height);
      this.caption(context, this.images[this.a].name, 0, 16 * scale, scale);
      this.caption(context, this.images[this.b].name, at + 2, 32 * scale, scale);
    }
    if (this.mode === 'error' || this.isMap())
      this.colourBar(context, scale);
    this.tell();
  }
  // Draws `width` pixels of an image from `from` on in a cell.
  paint(context, i, x, y, w, h, from, width) {
    const left = x + w / 2 - this.x * this.zoom, top = y + h / 2 - this.y * this.zoom, p = this.images[i];
    context.save();
    context.beginPath();
    context.rect(from, y, width, h);
    context.clip();
    context.fillStyle = '#404040';
    context.fillRect(from, y, width, h);
    context.drawImage(this.source(i), left, top, p.width * this.zoom, p.height * this.zoom);
    if (this.zoom >= 40 * (window.devicePixelRatio || 1))
      this.numbers(context, i, left, top, x, y, w, h);
    context.restore();
  }
  numbers(context, i, left, top, x, y, w, h) {
    const p = this.images[i], size = this.zoom / 5;
    context.save();
    context.font = `${size}px ui-monospace, monospace`;
    for (let row = Math.max(0, Math.floor((y - top) / this.zoom)); row < p.height && top + row * this.zoom < y + h; ++row)
      for (let col = Math.max(0, Math.floor((x - left) / this.zoom)); col < p.width && left + col * this.zoom < x + w; ++col)
        valueAt(p, col, row).forEach((v, c) => {
          context.lineWidth = size / 5;
          context.strokeStyle = '#000';
          context.fillStyle = ['#ffb0a8', '#b4ffb4', '#b8ccff'][c];
          const text = v.toPrecision(3), at = [left + (col + 0.05) * this.zoom, top + row * this.zoom + (c + 1.5) * 1.2 * size];
          context.strokeText(text, ...at);
          context.fillText(text, ...at);
        });
    context.restore();
  }
  caption(context, text, x, y, scale) {
    context.fillStyle = '#000a';
    context.fillRect(x, y - 13 * scale, context.measureText(text).width + 8 * scale, 16 * scale);
    context.fillStyle = '#fff';
    context.fillText(text, x + 4 * scale, y);
  }
  colourBar(context, scale) {
    const width = Math.min(256 * scale, this.canvas.width - 20), top = this.canvas.height - 30 * scale;
    for (let i = 0; i < 256; ++i) {
      context.fillStyle = `rgb(${this.palette.slice(3 * i, 3 * i + 3)})`;
      context.fillRect(10 + i * width / 256, top, width / 256 + 1, 10 * scale);
    }
    this.caption(context, `0 to ${this.scale().toPrecision(3)} ${this.unit}`, 10, top + 24 * scale, scale);
  }
  // Describes the view: its state in the figure, the values of a pixel in the line below.
  tell() {
    const {width, height} = this.images[0], at = this.pointed || [this.x, this.y];
    const [x, y] = [Math.min(Math.max(Math.floor(at[0]), 0), width - 1), Math.min(Math.max(Math.floor(at[1]), 0), height - 1)];
    const [p, r] = [this.images[this.a], this.images[this.b]];
    const values = q => valueAt(q, x, y).map(v => v.toPrecision(4)).join(' ');
    let text = `pixel ${x}, ${y}   ${p.name}: ${values(p)}`;
    if (this.a !== this.b)
      text += `   ${r.name}: ${values(r)}\nRMSE of ${p.name} against ${r.name}: ${statistics(p, r).rmse.toPrecision(4)}`;
    this.output.textContent = text;
    this.figure.dataset.state = this.address();
    this.canvas.setAttribute('aria-label', `${modes.find(m => m[0] === this.mode)[1]}: ${p.name}`);
    this.names.forEach((b, i) => b.setAttribute('aria-pressed', i === this.a));
    this.modes.forEach((b, i) => b.setAttribute('aria-pressed', modes[i][0] === this.mode));
    this.range.value = this.stops();
    this.curves.value = this.curve;
    this.stopsText.textContent = `${this.stops()} stops`;
  }
  address() {
    const round = v => Number(v.toFixed(3));
    return `viewer=${this.index}&mode=${this.mode}&a=${this.a}&b=${this.b}&e=${this.stops()}&z=${round(this.zoom)}&x=${round(this.x)}&y=${round(this.y)}` +
      (this.curve === 'srgb' ? '' : `&tone=${this.curve}`);
  }
  go(wanted) {
    const number = (name, otherwise) => wanted.has(name) && isFinite(wanted.get(name)) ? Number(wanted.get(name)) : otherwise;
    const image = (name, otherwise) => Math.min(Math.max(Math.round(number(name, otherwise)), 0), this.images.length - 1);
    if (modes.some(m => m[0] === wanted.get('mode')))
      this.mode = wanted.get('mode');
    [this.a, this.b] = [image('a', this.a), image('b', this.b)];
    this.setStops(number('e', this.stops()));
    if (wanted.get('tone') in curves)
      this.curve = wanted.get('tone');
    this.fit();
    if (wanted.has('z'))
      this.zoomBy(number('z', 1) / this.zoom);
    [this.x, this.y] = [number('x', this.x), number('y', this.y)];
    this.split = number('split', this.split);
    for (const key of (wanted.get('keys') || '').split(',').filter(k => k !== ''))
      this.key(new KeyboardEvent('keydown', {key: key === 'Space' ? ' ' : key}));
    this.draw();
  }
  key(event) {
    const step = 40 / this.zoom, picked = '123456789'.indexOf(event.key);
    const mode = modes.find(m => m[2] === event.key);
    if (event.ctrlKey || event.metaKey || event.altKey || (event.target instanceof HTMLInputElement && event.key.startsWith('Arrow')))
      return;
    if (event.target instanceof HTMLButtonElement && event.key === ' ')
      return;
    const moves = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
    if (event.key.length === 1 && picked >= 0)
      this.choose(picked);
    else if (mode !== undefined)
      this.mode = mode[0];
    else if (moves !== undefined && event.shiftKey) {
      [this.x, this.y] = [this.x + step * moves[0], this.y + step * moves[1]];
      this.fitted = false;
    } else if (event.key === 'ArrowLeft' || event.key === 'ArrowRight')
      this.choose((this.a + moves[0] + this.images.length) % this.images.length);
    else if (event.key === ' ')
      [this.a, this.b] = [this.b, this.a];
    else if (event.key === 'e' || event.key === 'E')
      this.setStops(this.stops() + (event.key === 'e' ? 0.5 : -0.5));
    else if (event.key === '+' || event.key === '=' || event.key === '-')
      this.zoomBy(event.key === '-' ? 0.5 : 2);
    else if (event.key === '0')
      this.fit();
    else if (event.key === '[' || event.key === ']')
      this.split = Math.min(Math.max(this.split + (event.key === '[' ? -0.05 : 0.05), 0), 1);
    else
      return;
    event.preventDefault();
    this.draw();
  }
  // Converts a position on the canvas to pixels of the image.
  placeOf(event) {
    const box = this.canvas.getBoundingClientRect(), scale = this.canvas.width / box.width;
    const px = (event.clientX - box.left) * scale, py = (event.clientY - box.top) * scale;
    const cell = this.cells().find(([, x, y, w, h]) => px >= x && px < x + w && py >= y && py < y + h) || this.cells()[0];
    return [this.x + (px - cell[1] - cell[3] / 2) / this.zoom, this.y + (py - cell[2] - cell[4] / 2) / this.zoom];
  }
  zoomAt(event, factor) {
    const before = this.placeOf(event);
    this.zoomBy(factor);
    const after = this.placeOf(event);
    [this.x, this.y] = [this.x + before[0] - after[0], this.y + before[1] - after[1]];
  }
  listen() {
    const fingers = new Map();
    let sliding = false;
    this.canvas.addEventListener('pointerdown', event => {
      const box = this.canvas.getBoundingClientRect();
      fingers.set(event.pointerId, event);
      sliding = this.mode === 'split' && Math.abs((event.clientX - box.left) / box.width - this.split) * box.width < 24;
      this.canvas.setPointerCapture(event.pointerId);
    });
    this.canvas.addEventListener('pointermove', event => {
      const last = fingers.get(event.pointerId), box = this.canvas.getBoundingClientRect(), scale = this.canvas.width / box.width;
      if (last !== undefined && sliding)
        this.split = Math.min(Math.max((event.clientX - box.left) / box.width, 0), 1);
      else if (last !== undefined) {
        const part = scale / this.zoom / fingers.size;
        [this.x, this.y] = [this.x - (event.clientX - last.clientX) * part, this.y - (event.clientY - last.clientY) * part];
        const other = [...fingers].filter(([id]) => id !== event.pointerId).map(([, f]) => f)[0];
        const apart = f => Math.hypot(f.clientX - other.clientX, f.clientY - other.clientY);
        if (other !== undefined && apart(last) > 0)
          this.zoomAt(event, apart(event) / apart(last));
        this.fitted = false;
      }
      if (last !== undefined)
        fingers.set(event.pointerId, event);
      this.pointed = this.placeOf(event);
      if (last !== undefined)
        this.draw();
      else
        this.tell();
    });
    for (const end of ['pointerup', 'pointercancel'])
      this.canvas.addEventListener(end, event => fingers.delete(event.pointerId));
    this.canvas.addEventListener('pointerleave', () => { this.pointed = undefined; });
    this.canvas.addEventListener('wheel', event => {
      event.preventDefault();
      this.zoomAt(event, 2 ** (-event.deltaY / 300));
      this.draw();
    }, {passive: false});
  }
}
function goToAddress() {
  const wanted = new URLSearchParams(location.hash.slice(1));
  const viewer = viewers[Number(wanted.get('viewer') || 0)];
  if (viewer !== undefined && ['viewer', 'mode', 'keys', 'z'].some(name => wanted.has(name))) {
    viewer.go(wanted);
    viewer.figure.scrollIntoView();
  }
}
(async () => {
  const figures = [...document.querySelectorAll('figure.viewer:not([data-live])')];
  for (const [i, figure] of figures.entries()) {
    const made = JSON.parse(figure.querySelector('script').textContent);
    viewers.push(new Viewer(figure, i, await Promise.all(made.map(unpack))));
    viewers[i].draw();
  }
  document.addEventListener('keydown', event => {
    if (event.target === document.body && viewers.length === 1)
      viewers[0].key(event);
  });
  window.addEventListener('hashchange', goToAddress);
  goToAddress();
  document.documentElement.dataset.ready = viewers.length;
})();
