// SPDX-License-Identifier: GPL-2.0-or-later
// Plays what player.py has packed, on a canvas. Places are in m with y upward; `at` is a frame, or between two of them.
'use strict';

{
const SECONDS = 12; // from the first frame to the last
const DENSE = 2; // pixels for one of CSS: edges are smooth without blending
const place = document.getElementById('player');
const film = JSON.parse(document.getElementById('film').textContent);
const part = name => place.querySelector(`[data-part=${name}]`);
const specimen = part('specimen'), curves = part('curves'), slider = part('slider'), button = part('play');
let test, paint, at = 0, chosen = -1, playing = 0; // chosen: number of a grain; playing: time of the last picture, or 0

async function unpack({low, step, data}, frames) {
  const stream = new Blob([Uint8Array.from(atob(data), c => c.charCodeAt(0))]).stream();
  const bytes = new Uint8Array(await new Response(stream.pipeThrough(new DecompressionStream('deflate'))).arrayBuffer());
  const count = bytes.length / 2, each = count / frames, whole = new Uint16Array(count);
  for (let i = 0; i < count; i++) whole[i] = (bytes[i] | bytes[count + i] << 8) + (i < each ? 0 : whole[i - each]);
  return Float64Array.from(whole, value => low + step * value);
}

async function unpackTest(packed) {
  const frames = packed.displacement.length, open = (columns, n) => Promise.all(
    Object.entries(columns).map(async ([name, column]) => [name, await unpack(column, n)])).then(Object.fromEntries);
  const discs = await open(packed.discs, 1), ids = (await unpack(packed.ids, 1)).map(Math.round);
  const body = Int32Array.from(discs.body, Math.round), count = new Int32Array(packed.bodies);
  for (const b of body) count[b]++;
  return {...packed, frames, ids, grains: ids.length, values: await open(packed.values, frames),
    ...await open({x: packed.x, y: packed.y}, frames), discs: {...discs, body}, count,
    seen: {x: new Float64Array(body.length), y: new Float64Array(body.length)}};
}

function between(values, i) { // of body or grain i
  const each = values.length / test.frames, k = Math.min(Math.floor(at), test.frames - 2), f = at - k;
  return test.frames < 2 ? values[i] : (1 - f) * values[k * each + i] + f * values[(k + 1) * each + i];
}

function along(values) { // of a list with a number a frame
  const k = Math.min(Math.floor(at), test.frames - 1);
  return values[k] + (at - k) * ((values[k + 1] ?? values[k]) - values[k]);
}

function interpolate(x, xs, ys) {
  const k = xs.findIndex(other => other >= x);
  return k < 0 ? ys.at(-1) : k === 0 ? ys[0] : ys[k - 1] + (ys[k] - ys[k - 1]) * (x - xs[k - 1]) / (xs[k] - xs[k - 1]);
}

function prepared(canvas, ratio) { // height over width; its context, in CSS px
  const width = canvas.clientWidth, height = Math.round(width * ratio);
  canvas.style.height = `${height}px`;
  [canvas.width, canvas.height] = [DENSE * width, DENSE * height];
  const context = canvas.getContext('2d');
  context.scale(DENSE, DENSE);
  return [context, width, height];
}

function draw() {
  if (!test) return;
  placeDiscs();
  drawSpecimen();
  drawCurves();
  tell();
}

function placeDiscs() {
  const {discs, grains, seen, values, x, y} = test;
  let last = -1, bx, by, cos, sin;
  discs.body.forEach((b, i) => { // those of a body are in a row
    if (b !== last) {
      const angle = b < grains ? between(values.rotation, b) * Math.PI / 180 : 0;
      [last, bx, by, cos, sin] = [b, between(x, b), between(y, b), Math.cos(angle), Math.sin(angle)];
    }
    seen.x[i] = bx + cos * discs.dx[i] - sin * discs.dy[i];
    seen.y[i] = by + sin * discs.dx[i] + cos * discs.dy[i];
  });
}

function shadeOf(grain) {
  const share = (between(test.values[paint.name], grain) - paint.low) / (paint.high - paint.low);
  return Math.round(Math.max(0, Math.min(1, share)) * (paint.shades.length - 1));
}

function drawSpecimen() {
  const [context, width, height] = prepared(specimen, (test.high[1] - test.low[1]) / (test.high[0] - test.low[0]));
  const scale = width / (test.high[0] - test.low[0]);
  context.putImageData(imageOfDiscs(context, specimen.width, specimen.height, DENSE * scale), 0, 0);
  drawStraightWalls(context, scale, height);
  if (chosen >= 0) drawRing(context, scale, height);
  drawStrip(context, width, height, scale);
}

function imageOfDiscs(context, columns, rows, scale) { // by rows of pixels: paths take twenty times as long
  const image = context.createImageData(columns, rows), pixels = new Uint32Array(image.data.buffer).fill(abgr('#ffffff'));
  const shades = paint.shades.map(abgr), wall = abgr(film.wall), outline = abgr(film.outline), {discs, seen, grains} = test;
  const fill = (i, share, colour) => {
    const x = (seen.x[i] - test.low[0]) * scale, y = rows - (seen.y[i] - test.low[1]) * scale, r = share * scale * discs.r[i];
    for (let j = Math.max(0, Math.ceil(y - r - 0.5)); j < Math.min(rows, y + r - 0.5); j++) {
      const half = Math.sqrt(r * r - (j + 0.5 - y) ** 2);
      const end = j * columns + Math.min(columns, Math.round(x + half));
      for (let k = j * columns + Math.max(0, Math.round(x - half)); k < end; k++) pixels[k] = colour;
    }
  };
  discs.body.forEach((b, i) => fill(i, 1, outline));
  discs.body.forEach((b, i) => fill(i, film.inner, b < grains ? shades[shadeOf(b)] : wall));
  return image;
}

function abgr(colour) { // as it stands in the memory of an image
  const [red, green, blue] = [1, 3, 5].map(k => parseInt(colour.slice(k, k + 2), 16));
  return (0xff << 24 | blue << 16 | green << 8 | red) >>> 0;
}

function inPicture(i, scale, height) { // px of a disc's centre
  return [(test.seen.x[i] - test.low[0]) * scale, height - (test.seen.y[i] - test.low[1]) * scale];
}

function drawRing(context, scale, height) {
  const {discs} = test;
  context.strokeStyle = film.chosen;
  context.lineWidth = 3;
  discs.body.forEach((b, i) => {
    if (b !== chosen) return;
    context.beginPath();
    context.arc(...inPicture(i, scale, height), scale * discs.r[i], 0, 2 * Math.PI);
    context.stroke();
  });
}

function drawStraightWalls(context, scale, height) { // pieces of two discs: what lies between is of the wall as well
  const {discs, count, grains} = test;
  for (const [colour, share] of [[film.outline, 1], [film.wall, film.inner]])
    discs.body.forEach((b, i) => {
      if (b < grains || count[b] !== 2 || discs.body[i + 1] !== b) return;
      context.strokeStyle = colour;
      context.lineWidth = 2 * share * discs.r[i] * scale;
      context.beginPath();
      for (const k of [i, i + 1]) context.lineTo(...inPicture(k, scale, height));
      context.stroke();
    });
}

function drawStrip(context, width, height, scale) {
  const y = height - 14, bar = test.bar_mm / 1000 * scale;
  context.fillStyle = context.strokeStyle = '#1d2329';
  context.font = '13px system-ui, sans-serif';
  context.textBaseline = 'middle';
  context.fillRect(8, y - 1, bar, 2.5);
  context.fillText(`${test.bar_mm} mm`, bar + 14, y);
  context.fillText('shear →', width / 2, y);
}

function drawCurves() {
  const [context, width, height] = prepared(curves, Math.min(0.25, 90 / curves.clientWidth));
  const {displacement_mm: s, tau_kPa, lid_mm} = test.curves, end = Math.max(s.at(-1), test.displacement.at(-1));
  const x = value => 8 + (width - 16) * Math.max(0, value) / end; // as the middle of the slider's knob
  for (const [values, colour, dashes] of [[lid_mm, '#56616b', [5, 3]], [tau_kPa, test.colour, []]]) {
    const low = Math.min(0, ...values), high = Math.max(...values), y = v => height - 4 - (height - 8) * (v - low) / (high - low || 1);
    context.strokeStyle = colour;
    context.setLineDash(dashes);
    context.beginPath();
    s.forEach((value, i) => context.lineTo(x(value), y(values[i])));
    context.stroke();
  }
  context.setLineDash([]);
  context.strokeStyle = '#1d2329';
  context.strokeRect(x(along(test.displacement)), 0, 0, height);
}

function tell() {
  const moved = along(test.displacement), {displacement_mm: s, tau_kPa, lid_mm} = test.curves;
  const number = (value, digits) => value.toFixed(digits).replace(/^-(?=[0.]*$)/, '').replace('-', '−'); // no minus before a zero
  const now = `${number(moved, 2)} mm`;
  part('now').textContent = `${now}, τ ${number(interpolate(moved, s, tau_kPa), 1)} kPa (line), lid ${number(interpolate(moved, s, lid_mm), 3)} mm (dashes)`;
  slider.value = at;
  slider.setAttribute('aria-valuetext', now);
  if (chosen < 0) {
    part('grain').textContent = 'Point at a grain, or touch it.';
    return;
  }
  const {rotation, stress, contacts} = test.values, nearest = Math.round(at);
  const k = Math.min(Math.floor(at), test.frames - 2), n = test.grains;
  const spin = k < 0 ? 0 : (rotation[(k + 1) * n + chosen] - rotation[k * n + chosen]) / (test.displacement[k + 1] - test.displacement[k]);
  part('grain').textContent = `Grain ${test.ids[chosen]}: turned ${number(between(rotation, chosen), 1)}°, spin ${number(spin, 1)} °/mm, ` +
    `${Math.round(contacts[nearest * n + chosen])} contacts, mean stress ${number(test.sigma * between(stress, chosen), 0)} kPa`;
}

function choose(event) {
  if (!test) return;
  const box = specimen.getBoundingClientRect(), scale = (test.high[0] - test.low[0]) / box.width;
  const x = test.low[0] + (event.clientX - box.left) * scale, y = test.high[1] - (event.clientY - box.top) * scale;
  const {discs, seen, grains} = test;
  const found = discs.body.findIndex((b, i) => b < grains && Math.hypot(seen.x[i] - x, seen.y[i] - y) < discs.r[i]);
  const before = chosen;
  chosen = found < 0 ? -1 : discs.body[found];
  if (chosen !== before && !playing) draw();
}

function play(now) {
  if (!playing) return;
  at = Math.min(test.frames - 1, at + (now - playing) / 1000 * (test.frames - 1) / SECONDS);
  playing = now;
  draw();
  if (at < test.frames - 1) requestAnimationFrame(play);
  else stop();
}

function stop() {
  playing = 0;
  button.textContent = 'Play';
}

function paintBy(index) {
  paint = film.paints[index];
  const digits = paint.high < 10 ? 1 : 0, text = value => value.toFixed(digits).replace('-', '−');
  part('low').textContent = text(paint.low);
  part('high').textContent = text(paint.high);
  part('shades').style.background = `linear-gradient(to right, ${paint.shades.join()})`;
  draw();
}

async function show() {
  stop();
  test = null; // nothing is drawn while it is unpacked
  const packed = film.tests[part('test').value];
  packed.unpacked ??= await unpackTest(packed);
  if (packed !== film.tests[part('test').value]) return; // another was chosen in the meantime
  test = packed.unpacked;
  [at, chosen, slider.max] = [Math.min(at, test.frames - 1), -1, test.frames - 1];
  draw();
}

button.onclick = () => {
  if (playing) return stop();
  if (!test) return;
  if (at >= test.frames - 1) at = 0;
  button.textContent = 'Pause';
  playing = performance.now();
  requestAnimationFrame(play);
};
slider.oninput = () => { stop(); at = Number(slider.value); draw(); };
specimen.onpointermove = specimen.onpointerdown = choose;
part('test').onchange = show;
part('paint').onchange = event => paintBy(event.target.value);
addEventListener('resize', draw);
paintBy(0);
show().then(() => { place.dataset.ready = 'yes'; }, error => { part('now').textContent = `This browser cannot play it: ${error.message}`; });
}
