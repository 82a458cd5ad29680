// SPDX-License-Identifier: Apache-2.0
// How long mending a map of thousands of places takes in the dashboard, in headless Chromium against the pretended house.
// Usage: node tests/bench/browser/large_edit.mjs [--places 5000] [--runs 7]        after web/build.sh
// Prints a JSON object of medians and the largest of several runs each, in milliseconds from a press or from opening the
// address until what is asked for is there:
//   "map_list_ms", "map_drawing_ms" the map page opened at its address; "evidence_ms" from pressing Evidence, and
//   "evidence_opened_ms" from opening its address, until the first question; "key_ms" of the search as large_map.mjs has it;
//   "draft_ms" a draft with 50 edits opened at its address, until all that is other is told;
//   "draft_edit_ms" from saving a name in it until it is told there, "draft_edit_server_ms"
//   what of that the pretended server takes.
// Each with "page_ms": processor time of the page's thread until it rests again (the median), which other programs on the
// machine disturb less. "panning": frames a second while the drawing is dragged, and the longest between two of them.
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { startMock } from '../../../web/dev/mock-server.mjs';
import { largeGraph } from '../../../web/dev/mock-large.mjs';
import { launch, openPage, signIn } from '../../browser/browser.mjs';
import { keyTimes } from './keys.mjs';

const { values } = parseArgs({
  options: { places: { type: 'string', default: '5000' }, runs: { type: 'string', default: '7' } },
});
const places = Number(values.places);
const kRuns = Number(values.runs);
const kEdits = 50;
const kDoubts = 2000;
const kDrag_ms = 4000;
const kWait_ms = 700;
const kRest_ms = 60; // of these it works when it rests: events come in each second
const kMostWaits = 10;

const dist = fileURLToPath(new URL('../../../web/dist', import.meta.url));
const mock = await startMock({ port: 0, dist });
const { house } = mock;
house.graph = largeGraph('m1', places);
house.taught = house.graph;
house.maps[0].places = places;
house.moreDoubts = Array.from({ length: kDoubts }, (_, i) =>
  doubt(1 + ((i * 7) % places), 1 + ((i * 11 + 3) % places), i),
);
house.steer({
  do: 'draft',
  by: 'ben',
  name: 'Large',
  edits: Array.from({ length: kEdits }, (_, i) => edit(i)),
});
let server_ms = 0;
const call = house.call.bind(house);
house.call = async (...request) => {
  const began = performance.now();
  try {
    return await call(...request);
  } finally {
    server_ms += performance.now() - began;
  }
};

/** Every other one a name, every other one a way that is closed. */
function edit(i) {
  const at = 100 * i + 5;
  if (i % 2 === 0) return { kind: 'rename', place: `p${at % places}`, label: `room ${i}` };
  return { kind: 'block_edge', from: `p${at % places}`, to: `p${(at % places) + 1}`, blocked: true };
}

function doubt(a, b, i) {
  const image = (n) => `t1/p${n}.jpg`;
  const decide = (accept) => [{ kind: 'decide', prototype_a: image(a), prototype_b: image(b), accept }];
  const masses = { true: 0.4, false: 0.2, unknown: 0.4 };
  return {
    kind: 'same_place',
    image_a: image(a),
    image_b: image(b),
    place_a: `p${a}`,
    place_b: `p${b}`,
    state: 'undecided',
    by: 'method',
    set_aside_by: null,
    probability: 0.5,
    effect: 0.5,
    weight: 0.25 - i * 1e-5,
    masses_before: masses,
    masses_after: masses,
    support: 0.4,
    plausibility: 0.8,
    neighbours: [],
    reasons: [{ code: 'text', parameters: { text: 'The two pictures have much in common' } }],
    if_yes: decide(true),
    if_no: decide(false),
  };
}

const browser = await launch();
const page = await openPage(browser, { base: mock.url });
await signIn(page, 'anna', 'homeward');
const draft = `/map/m1/draft/${house.drafts[0].id}`;

// Noted in the page itself: what is asked from outside waits for what the page is doing. A selector counts as shown
// once the frame that shows it has been made; "text=" asks for an element that says just that.
await page.addInitScript(() => {
  const there = ([selector, text]) =>
    [...document.querySelectorAll(selector)].some((one) => !text || one.textContent.includes(text));
  globalThis.whenShown = (what, since) =>
    new Promise((done) => {
      const look = () => {
        if (!there(what)) return requestAnimationFrame(look);
        return setTimeout(() => done(performance.now() - since()));
      };
      requestAnimationFrame(look);
    });
  globalThis.press = (what) => {
    const began = performance.now();
    const [selector, text] = what;
    [...document.querySelectorAll(selector)].find((one) => one.textContent.includes(text)).click();
    return () => began;
  };
});

