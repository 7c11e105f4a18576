// Which part of a long pipe the player shows: it stays, is moved along the pipe by hand, or moves with a plug. The strip is the
// whole pipe, coloured by solids fraction at the moment, with the part marked; it is dragged with the mouse and has the keys
// of a slider.

import {colour} from './colours.js';

const byId = (id) => document.getElementById(id);

// Where the front of a plug is at a time (m), null before and after.
export function frontAt({points}, time) {
  if (time < points[0][0] || time > points.at(-1)[0]) return null;
  const k = Math.max(1, points.findIndex(([t]) => t >= time));
  if (points.length === 1) return points[0][1];
  const [from, z] = points[k - 1], [to, there] = points[k];
  return z + ((time - from) / (to - from)) * (there - z);
}

export class Along {
  constructor({pipe, line, maps}, clock, player) {
    this.pipe = pipe;
    this.tracks = line.tracks;
    this.solids = maps[0];
    this.clock = clock;
    this.player = player;
    this.reach = line.window;
    this.strip = byId('strip');
    byId('reach').addEventListener('change', () => {
      const middle = this.begin + this.reach / 2;
      this.reach = Number(byId('reach').value);
      this.show(middle);
      player.fit();
    });
    byId('with').addEventListener('change', () => this.choose());
    this.strip.addEventListener('pointerdown', (event) => {
      this.strip.setPointerCapture(event.pointerId);
      this.byHand(this.placeOf(event));
    });
    this.strip.addEventListener('pointermove', (event) => event.buttons && this.byHand(this.placeOf(event)));
    this.strip.addEventListener('keydown', (event) => {
      const way = {ArrowLeft: -0.1, ArrowDown: -0.1, ArrowRight: 0.1, ArrowUp: 0.1, PageDown: -1, PageUp: 1, Home: -Infinity, End: Infinity}[event.key];
      if (!way) return;
      event.preventDefault();
      this.byHand(this.begin + this.reach / 2 + way * this.reach);
    });
    this.show(0);
  }

  placeOf(event) {
    const {left, width} = this.strip.getBoundingClientRect();
    return ((event.clientX - left) / width) * this.pipe.length;
  }

  byHand(middle) {
    byId('with').value = '';
    this.show(middle);
  }

  // A plug that is chosen is looked at from its birth on, when it is not there at the moment.
  choose() {
    const plug = this.tracks.find(({plug}) => String(plug) === byId('with').value);
    if (plug && frontAt(plug, this.clock.time) === null) this.clock.set(plug.points[0][0]);
    else this.follow(this.clock.time);
  }

  // The plug to move with: the one that is chosen, or the same one until its end and then the one that will be there longest.
  followed(time) {
    const wanted = byId('with').value, isThere = (track) => frontAt(track, time) !== null;
    if (wanted !== 'each') return this.tracks.find((track) => String(track.plug) === wanted && isThere(track));
    if (!this.last || !isThere(this.last)) {
      const end = ({points}) => points.at(-1)[0];
      this.last = this.tracks.filter(isThere).sort((a, b) => end(b) - end(a))[0];
    }
    return this.last;
  }

  follow(time) {
    const plug = this.followed(time);
    if (plug) {  // smoothly: a front is found in slices
      const fronts = [-0.1, 0, 0.1].map((apart) => frontAt(plug, time + apart)).filter((front) => front !== null);
      this.show(fronts.reduce((a, b) => a + b) / fronts.length - 0.2 * this.reach);
    }
    this.paint(time);
  }

  show(middle) {
    const {pipe, reach} = this;
    this.begin = Math.min(Math.max(middle - reach / 2, 0), pipe.length - reach);
    this.player.scene.look(this.begin, reach);
    const words = `${this.begin.toFixed(2)} to ${(this.begin + reach).toFixed(2)} m`;
    byId('where').textContent = words;
    this.strip.setAttribute('aria-valuenow', (this.begin + reach / 2).toFixed(3));
    this.strip.setAttribute('aria-valuetext', words);
    const part = this.strip.querySelector('.part');
    part.style.left = `${(100 * this.begin) / pipe.length}%`;
    part.style.width = `${(100 * reach) / pipe.length}%`;
  }

  paint(time) {
    if (!this.solids) return;
    const {times, values, low, high} = this.solids, canvas = this.strip.querySelector('canvas');
    const after = times.findIndex((moment) => moment >= time), row = values[after < 0 ? values.length - 1 : after];
    if (canvas.width !== row.length) [canvas.width, canvas.height] = [row.length, 1];
    const context = canvas.getContext('2d'), image = context.createImageData(row.length, 1);
    row.forEach((value, k) => image.data.set([...colour((value - low) / (high - low || 1)), 255], 4 * k));
    context.putImageData(image, 0, 0);
  }
}
