// The page of a run in a real browser: it loads from disk without a word on the console and without asking the network,
// says what the run's files say, draws, plays, and can be used with the keyboard alone, in light and dark, wide and narrow.
//
// Usage: node page_test.mjs NODE_FOLDER PAGE CHROMIUM [PICTURES_FOLDER]
// NODE_FOLDER has the npm packages; on standard input, JSON: what run_report_test.py has read from the files of the run.
// Prints one line per check and at the end "N passed, M failed".
import fs from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';

const [nodeFolder, file, executablePath, pictures] = process.argv.slice(2);
const require = createRequire(path.resolve(nodeFolder) + '/');
const {chromium} = require('playwright-core');
const axe = fs.readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');
const expected = JSON.parse(fs.readFileSync(0, 'utf8'));

let passed = 0, failed = 0;
function check(what, right, found = '') {
  right ? ++passed : ++failed;
  console.log(`${right ? 'passed' : 'FAILED'}  ${what}${found === '' ? '' : `: ${found}`}`);
}

// A processor that does the work of a graphics card is what every machine has.
const browser = await chromium.launch({executablePath, args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader']});
const context = await browser.newContext({viewport: {width: 1280, height: 900}, bypassCSP: false});
const page = await context.newPage();
const said = [], asked = [];
page.on('console', (message) => /GPU stall due to ReadPixels/.test(message.text()) || said.push(message.text()));
page.on('pageerror', (error) => said.push(error.message));
page.on('request', (request) => /^(data|blob):/.test(request.url()) || asked.push(request.url()));
await page.goto('file://' + path.resolve(file));
await page.waitForSelector('html[data-ready]', {timeout: 60000});

const shot = (selector) => page.locator(selector).first().screenshot();
const differs = (one, other) => Buffer.compare(one, other) !== 0;
// How many of the stage's pixels differ by more than noise, and how many are not its background.
const pixels = () => page.evaluate(() => {
  const {renderer} = fixdem.player.scene;
  fixdem.player.scene.draw();
  const gl = renderer.getContext(), {drawingBufferWidth: w, drawingBufferHeight: h} = gl;
  const data = new Uint8Array(4 * w * h);
  gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, data);
  const before = window.lastPixels;
  window.lastPixels = data;
  let drawn = 0, changed = 0;
  const colours = new Set();
  for (let k = 0; k < data.length; k += 4) {
    if (Math.abs(data[k] - data[0]) + Math.abs(data[k + 1] - data[1]) + Math.abs(data[k + 2] - data[2]) > 24) ++drawn;
    if (before && Math.abs(data[k] - before[k]) + Math.abs(data[k + 1] - before[k + 1]) + Math.abs(data[k + 2] - before[k + 2]) > 24) ++changed;
    colours.add((data[k] << 16) | (data[k + 1] << 8) | data[k + 2]);
  }
  return {drawn: drawn / (w * h), changed: changed / (w * h), colours: colours.size};
});

// What is shown is what the files hold.
check('heading is the title of the case', (await page.textContent('h1')) === expected.title);
check('the status is among the verdicts', (await page.textContent('table')).includes(expected.status));
check('number of frames', (await page.evaluate(() => fixdem.frames.times.length)) === expected.frames);
for (const {frame, particle: number, serial, position, contacts, radius} of expected.samples) {
  // In a line a particle has a row for its life, to be found by its serial number.
  const particle = serial === null ? number : await page.evaluate(([f, s]) => {
    const {serials, particles} = fixdem.frames;
    return serials.subarray(f * particles, (f + 1) * particles).indexOf(s + 1);
  }, [frame, serial]);
  const found = await page.evaluate(([f, p]) => fixdem.frames.position(f, p), [frame, particle]);
  const off = Math.max(...found.map((value, k) => Math.abs(value - position[k]) / expected.step[k]));
  check(`particle ${particle} in frame ${frame} is where the frame's file says, to half a step`, off <= 0.5001, off.toFixed(3));
  const touching = await page.evaluate(([f, p]) => fixdem.frames.values.contacts.numbers[f * fixdem.frames.particles + p], [frame, particle]);
  check('... with as many contacts', touching === contacts, touching);
  if (serial !== null) await page.evaluate((f) => fixdem.clock.set(fixdem.frames.times[f]), frame);
  const size = await page.evaluate((p) => fixdem.player.scene.radii[p], particle);
  check('... as large as it is', Math.abs(size - radius) <= expected.radius_step / 131070 + 1e-7 * radius, size);
}
const map = await page.evaluate(() => fixdem.run.maps.map(({name, values}) => ({name, rows: values.length, last: values.at(-1)})));
check('solids fraction of the last frame adds up to the volume of the particles',
  Math.abs(map[0].last.reduce((a, b) => a + b) / map[0].last.length / expected.mean_fraction - 1) < 0.01);
if (expected.is_line) {
  const first = await page.evaluate(() => fixdem.run.maps[1].values.at(-1)[0]);
  check('pressure in the first slice of the last frame is nearly that of the log', Math.abs(first / expected.pressure_drop - 1) < 0.1, first);
} else if (expected.pressure_drop !== null)
  check('pressure gradient of the last frame adds up to the pressure drop of the log',
    Math.abs(map[1].last.reduce((a, b) => a + b) / map[1].last.length * expected.pipe_length / expected.pressure_drop - 1) < 0.01);

// It draws, and time moves it.
if (expected.is_line) await page.evaluate(() => fixdem.clock.set(0));
await page.waitForTimeout(500);
const renderings = await page.evaluate(() => fixdem.player.scene.renderer.info.render.frame);
check('no more pictures are rendered than are shown', renderings <= (expected.is_line ? 9 : 5), renderings);
const first = await pixels();
check('the player draws', first.drawn > 0.01 && first.colours > 50, `${(100 * first.drawn).toFixed(1)} % of the pixels, ${first.colours} colours`);
check('... the same when nothing changes', (await pixels()).changed === 0);
const mapBefore = await shot('.map');
await page.locator('#time').fill(String(expected.end / 2));
const middle = await pixels();
check('the scrubber moves the particles', middle.changed > 0.01, `${(100 * middle.changed).toFixed(1)} % of the pixels`);
check('... and says the time', (await page.textContent('#now')) === `${(expected.end / 2).toFixed(3)} s`);
check('... and the line on the map', differs(mapBefore, await shot('.map')));
for (const [name, words] of [['contacts', 'contacts'], ['id', 'number'], ['speed', 'speed'], ['axial', 'axial velocity']]) {
  await page.locator('#colour').selectOption(name);
  const {changed} = await pixels();
  check(`colour by ${name} changes pixels`, changed > 0.002, `${(100 * changed).toFixed(1)} %`);
  check('... and the legend', (await page.textContent('#scale-name')).includes(words));
}
await page.locator('#cut').check();
check('half of the pipe takes particles away', (await pixels()).changed > 0.001);
await page.locator('#cut').uncheck();
for (const view of ['oblique', 'end', 'side']) {
  await page.locator(`[data-view=${view}]`).click();
  await pixels();
  const {drawn, changed} = await pixels();
  check(`view ${view} shows particles`, drawn > 0.003 && changed === 0);
  if (pictures) fs.writeFileSync(`${pictures}/${view}.png`, await shot('figure:has(#stage)'));
}

// A line: what the window shows, by strip, keys and plug.
if (expected.is_line) {
  const begin = () => page.evaluate(() => fixdem.player.along.begin);
  const box = await page.locator('#strip').boundingBox();
  const half = await page.evaluate(() => fixdem.player.along.reach / 2);
  await pixels();
  await page.mouse.move(box.x + 0.3 * box.width, box.y + 10);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.6 * box.width, box.y + 10);
  await page.mouse.up();
  check('the strip drags the window', Math.abs((await begin()) + half - 0.6 * expected.pipe_length) < 0.01 * expected.pipe_length, await begin());
  check('... which then stays', (await page.inputValue('#with')) === '' && (await pixels()).changed > 0.003);
  await page.locator('#strip').focus();
  await page.keyboard.press('Home');
  check('... and has keys', (await begin()) === 0 && (await page.textContent('#where')).startsWith('0.00 to'), await page.textContent('#where'));
  const plugs = await page.evaluate(() => fixdem.run.line.tracks.map(({plug, points}) => [plug, points]));
  if (plugs.length) {
    const [number, points] = plugs.at(-1), [time, front] = points[points.length >> 1];
    await page.locator('#with').selectOption(String(number));
    await page.evaluate((t) => fixdem.clock.set(t), time);
    const from = await begin();
    check('it moves with a plug', from <= front && front <= from + 2 * half, `${from} m, front at ${front} m`);
    await page.locator('#with').selectOption('each');
  }
  await page.locator('#reach').selectOption(String(expected.pipe_length));
  check('it shows the whole pipe', (await begin()) === 0 && (await pixels()).drawn > 0.001);
  await page.locator('#reach').selectOption(String(2 * half));
  await page.evaluate(() => fixdem.clock.set(fixdem.clock.end / 2));
  const shown = await page.evaluate(() => fixdem.frames.shown.filter((k) => k >= 0).length);
  const there = await page.evaluate(() => {
    const {frame} = fixdem.frames.place(fixdem.clock.time), {serials, particles} = fixdem.frames;
    return serials.subarray(frame * particles, (frame + 1) * particles).filter((s) => s > 0).length;
  });
  check('as many particles as are there', Math.abs(shown - there) <= 0.05 * there + 20, `${shown} of ${there}`);
}

