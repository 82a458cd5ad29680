// SPDX-License-Identifier: Apache-2.0
// The browser's part of go_usable.py. "first": nothing in the cache. "again": as somebody opens it who was there before.
// Usable is when a destination can be pressed: it is there, and neither disabled nor behind anything.
import { parseArgs } from 'node:util';
import { launch, openPage, kPhone, signIn } from '../../browser/browser.mjs';

const { values } = parseArgs({
  options: {
    base: { type: 'string' },
    name: { type: 'string' },
    password: { type: 'string' },
    'slow-down': { type: 'string', default: '4' },
    mbit: { type: 'string', default: '1.6' },
    'round-trip-ms': { type: 'string', default: '150' },
  },
});
const kRuns = 9;

const browser = await launch();
const page = await openPage(browser, { base: values.base, size: kPhone });
await signIn(page, values.name, values.password);
const session = await page.context().newCDPSession(page);
await session.send('Network.enable');
await session.send('Emulation.setCPUThrottlingRate', { rate: Number(values['slow-down']) });
const bytes_per_s = (Number(values.mbit) * 1e6) / 8;
await session.send('Network.emulateNetworkConditions', {
  offline: false,
  latency: Number(values['round-trip-ms']),
  downloadThroughput: bytes_per_s,
  uploadThroughput: bytes_per_s,
});

async function usable_ms() {
  await page.goto('/go', { waitUntil: 'commit' });
  return page.evaluate(
    () =>
      new Promise((done) => {
        const look = () => {
          const card = document.querySelector('.destination');
          if (card && card.getAttribute('aria-disabled') !== 'true' && !card.disabled)
            return requestAnimationFrame(() => setTimeout(() => done(performance.now())));
          return requestAnimationFrame(look);
        };
        look();
      }),
  );
}

const summary = (times) => {
  const sorted = [...times].sort((a, b) => a - b);
  return { median: Math.round(sorted[Math.floor(sorted.length / 2)]), largest: Math.round(sorted.at(-1)) };
};
const figures = {};
for (const kind of ['first', 'again']) {
  const times = [];
  for (let i = 0; i < kRuns; i += 1) {
    if (kind === 'first') await session.send('Network.clearBrowserCache');
    times.push(await usable_ms());
    await page.goto('about:blank');
  }
  figures[kind] = summary(times);
}
process.stdout.write(`${JSON.stringify({ usable_ms: figures })}\n`);
await browser.close();
