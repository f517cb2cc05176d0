// Shows an image in a viewer while the program renders it.
'use strict';
class Live {
  constructor(figure) {
    this.figure = figure;
    this.page = crypto.getRandomValues(new Uint32Array(1))[0];
    [this.serial, this.version] = [0, 0];
    this.said = document.getElementById('said');
    this.share = document.getElementById('share');
  }
  async fetchJson(path) {
    const response = await fetch(path);
    if (!response.ok)
      throw new Error(`${path}: ${response.status}`);
    return response.json();
  }
  async run() {
    for (let failures = 0; failures < 3;)
      try {
        this.state = await this.fetchJson(`state/${this.page}/${this.serial}`);
        failures = 0;
        const ended = this.state.ended !== '';
        this.serial = this.state.serial;
        this.tell();
        if (this.state.version !== this.version || ended)
          await this.take(ended);
        if (ended)
          return this.end();
      } catch (error) {
        console.warn(error);
        ++failures;
        await new Promise(done => setTimeout(done, 500));
      }
    this.say('The program does not answer any more.');
    this.stop?.remove();
  }
  say(text) { this.said.textContent = text; }
  tell() {
    const {what, known, ended, share} = this.state;
    this.share.value = ended ? 1 : share;
    if (this.viewer === undefined) // no image yet
      this.figure.textContent = ended || `${what} ...`;
    this.say([ended || `${what}: ${(100 * share).toFixed(0)} %`, known].filter(text => text !== '').join(ended ? ' ' : '; '));
    document.title = ended || `${(100 * share).toFixed(0)} % ${document.querySelector('h1').textContent}`;
  }
  // Requests the visible layers, or all, and draws them.
  async take(all) {
    const {width, height, layers} = this.state;
    this.version = this.state.version;
    if (layers.length === 0)
      return;
    this.begin(width, height, layers);
    const viewer = this.viewer, seen = viewer.mode === 'side' || all ? layers.map((_, i) => i)
      : [...new Set(viewer.mode === 'flip' ? [viewer.a] : [viewer.a, viewer.b])];
    for (const i of seen)
      viewer.images[i] = await unpack(await this.fetchJson(`image/${i}`));
    viewer.cache.clear();
    viewer.draw();
    this.figure.dataset.version = this.version;
  }
  begin(width, height, layers) {
    if (this.viewer !== undefined && this.viewer.images.length === layers.length)
      return;
    const black = new Uint16Array(width * height);
    const images = layers.map(layer => ({name: layer.name, width, height, reference: false, codes: [black, black, black]}));
    this.figure.replaceChildren();
    this.viewer = viewers[0] = new Viewer(this.figure, 0, images);
    this.viewer.a = this.viewer.b = 0;
    const button = (text, title, act) => {
      const made = document.createElement('button');
      Object.assign(made, {type: 'button', textContent: text, title});
      made.addEventListener('click', act);
      return made;
    };
    this.stop = button('Stop', 'ends the render and keeps what there is', () => {
      this.stop.disabled = true;
      fetch('stop', {method: 'POST'});
    });
    if (this.state.turns)
      this.addTurning(button);
    this.viewer.bar.append(button('Save PNG', 'as it is seen', () => this.savePng()),
      button('Save EXR', 'the values, as 16-bit floats', () => this.saveExr()), this.stop);
    for (const choice of [...this.viewer.names, ...this.viewer.modes])
      choice.addEventListener('click', () => this.take(false).catch(() => {}));
    goToAddress();
  }
  // Dragging turns the camera in its mode or with the shift key; two fingers or the wheel change its distance.
  // Sends the program the rotation since the last time; it renders again.
  addTurning(button) {
    const fingers = new Map(), canvas = this.viewer.canvas;
    const turn = button('Turn', 'dragging turns the camera', () => {
      turn.setAttribute('aria-pressed', String(turn.getAttribute('aria-pressed') !== 'true'));
      fetch('turn/0/0/1', {method: 'POST'}).catch(() => {}); // the program waits for turns when the image is finished
    });
    turn.setAttribute('aria-pressed', 'false');
    this.viewer.bar.append(turn);
    const active = event => event.shiftKey || turn.getAttribute('aria-pressed') === 'true';
    const pending = {azimuth: 0, elevation: 0, distance: 1, waits: false};
    const send = () => {
      if (pending.waits)
        return;
      pending.waits = true;
      setTimeout(() => {
        const path = `turn/${pending.azimuth.toFixed(3)}/${pending.elevation.toFixed(3)}/${pending.distance.toFixed(5)}`;
        Object.assign(pending, {azimuth: 0, elevation: 0, distance: 1, waits: false});
        fetch(path, {method: 'POST'}).catch(() => {});
      }, 100);
    };
    const spread = () => {
      const [a, b] = [...fingers.values()];
      return b === undefined ? 0 : Math.hypot(a.x - b.x, a.y - b.y);
    };
    const on = (name, act) => canvas.addEventListener(name, event => {
      if (!active(event) && !fingers.has(event.pointerId))
        return;
      event.stopImmediatePropagation();
      event.preventDefault();
      act(event);
    }, {capture: true, passive: false});
    on('pointerdown', event => {
      fingers.set(event.pointerId, {x: event.clientX, y: event.clientY});
      canvas.setPointerCapture(event.pointerId);
    });
    on('pointermove', event => {
      const last = fingers.get(event.pointerId);
      if (last === undefined)
        return;
      const before = spread(), degrees = 180 / canvas.getBoundingClientRect().width;
      fingers.set(event.pointerId, {x: event.clientX, y: event.clientY});
      if (fingers.size === 1) {
        pending.azimuth -= degrees * (event.clientX - last.x);
        pending.elevation += degrees * (event.clientY - last.y);
      } else if (before > 0 && spread() > 0) {
        pending.distance *= before / spread();
      }
      send();
    });
    for (const end of ['pointerup', 'pointercancel'])
      on(end, event => fingers.delete(event.pointerId));
    on('wheel', event => {
      pending.distance *= Math.exp(event.deltaY / 500);
      send();
    });
  }
  end() {
    this.stop?.remove();
    this.figure.dataset.ended = '';
    return fetch(`bye/${this.page}`, {method: 'POST'});
  }
  name(extension) { return document.querySelector('h1').textContent.replace(/^.*\//, '').replace(/\.[^.]*$/, '') + extension; }
  save(blob, name) {
    const link = document.createElement('a');
    Object.assign(link, {href: URL.createObjectURL(blob), download: name});
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }
  async savePng() { this.save(await this.viewer.source(this.viewer.a).convertToBlob(), this.name('.png')); }
  async saveExr() {
    if (this.figure.dataset.ended === undefined)
      await this.take(true);
    this.save(new Blob([exrFile(this.state.layers, this.viewer.images)]), this.name('.exr'));
  }
}
// An OpenEXR file of half floats without compression: one part, one line after the other, channels by their names.
function exrFile(layers, images) {
  const {width, height} = images[0];
  const channels = layers.flatMap((layer, l) => layer.channels.map((name, c) => ({name, plane: images[l].codes[c]})))
    .sort((a, b) => a.name < b.name ? -1 : 1);
  const head = [], bytes = (...values) => head.push(...values), text = t => bytes(...new TextEncoder().encode(t), 0);
  const number = value => bytes(...new Uint8Array(new Int32Array([value]).buffer));
  const attribute = (name, type, size) => { text(name); text(type); number(size); };
  const box = () => { number(0); number(0); number(width - 1); number(height - 1); };
  number(20000630);
  number(channels.some(c => c.name.length > 31) ? 0x402 : 2);
  attribute('channels', 'chlist', channels.reduce((sum, c) => sum + new TextEncoder().encode(c.name).length + 17, 1));
  for (const channel of channels) {
    text(channel.name);
    for (const value of [1, 0, 1, 1]) // pixel type half, pLinear 0, sampling 1 in x and y
      number(value);
  }
  bytes(0);
  attribute('compression', 'compression', 1);
  bytes(0);
  attribute('dataWindow', 'box2i', 16);
  box();
  attribute('displayWindow', 'box2i', 16);
  box();
  attribute('lineOrder', 'lineOrder', 1);
  bytes(0);
  attribute('pixelAspectRatio', 'float', 4);
  bytes(0, 0, 128, 63);
  attribute('screenWindowCenter', 'v2f', 8);
  number(0);
  number(0);
  attribute('screenWindowWidth', 'float', 4);
  bytes(0, 0, 128, 63, 0);
  const line = 2 * width * channels.length, first = head.length + 8 * height;
  const file = new DataView(new ArrayBuffer(first + height * (8 + line)));
  head.forEach((value, i) => file.setUint8(i, value));
  for (let y = 0; y < height; ++y) {
    let at = first + y * (8 + line);
    file.setBigUint64(head.length + 8 * y, BigInt(at), true);
    file.setInt32(at, y, true);
    file.setInt32(at + 4, line, true);
    at += 8;
    for (const {plane} of channels)
      for (let x = 0; x < width; ++x, at += 2)
        file.setUint16(at, plane[y * width + x], true);
  }
  return file.buffer;
}
document.addEventListener('DOMContentLoaded', () => {
  const live = new Live(document.querySelector('figure[data-live]'));
  window.addEventListener('pagehide', () => navigator.sendBeacon(`bye/${live.page}`));
  live.run();
});