// With the keyboard alone.
await page.locator('#stage').focus();
await pixels();
await page.keyboard.press('ArrowLeft');
check('an arrow turns the view', (await pixels()).changed > 0.003);
await page.keyboard.press('+');
check('plus goes nearer', (await pixels()).changed > 0.003);
await page.evaluate(() => fixdem.clock.set(0));
await page.keyboard.press('.');
check('full stop steps to the next frame', (await page.evaluate(() => fixdem.clock.time)) === expected.second_time);
await page.keyboard.press(',');
check('comma steps back', (await page.evaluate(() => fixdem.clock.time)) === 0);
await page.locator('#time').focus();
await page.keyboard.press('End');
check('the scrubber has keys', Math.abs((await page.evaluate(() => fixdem.clock.time)) - expected.end) < 1e-6);
await page.locator('.map canvas').first().focus();
const saidBefore = await page.textContent('figure:has(.map) output');
await page.keyboard.press('ArrowRight');
check('arrows move on a map, which says its value', saidBefore !== (await page.textContent('figure:has(.map) output')));
await page.evaluate(() => document.activeElement.blur());
const reached = new Set();
for (let k = 0; k < 60; ++k) {
  await page.keyboard.press('Tab');
  reached.add(await page.evaluate(() => document.activeElement.id || document.activeElement.dataset.view || document.activeElement.tagName));
}
const wanted = [...(expected.is_line ? ['strip', 'reach', 'with'] : []), 'theme', 'stage', 'play', 'time', 'rate', 'colour', 'cut', 'side', 'oblique', 'end', 'CANVAS', 'A'];
check('Tab reaches every control', wanted.every((name) => reached.has(name)), wanted.filter((name) => !reached.has(name)).join(' '));