const kList = ['.place-row', ''];
const kDrawing = ['[data-testid=graph] canvas', ''];
const kQuestion = ['.doubt h2', ''];
const kOther = ['[aria-label="What is other"]', `${kEdits} difference`];

const session = await page.context().newCDPSession(page);
await session.send('Performance.enable', { timeDomain: 'threadTicks' });
async function busy_ms() {
  const { metrics } = await session.send('Performance.getMetrics');
  return 1000 * metrics.find((one) => one.name === 'TaskDuration').value;
}

/** What `measure` gives, once the page has nothing to do any more, and how long that kept its thread busy. */
async function untilRest(measure) {
  const before = await busy_ms();
  const times = await measure();
  let [last, now] = [before, await busy_ms()];
  for (let i = 0; i < kMostWaits && now - last > kRest_ms; i += 1) {
    await page.waitForTimeout(kWait_ms);
    [last, now] = [now, await busy_ms()];
  }
  return { times, page_ms: now - before };
}

/** Since the address was opened until each of these is there. */
const opened = (path, ...whats) =>
  untilRest(async () => {
    await page.goto(path, { waitUntil: 'commit' });
    return page.evaluate((all) => Promise.all(all.map((one) => globalThis.whenShown(one, () => 0))), whats);
  });

/** Since this was pressed until that is there. */
const pressed = (button, what) =>
  untilRest(async () => [
    await page.evaluate(
      ([press, shown]) => globalThis.whenShown(shown, globalThis.press(press)),
      [button, what],
    ),
  ]);

async function several(measure) {
  const times = [];
  for (let i = 0; i < kRuns; i += 1) times.push(await measure(i));
  return times;
}

const summary = (times) => {
  const sorted = [...times].sort((a, b) => a - b);
  return { median: +sorted[Math.floor(sorted.length / 2)].toFixed(1), largest: +sorted.at(-1).toFixed(1) };
};

/** Drags the drawing to and fro; frames that the page made meanwhile. */
async function panning() {
  const box = await page.getByTestId('graph').boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.evaluate(() => {
    globalThis.frames = [performance.now()];
    const note = () => {
      globalThis.frames.push(performance.now());
      globalThis.noting = requestAnimationFrame(note);
    };
    globalThis.noting = requestAnimationFrame(note);
    return null;
  });
  const began = performance.now();
  for (let i = 0; performance.now() - began < kDrag_ms; i += 1)
    await page.mouse.move(x + 150 * Math.sin(i / 12), y + 80 * Math.sin(i / 17));
  const frames = await page.evaluate(() => (cancelAnimationFrame(globalThis.noting), globalThis.frames));
  await page.mouse.up();
  await page.waitForTimeout(2000);
  const gaps = frames.slice(1).map((at, i) => at - frames[i]);
  return { per_s: (1000 * gaps.length) / (frames.at(-1) - frames[0]), gap_ms: Math.max(...gaps) };
}

/** Gives a place another name in the draft that is open. */
async function named(i) {
  const name = `Another name ${i}`;
  await page.getByLabel('Name', { exact: true }).fill(name);
  server_ms = 0;
  const done = await pressed(['.rename button', 'Save'], ['[aria-label="What is other"] li', name]);
  return { ...done, server_ms };
}

/** Of the number-th thing that was waited for. */
const figure = (runs, number = 0) => ({
  ...summary(runs.map(({ times }) => times[number])),
  page_ms: summary(runs.map(({ page_ms }) => page_ms)).median,
});

const figures = { places, ways: house.graph.edges.length, edits: kEdits, doubts: kDoubts };
const map = await several(() => opened('/map/m1', kList, kDrawing));
figures.map_list_ms = figure(map, 0);
figures.map_drawing_ms = figure(map, 1);
figures.key_ms = summary(await keyTimes(page));
const drags = await several(panning);
figures.panning = {
  frames_per_s: summary(drags.map((one) => one.per_s)).median,
  longest_gap_ms: summary(drags.map((one) => one.gap_ms)).largest,
};
figures.evidence_opened_ms = figure(await several(() => opened('/map/m1/evidence', kQuestion)));
await opened('/map/m1', kDrawing);
figures.evidence_ms = figure(
  await several(async () => {
    const shown = await pressed(['nav a', 'Evidence'], kQuestion);
    await pressed(['nav a', 'Places'], kDrawing);
    return shown;
  }),
);
figures.draft_ms = figure(await several(() => opened(draft, kOther)));
await opened(`${draft}/place/p5`, kOther, kDrawing);
const edits = await several(named);
figures.draft_edit_ms = figure(edits);
figures.draft_edit_server_ms = summary(edits.map((one) => one.server_ms));
process.stdout.write(`${JSON.stringify(figures)}\n`);
await browser.close();
mock.close();
