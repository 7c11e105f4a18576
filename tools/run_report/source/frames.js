// The frames of the run, out of their compressed form (player_data.py describes it): positions and three values of every
// particle at every frame, as typed arrays of frames x particles; and what each particle keeps, where particles differ.

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
  const from16 = (size) => {  // a plane of low and one of high bytes
    const numbers = new Uint16Array(size);
    for (let k = 0; k < size; ++k) numbers[k] = bytes[at + k] | (bytes[at + size + k] << 8);
    at += 2 * size;
    return numbers;
  };
  const positions = ['x', 'y', 'z'].map((axis) => ({...about.scale[axis], numbers: summed(from16(count), about.particles)}));
  const values = {};
  for (const name of ['axial', 'speed', 'contacts']) {
    values[name] = {...about.scale[name], numbers: summed(bytes.slice(at, at + count), about.particles)};
    at += count;
  }
  const own = {};
  if (about.own?.diameter) own.diameter = {...about.own.diameter, numbers: from16(about.particles)};
  if (about.own?.species) own.species = {...about.own.species, numbers: bytes.slice(at, at + about.particles)};
  return new Frames(about, positions, values, own);
}

class Frames {
  constructor(about, positions, values, own) {
    this.times = about.times;
    this.particles = about.particles;
    this.share = about.share;
    this.positions = positions;
    this.values = values;
    this.own = own;
  }

  // Radii of all particles (m); `radius` is that of each where they are equal.
  radii(radius) {
    const {low, step, numbers} = this.own.diameter ?? {};
    return Float32Array.from({length: this.particles}, (_, i) => (numbers ? (low + step * numbers[i]) / 2 : radius));
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
    return frame;
  }

  // A value of each particle as a share of its range, 0 to 1.
  sharesAt(frame, name, into) {
    const {low, step, high, numbers} = this.rangeOf(name);
    const range = high - low || 1, first = name in this.own ? 0 : frame * this.particles;
    for (let i = 0; i < this.particles; ++i) into[i] = (step * numbers[first + i]) / range;
  }
}
