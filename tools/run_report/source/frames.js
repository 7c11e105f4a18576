// The frames of the run, out of their compressed form (player_data.py describes it): positions and three values of every
// particle at every frame, as typed arrays of frames x particles.

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
  const positions = ['x', 'y', 'z'].map((axis) => {
    const numbers = new Uint16Array(count);
    for (let k = 0; k < count; ++k) numbers[k] = bytes[at + k] | (bytes[at + count + k] << 8);
    at += 2 * count;
    return {...about.scale[axis], numbers: summed(numbers, about.particles)};
  });
  const values = {};
  for (const name of ['axial', 'speed', 'contacts']) {
    values[name] = {...about.scale[name], numbers: summed(bytes.slice(at, at + count), about.particles)};
    at += count;
  }
  return new Frames(about, positions, values);
}

class Frames {
  constructor(about, positions, values) {
    this.times = about.times;
    this.particles = about.particles;
    this.share = about.share;
    this.positions = positions;
    this.values = values;
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
    const {low, step, high, numbers} = this.values[name];
    const range = high - low || 1;
    for (let i = 0; i < this.particles; ++i) into[i] = (step * numbers[frame * this.particles + i]) / range;
  }
}
