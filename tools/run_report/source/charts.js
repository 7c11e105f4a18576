// Time series, by uPlot: one chart for each entry of run.charts, with the moment of the clock as a line across all of them.
// Lines differ in dashes as well as in colour; a chart says its figures in words, too, for those who cannot see it.
import uPlot from 'uplot';

import {pageColour, short} from './colours.js';

// Those of the legend are in page.css.
const dashes = [[], [8, 4], [2, 3], [10, 3, 2, 3], [16, 4], [4, 8]];

function inWords(chart, times, columns) {
  const sentences = chart.lines.map(({column, label}) => {
    const values = columns[column].filter((value) => value !== null);
    if (!values.length) return `${label}: never defined`;
    return `${label}: from ${short(values[0])} to ${short(values.at(-1))}, least ${short(Math.min(...values))}, ` +
        `maximum ${short(Math.max(...values))}`;
  });
  return `${chart.title}, ${chart.unit || 'no unit'}, over ${short(times.at(-1))} s. ${sentences.join('. ')}.`;
}

function axis(label, size) {
  return {label, size, labelSize: 18, stroke: () => pageColour('ink'), grid: {stroke: () => pageColour('grid'), width: 1},
          ticks: {stroke: () => pageColour('grid')}, values: (_, ticks) => ticks.map((tick) => tick === null ? '' : short(tick))};
}

export function drawCharts(run, clock) {
  return run.charts.map((chart) => {
    const {columns, time: timeName} = run[chart.source ?? 'log'], times = columns[timeName];
    const box = document.getElementById(chart.id);
    if (chart.points) box.classList.add('points');
    box.setAttribute('aria-label', inWords(chart, times, columns));
    const positive = (values) => chart.log ? values.map((value) => value > 0 ? value : null) : values;
    const plot = new uPlot({
      width: box.clientWidth,
      height: 230,
      scales: {x: {time: false, range: [0, clock.end]}, y: chart.log ? {distr: 3} : {}},
      axes: [axis('time, s', 46), axis(chart.unit, 62)],
      cursor: {sync: {key: 'run'}, points: {size: 7}},
      series: [{label: 'time, s', value: (_, time) => short(time)}, ...chart.lines.map(({label}, k) => ({
        label,
        stroke: () => pageColour(`line-${k + 1}`),
        width: chart.points ? 0 : 1.8,
        dash: dashes[k],
        points: {show: Boolean(chart.points), size: 5, fill: () => pageColour(k ? 'paper' : 'line-1')},
        spanGaps: Boolean(chart.source),  // stations have times of their own
        value: (_, value) => short(value),
      }))],
    }, [times, ...chart.lines.map(({column}) => positive(columns[column]))], box);

    const line = document.createElement('div');
    line.className = 'moment';
    plot.over.append(line);
    clock.follow((time) => {
      line.style.transform = `translateX(${plot.valToPos(time, 'x')}px)`;
      plot.setLegend({idx: plot.valToIdx(time)}, false);
    });
    plot.over.addEventListener('click', (event) => clock.set(plot.posToVal(event.offsetX, 'x')));
    new ResizeObserver(() => {
      plot.setSize({width: box.clientWidth, height: 230});
      clock.set(clock.time);
    }).observe(box);
    return plot;
  });
}
