// SPDX-License-Identifier: Apache-2.0
// What the tests against the pretended house of web/dev/mock-server.mjs share.
import assert from 'node:assert/strict';
import { existsSync, mkdtempSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { startMock } from '../../web/dev/mock-server.mjs';
import { findings, kPhone, kWide, launch, openPage, shoot, signIn, sticksOut } from './browser.mjs';

const kPatienceMs = 30_000; // beside tests that take the processor from this one

/** Desktop and phone, in light and dark. */
export const kLooks = [
  ['1280x800', kWide],
  ['390x844', kPhone],
].flatMap(([size_name, size]) =>
  ['light', 'dark'].map((scheme) => ({ name: `${size_name}-${scheme}`, look: { size, scheme } })),
);

/** Where screenshots go: the first argument, else a new folder. */
export function screenshotFolder() {
  return process.argv[2] ?? mkdtempSync(join(tmpdir(), 'homeward-screens-'));
}

/** A browser, and what gives each check a house and a page of its own; an exception in it or blocked content fails. A robot
 *  that was sent waits on its way for `house.steer({ do: 'go_on' })`. */
export async function pretendedHouses() {
  const dist = fileURLToPath(new URL('../../web/dist', import.meta.url));
  if (!existsSync(join(dist, 'index.html')))
    throw new Error(`there is no dashboard in ${dist}; build it with web/build.sh`);
  const browser = await launch();
  const withHouse =
    (check, { name = 'anna', fresh = false, ...look } = {}) =>
    async () => {
      const mock = await startMock({ port: 0, dist, step_ms: 150, fresh, waits: true });
      const page = await openPage(browser, { base: mock.url, ...look });
      page.setDefaultTimeout(kPatienceMs);
      try {
        if (name) await signIn(page, name, 'homeward');
        await check(page, mock.house, mock);
        assert.deepEqual(page.complaints, [], 'the page complained');
      } finally {
        await page.context().close();
        mock.close();
      }
    };
  return { browser, withHouse };
}

export const tab = (page, name) =>
  page.getByRole('navigation', { name: 'Pages' }).getByRole('link', { name }).click();

/** A check in every look: `run(page, house, see)`; each `see(name)` takes a picture and looks for faults of access. */
export function inEveryLook(withHouse, out, run) {
  return async () => {
    const all = [];
    for (const { name, look } of kLooks)
      await withHouse(async (page, house) => {
        const see = async (what) => {
          await page.waitForTimeout(300);
          await shoot(page, out, `${what}-${name}`);
          all.push(...(await findings(page)).map((one) => `${what} ${name}: ${one}`));
          if (await sticksOut(page)) all.push(`${what} ${name}: wider than the screen`);
        };
        await run(page, house, see);
      }, look)();
    assert.deepEqual(all, []);
  };
}
