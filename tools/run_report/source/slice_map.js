// A map of the pipe against time: each slice at each frame a small rectangle, along the pipe from left to right, time
// downwards, so that a plug is a slanted band. Below the pointer, or where the arrow keys have gone, its value is said.

import {colour, gradient, short} from './colours.js';

export function drawMap(map, clock) {
  const box = document.getElementById(map.id);
  const canvas = box.querySelector('canvas'), said = box.querySelector('output'), line = box.querySelector('.moment-row');
  const slices = map.values[0].length, rows = map.values.length, end = clock.end;
  canvas.width = slices;
  canvas.height = rows;
  const context = canvas.getContext('2d');
  const image = context.createImageData(slices, rows);
  const range = map.high - map.low || 1;
  map.values.forEach((row, r) => row.forEach((value, s) => {
    image.data.set([...colour((value - map.low) / range), 255], 4 * (r * slices + s));
  }));
  context.putImageData(image, 0, 0);
  box.querySelector('.bar').style.background = gradient();
  box.querySelector('.low').textContent = short(map.low);
  box.querySelector('.high').textContent = `${short(map.high)} ${map.unit}${map.above}`;

  let slice = slices >> 1;
  const rowAt = (time) => {
    let best = 0;
    map.times.forEach((value, r) => {
      if (Math.abs(value - time) < Math.abs(map.times[best] - time)) best = r;
    });
    return best;
  };
  const say = (row) => {
    const place = ((slice + 0.5) / slices) * map.length;
    said.textContent = `${map.name} ${short(map.values[row][slice])} ${map.unit} at ${short(place)} m, ${short(map.times[row])} s`;
  };
  const pointed = (event) => {
    slice = Math.min(slices - 1, Math.max(0, Math.floor((event.offsetX / canvas.clientWidth) * slices)));
    return (event.offsetY / canvas.clientHeight) * end;
  };
  canvas.addEventListener('pointermove', (event) => say(rowAt(pointed(event))));
  canvas.addEventListener('click', (event) => clock.set(pointed(event)));
  canvas.addEventListener('keydown', (event) => {
    const step = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
    if (!step) return;
    event.preventDefault();
    slice = Math.min(slices - 1, Math.max(0, slice + step[0]));
    clock.set(map.times[Math.min(rows - 1, Math.max(0, rowAt(clock.time) + step[1]))]);
  });
  clock.follow((time) => {
    line.style.top = `${(time / end) * 100}%`;
    say(rowAt(time));
  });
}
