// The player: the scene at a moment of the clock, and its controls. Everything that the mouse does has a key or a control:
// space plays, comma and full stop step by a frame, arrows turn the view, plus and minus go nearer and away.

import {Along} from './along.js';
import {gradient, short} from './colours.js';
import {Scene} from './scene.js';

const byId = (id) => document.getElementById(id);

const scales = {
  axial: {name: 'axial velocity', unit: 'm/s'},
  speed: {name: 'speed', unit: 'm/s'},
  contacts: {name: 'contacts', unit: ''},
  id: {name: 'number in input order', unit: ''},
  serial: {name: 'number in order of entry', unit: ''},
  species: {name: 'species', unit: ''},
  diameter: {name: 'diameter', unit: 'm'},
};

export class Player {
  constructor(frames, run, clock) {
    this.frames = frames;
    this.clock = clock;
    this.run = run;
    this.period = run.pipe.periodic ? run.pipe.length : 0;
    this.canvas = byId('stage');
    this.scene = new Scene(this.canvas, {radii: frames.radii(run.radius), pipe: run.pipe});
    this.playing = false;
    this.drawn = 0;
    byId('scale-bar').style.background = gradient();
    this.connect();
    this.choose();
    new ResizeObserver(() => this.fit()).observe(this.canvas);
    if (run.line) this.along = new Along(run, clock, this);
    clock.follow((time) => this.show(time));
  }

  // As high as the pipe, or the part of it that is shown, asks for when it is seen from the side.
  fit() {
    const width = this.canvas.clientWidth;
    const height = Math.min(Math.max(1.5 * width * this.run.pipe.diameter / this.scene.part.length, 260), 460);
    this.canvas.style.height = `${height}px`;
    this.scene.resize(width, height);
  }

  connect() {
    const {clock} = this;
    const slider = byId('time');
    slider.max = clock.end;
    slider.step = clock.end / 1000;
    slider.addEventListener('input', () => {
      this.stop();
      clock.set(Number(slider.value));
    });
    byId('play').addEventListener('click', () => (this.playing ? this.stop() : this.play()));
    byId('colour').addEventListener('change', () => this.choose());
    byId('cut').addEventListener('change', () => {
      this.scene.uniforms.cut.value = byId('cut').checked;
      this.scene.request();
    });
    for (const button of document.querySelectorAll('[data-view]'))
      button.addEventListener('click', () => this.scene.view(button.dataset.view));
    this.canvas.addEventListener('keydown', (event) => this.key(event));
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const {scene} = this;
    const action = {
      ' ': () => (this.playing ? this.stop() : this.play()),
      ',': () => this.stepBy(-1),
      '.': () => this.stepBy(1),
      'ArrowLeft': () => scene.turn(-0.1, 0),
      'ArrowRight': () => scene.turn(0.1, 0),
      'ArrowUp': () => scene.turn(0, 0.1),
      'ArrowDown': () => scene.turn(0, -0.1),
      '+': () => scene.turn(0, 0, 1.15),
      '=': () => scene.turn(0, 0, 1.15),
      '-': () => scene.turn(0, 0, 1 / 1.15),
    }[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  stepBy(count) {
    this.stop();
    const {frame, part} = this.frames.place(this.clock.time);
    const next = count < 0 && part > 0 ? frame : frame + count;
    this.clock.set(this.frames.times[Math.min(Math.max(next, 0), this.frames.times.length - 1)]);
  }

  play() {
    if (this.clock.time >= this.clock.end) this.clock.set(0);
    this.playing = true;
    byId('play').textContent = 'Pause';
    let before = null;
    const tick = (now) => {
      if (!this.playing) return;
      if (before !== null) this.clock.set(this.clock.time + ((now - before) / 1000) * Number(byId('rate').value));
      before = now;
      if (this.clock.time >= this.clock.end) this.stop();
      else requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  stop() {
    this.playing = false;
    byId('play').textContent = 'Play';
  }

  // Another quantity to colour by: the scale below says what its ends mean.
  choose() {
    const name = byId('colour').value;
    const {frames} = this, last = frames.lastSerial ?? (frames.particles - 1) * frames.share;
    const range = name === 'id' ? {low: 0, high: last} : frames.rangeOf(name);
    const {names} = range, scale = scales[name === 'id' && frames.serials ? 'serial' : name];
    byId('scale-low').textContent = names ? names[0] : short(range.low);
    byId('scale-high').textContent = names ? names.at(-1) : `${short(range.high)} ${scale.unit}`;
    byId('scale-name').textContent = names?.length > 2 ? `species ${names.join(', ')}:` : scale.name;
    this.show(this.clock.time);
  }

  show(time) {
    const {frames, scene} = this;
    if (frames.serials) {
      frames.placesInLine(time, scene.centres, this.run.pipe.length);
      frames.radii(this.run.radius, scene.radii);
      this.along?.follow(time);
    } else {
      frames.placesAt(time, scene.centres, this.period);
    }
    const name = byId('colour').value;
    if (name === 'id') frames.numberShares(scene.shares);
    else frames.shares(name, scene.shares);
    scene.update();
    ++this.drawn;
    byId('time').value = time;
    byId('time').setAttribute('aria-valuetext', `${short(time)} s`);
    byId('now').textContent = `${time.toFixed(3)} s`;
  }
}