// It plays.
await page.evaluate(() => fixdem.clock.set(0));
await page.locator('#play').focus();
const drawnBefore = await page.evaluate(() => fixdem.player.drawn);
await page.keyboard.press('Enter');
await page.waitForTimeout(2000);
const after = await page.evaluate(() => ({time: fixdem.clock.time, drawn: fixdem.player.drawn, label: document.getElementById('play').textContent}));
check('Enter plays', after.time > 0 && after.drawn > drawnBefore + 3 && after.label === 'Pause', `${((after.drawn - drawnBefore) / 2).toFixed(0)} pictures per second, drawn by the processor`);
await page.keyboard.press('Enter');
const stopped = await page.evaluate(() => fixdem.clock.time);
await page.waitForTimeout(300);
check('... and stops', (await page.evaluate(() => fixdem.clock.time)) === stopped);

// Charts, themes, widths, accessibility.
await page.evaluate(() => fixdem.clock.set(fixdem.clock.end / 2));
const blank = await page.evaluate(() => [...document.querySelectorAll('.uplot canvas')].filter((canvas) => {
  const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  return !data.some((value, k) => k % 4 === 3 && value > 0);
}).length);
const charts = await page.locator('.uplot').count();
check('every chart is drawn', charts === (expected.charts ?? (await page.evaluate(() => fixdem.run.charts.length))) && blank === 0, charts);
const luminance = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).reduce((a, b) => a + Number(b), 0));
for (const theme of ['light', 'dark']) {
  await page.locator('#theme').selectOption(theme);
  const sum = await luminance();
  check(`theme ${theme}`, theme === 'light' ? sum > 600 : sum < 150, sum);
  await page.evaluate(axe);
  const violations = await page.evaluate(async () => (await axe.run()).violations.map(({id, nodes}) => `${id} (${nodes[0].target} and so on: ${nodes.length})`));
  check(`... has no fault that axe-core finds`, violations.length === 0, violations.join('; '));
  if (pictures) fs.writeFileSync(`${pictures}/${theme}.png`, await page.screenshot({fullPage: true}));
}
await page.locator('#theme').selectOption('system');
await page.emulateMedia({colorScheme: 'dark'});
check('follows the system into the dark', (await luminance()) < 150);
await page.setViewportSize({width: 390, height: 800});
await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth, null, {timeout: 10000}).catch(() => {});
check('no sideways scrolling on a telephone', await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), await page.evaluate(() => document.documentElement.scrollWidth));
if (pictures) fs.writeFileSync(`${pictures}/narrow.png`, await page.screenshot({fullPage: true}));

check('nothing on the console', said.length === 0, said.join(' | '));
check('nothing asked of the network', asked.every((url) => url.startsWith('file:')) && asked.length === 1, asked.length > 1 ? asked.join(' ') : '');
await browser.close();
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
