// One scale of colours for particles and maps: dark violet over green to yellow, in even steps of lightness, so that it reads in
// grey, too. The same as that of tools/picture. And the colours of the page, as its style sheet has them at the moment.

const stops = [[86, 50, 140], [59, 92, 150], [33, 145, 140], [94, 201, 98], [253, 231, 37]];

export function colour(share) {
  const place = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const k = Math.min(Math.floor(place), stops.length - 2);
  return stops[k].map((channel, c) => Math.round(channel + (stops[k + 1][c] - channel) * (place - k)));
}

export const colourTable = () => Array.from({length: 256}, (_, k) => colour(k / 255));

export const gradient = () => 'linear-gradient(to right,' + stops.map((stop) => `rgb(${stop})`).join() + ')';

export const pageColour = (name) => getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();

// A number with three digits, short.
export function short(value) {
  if (value === null || !Number.isFinite(value)) return '-';
  if (value === 0) return '0';
  const size = Math.abs(value);
  return size >= 1e-3 && size < 1e5 ? String(+value.toPrecision(3)) : value.toExponential(2);
}
