// Brings the page of a run to life: reads what run_report.py has put into it and starts player, charts and maps.

import 'uplot/dist/uPlot.min.css';
import './page.css';

import {drawCharts} from './charts.js';
import {Clock} from './clock.js';
import {decodeFrames} from './frames.js';
import {Player} from './player.js';
import {drawMap} from './slice_map.js';

const byId = (id) => document.getElementById(id);
const run = JSON.parse(byId('run').textContent);
const clock = new Clock(run.end);
const page = {run, clock};
window.fixdem = page;

const charts = drawCharts(run, clock);
for (const map of run.maps) drawMap(map, clock);

const repaint = () => {
  charts.forEach((chart) => chart.redraw());
  page.player?.scene.request();
};
byId('theme').addEventListener('change', () => {
  const theme = byId('theme').value;
  if (theme === 'system') delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = theme;
  repaint();
});
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', repaint);

if (run.frames) {
  try {
    page.frames = await decodeFrames(run.frames, byId('frames').textContent);
    page.player = new Player(page.frames, run, clock);
  } catch (error) {
    byId('stage').hidden = true;
    byId('trouble').textContent = `The player needs a browser with WebGL and DecompressionStream: ${error.message}`;
  }
}
document.documentElement.dataset.ready = 'yes';
