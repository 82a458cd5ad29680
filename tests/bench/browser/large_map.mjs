// SPDX-License-Identifier: Apache-2.0
// How long the dashboard takes with a map of thousands of places, in headless Chromium against the pretended house.
// Usage: node tests/bench/browser/large_map.mjs [--places 5000]        after web/build.sh
// Prints a JSON object: "first_list_ms" from opening the page's address until the first row of the list is there;
// "key_ms" from a key in the search field to the next frame that shows what it found; "belief_ms" of processor time of
// the page's thread for each belief that the events bring. Medians and the largest.
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { startMock } from '../../../web/dev/mock-server.mjs';
import { largeGraph } from '../../../web/dev/mock-large.mjs';
import { launch, openPage, signIn } from '../../browser/browser.mjs';
import { keyTimes } from './keys.mjs';

const { values } = parseArgs({ options: { places: { type: 'string', default: '5000' } } });
const places = Number(values.places);
const kRuns = 9;
const kBeliefs = 60;

const dist = fileURLToPath(new URL('../../../web/dist', import.meta.url));
const mock = await startMock({ port: 0, dist });
mock.house.graph = largeGraph('m1', places);
mock.house.maps[0].places = places;
const browser = await launch();
const page = await openPage(browser, { base: mock.url });
await signIn(page, 'anna', 'homeward');

// Noted in the page itself: what is asked from outside waits for what the page is doing.
await page.addInitScript(() => {
  const look = () => {
    if (!document.querySelector('.place-row')) return requestAnimationFrame(look);
    return setTimeout(() => (globalThis.firstListAt = performance.now()));
  };
  requestAnimationFrame(look);
});
const first_list_ms = [];
for (let i = 0; i < kRuns; i += 1) {
  await page.goto('/map', { waitUntil: 'commit' });
  await page.getByTestId('graph').locator('canvas').first().waitFor();
  await page.waitForTimeout(2000);
  first_list_ms.push(await page.evaluate(() => globalThis.firstListAt));
}

const key_ms = await keyTimes(page);

const session = await page.context().newCDPSession(page);
await session.send('Performance.enable');
const taskSeconds = async () => {
  const { metrics } = await session.send('Performance.getMetrics');
  return metrics.find((one) => one.name === 'TaskDuration').value;
};
/** Processor time of the page's thread while so many beliefs come in; the mock's own events each second are among it. */
async function spent_s(beliefs) {
  const before = await taskSeconds();
  for (let i = 0; i < beliefs; i += 1) {
    const at = `p${1 + ((i * 7) % places)}`;
    const top = [0, 1, 2, 3].map((n) => ({
      place: `p${1 + ((i * 7 + n) % places)}`,
      probability: 0.6 / 2 ** n,
    }));
    const belief = { updates: i, place: at, probability: 0.9, top, lost: false };
    mock.house.steer({ do: 'robot', set: { belief } });
    await page.waitForTimeout(100);
  }
  return (await taskSeconds()) - before;
}
mock.house.close(); // no events of its own
await page.waitForTimeout(1500);
const belief_ms = [];
for (let i = 0; i < 5; i += 1) belief_ms.push((1000 * (await spent_s(kBeliefs))) / kBeliefs);

const summary = (times) => {
  const sorted = [...times].sort((a, b) => a - b);
  return { median: +sorted[Math.floor(sorted.length / 2)].toFixed(1), largest: +sorted.at(-1).toFixed(1) };
};
const figures = {
  places,
  first_list_ms: summary(first_list_ms),
  key_ms: summary(key_ms),
  belief_ms: summary(belief_ms),
};
process.stdout.write(`${JSON.stringify(figures)}\n`);
await browser.close();
mock.close();
