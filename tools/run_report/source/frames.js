// The frames of the run, out of their compressed form (player_data.py describes it): positions and three values of every
// particle at every frame, as typed arrays of frames x particles; and what each particle keeps, where particles differ. In an open
// line particles come and go: then it is rows, with one particle after another in each, and serial numbers say whose it is.

async function inflate(base64) {
  const packed = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Undoes the differences from frame to frame; the typed array wraps round as they did.
function summed(numbers, particles) {
  for (let k = particles; k < numbers.length; ++k) numbers[k] += numbers[k - particles];
  return numbers;
}

export async function decodeFrames(about, base64) {
  const bytes = await inflate(base64);
  const count = about.times.length * about.particles;
  let at = 0;
  const fromPlanes = (numbers) => {  // the lowest bytes of all, then the next
    for (let plane = 0; plane < numbers.BYTES_PER_ELEMENT; ++plane, at += numbers.length)
      for (let k = 0; k < numbers.length; ++k) numbers[k] |= bytes[at + k] << (8 * plane);
    return numbers;
  };
  const from16 = (size) => fromPlanes(new Uint16Array(size));
  const positions = ['x', 'y', 'z'].map((axis) => ({...about.scale[axis], numbers: summed(from16(count), about.particles)}));
  const values = {};
  for (const name of ['axial', 'speed', 'contacts']) {
    values[name] = {...about.scale[name], numbers: summed(bytes.slice(at, at + count), about.particles)};
    at += count;
  }
  const own = {}, isLine = 'last_serial' in about, size = isLine ? count : about.particles;
  const laidOut = (numbers) => isLine ? summed(numbers, about.particles) : numbers;
  if (about.own?.diameter) own.diameter = {...about.own.diameter, numbers: laidOut(from16(size))};
  if (about.own?.species) {
    own.species = {...about.own.species, numbers: laidOut(bytes.slice(at, at + size))};
    at += size;
  }
  const serials = isLine ? summed(fromPlanes(new Uint32Array(count)), about.particles) : null;
  return new Frames(about, positions, values, own, serials);
}

class Frames {
  constructor(about, positions, values, own, serials) {
    this.serials = serials;  // one more than the number, 0: nothing there
    this.lastSerial = about.last_serial;
    this.drawn = about.drawn ?? 1;  // times as large as they are
    this.times = about.times;
    this.particles = about.particles;
    this.share = about.share;
    this.positions = positions;
    this.values = values;
    this.own = own;
    this.shown = Int32Array.from({length: this.particles}, (_, i) => i);  // where in the arrays what is shown stands; -1: nothing
  }

  // Radii of all particles (m); `radius` is that of each where they are equal.
  radii(radius, into = new Float32Array(this.particles)) {
    const {low, step, numbers} = this.own.diameter ?? {};
    for (let i = 0; i < this.particles; ++i) {
      const k = this.serials ? this.shown[i] : i;
      into[i] = k < 0 ? 0 : this.drawn * (numbers ? (low + step * numbers[k]) / 2 : radius);
    }
    return into;
  }

  // Of a value: its lowest and highest, and the names of species.
  rangeOf(name) {
    return this.own[name] ?? this.values[name];
  }

  position(frame, particle) {
    const k = frame * this.particles + particle;
    return this.positions.map(({low, step, numbers}) => low + step * numbers[k]);
  }

  // The frame at or before a time, and how far the time is on the way to the next one, 0 to 1.
  place(time) {
    const {times} = this;
    let low = 0, high = times.length - 1;
    if (time >= times[high]) return {frame: high, part: 0};
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle] <= time) low = middle;
      else high = middle;
    }
    return {frame: low, part: Math.max(0, (time - times[low]) / (times[high] - times[low]))};
  }

  // Of a line: a particle that is in one of two frames only is there until it is beyond the end when it leaves, and from the middle
  // of the time on when it comes.
  placesInLine(time, into, end) {
    const {frame, part} = this.place(time);
    const {serials, shown} = this, {low: slowest, step: faster, numbers: axial} = this.values.axial;
    const here = frame * this.particles, next = part > 0 ? here + this.particles : here;
    const elapsed = part > 0 ? part * (this.times[frame + 1] - this.times[frame]) : 0;
    for (let i = 0; i < this.particles; ++i) {
      const stays = serials[here + i] === serials[next + i], comes = !serials[here + i];
      const from = comes ? next + i : here + i, to = stays ? next + i : from;
      for (let axis = 0; axis < 3; ++axis) {
        const {low, step, numbers} = this.positions[axis];
        into[3 * i + axis] = low + step * (numbers[from] + part * (numbers[to] - numbers[from]));
      }
      if (!stays && !comes) into[3 * i + 2] += elapsed * (slowest + faster * axial[from]);
      shown[i] = !serials[from] || (comes && part < 0.5) || into[3 * i + 2] >= end ? -1 : from;
    }
  }

  // Centres at a time, on a straight line from frame to frame; across the joined ends the short way round.
  placesAt(time, into, period) {
    const {frame, part} = this.place(time);
    const here = frame * this.particles, next = part > 0 ? here + this.particles : here;
    for (let axis = 0; axis < 3; ++axis) {
      const {low, step, numbers} = this.positions[axis];
      const ring = axis === 2 && period ? period : 0;
      for (let i = 0; i < this.particles; ++i) {
        const from = low + step * numbers[here + i];
        let way = step * (numbers[next + i] - numbers[here + i]);
        if (ring && Math.abs(way) > ring / 2) way -= Math.sign(way) * ring;
        let place = from + part * way;
        if (ring) place -= ring * Math.floor(place / ring);
        into[3 * i + axis] = place;
      }
    }
    for (let i = 0; i < this.particles; ++i) this.shown[i] = here + i;
  }

  // A value of each particle that is shown as a share of its range, 0 to 1.
  shares(name, into) {
    const {low, step, high, numbers} = this.rangeOf(name);
    const range = high - low || 1, isKept = name in this.own && !this.serials;
    for (let i = 0; i < this.particles; ++i) into[i] = (step * numbers[isKept ? i : this.shown[i]]) / range;
  }

  // The same of their numbers, in input order or order of entry.
  numberShares(into) {
    const {serials, shown} = this, last = Math.max(1, serials ? this.lastSerial : this.particles - 1);
    for (let i = 0; i < this.particles; ++i) into[i] = (serials ? serials[shown[i]] - 1 : i) / last;
  }
}
