// SPDX-License-Identifier: Apache-2.0
// A rider's arrival against a running server with a connected robot: signs in, presses a destination, waits until the page
// says that the robot has arrived, and looks at the map; on the way it looks at the other pages. Pictures of all of them, wide
// and on a phone, are left in DIR.
// Usage: node tests/browser/arrival_test.mjs --base URL --name N --password P --destination LABEL --out DIR [--robot NAME]
import { parseArgs } from 'node:util';
import { findings, kPhone, kWide, launch, openPage, shoot, signIn, sticksOut } from './browser.mjs';

const kKnowsPlaceMs = 60_000;
const kArrivalMs = 240_000;
const kPollMs = 250;
const kUnderWayMs = 5_000; // into the journey, when its picture is taken

const { values } = parseArgs({
  options: {
    base: { type: 'string' },
    name: { type: 'string' },
    password: { type: 'string' },
    destination: { type: 'string' },
    out: { type: 'string' },
    robot: { type: 'string' },
  },
});
for (const key of ['base', 'name', 'password', 'destination', 'out'])
  if (!values[key]) throw new Error(`--${key} is missing`);

const say = (text) => process.stdout.write(`${((performance.now() - begun) / 1000).toFixed(1)} s  ${text}\n`);
const begun = performance.now();

/** What the page says about the journey: its phase, and all its words. */
async function journeyOf(page) {
  const card = page.getByTestId('journey');
  if ((await card.count()) === 0) return { phase: null, words: '' };
  return {
    phase: await card.getAttribute('data-phase'),
    words: (await card.innerText()).replace(/\s+/g, ' '),
  };
}

async function drive(page) {
  await signIn(page, values.name, values.password);
  if (values.robot)
    await page.getByRole('group', { name: 'Robot' }).getByRole('button', { name: values.robot }).click();
  const card = page
    .locator('.destination', { hasText: new RegExp(`^\\s*${escaped(values.destination)}`, 'i') })
    .first();
  await card.waitFor({ timeout: 20_000 });
  await page
    .locator('.where-words', { hasText: /^I am (in|near|somewhere)/ })
    .waitFor({ timeout: kKnowsPlaceMs });
  say(await page.locator('.where-words').innerText());
  await shoot(page, values.out, 'before');
  await card.click();

  let active = false; // what the page says of an earlier journey does not count
  let pictured = false;
  let shown = '';
  for (const until = performance.now() + kArrivalMs; performance.now() < until;) {
    const takeOver = page.getByRole('button', { name: 'Take over' });
    if ((await takeOver.count()) > 0) await takeOver.click();
    const { phase, words } = await journeyOf(page);
    if (words !== shown) say((shown = words));
    if (phase === 'asking' || phase === 'accepted' || phase === 'driving') {
      if (phase === 'driving' && !pictured) {
        pictured = true;
        await page.waitForTimeout(kUnderWayMs);
        await shootBoth(page, 'go');
        for (const name of ['Tours', 'Robots', 'Settings', 'Go']) {
          await open(page, name);
          await shootBoth(page, name.toLowerCase());
        }
      }
      active ||= phase !== 'asking';
    } else if (phase === 'refused' || (active && (phase === 'failed' || phase === 'stopped'))) {
      throw new Error(`it did not arrive: ${words}`);
    } else if (active && phase === 'arrived') {
      return;
    }
    await page.waitForTimeout(kPollMs);
  }
  throw new Error(`no arrival within ${kArrivalMs / 1000} s; the page says: ${shown}`);
}

async function open(page, name) {
  await page.getByRole('navigation', { name: 'Pages' }).getByRole('link', { name }).click();
  await page.waitForLoadState('networkidle');
}

/** The map of the real house: drawn, with the destination among its places. */
async function lookAtTheMap(page) {
  await open(page, 'Map');
  const place = page
    .getByRole('button', { name: new RegExp(`^${escaped(values.destination)}`, 'i') })
    .first();
  await place.waitFor();
  await place.click();
  await page.getByRole('region', { name: /^Chosen place: / }).waitFor();
  await page.waitForLoadState('networkidle');
  await shootBoth(page, 'map');
}

/** The page as it is, on a desk and on a phone: nothing may stick out sideways, and axe-core may find nothing. */
async function shootBoth(page, name) {
  await page.evaluate(() => scrollTo(0, 0));
  await page.waitForTimeout(300);
  await shoot(page, values.out, `${name}-desktop`);
  await accessible(page, name);
  await page.setViewportSize(kPhone);
  await page.waitForTimeout(600);
  if (await sticksOut(page)) throw new Error(`the ${name} page can be scrolled sideways on a phone`);
  await shoot(page, values.out, `${name}-phone`);
  await accessible(page, name);
  await page.setViewportSize(kWide);
  await page.waitForTimeout(300);
}

async function accessible(page, name) {
  const found = await findings(page);
  if (found.length > 0) throw new Error(`the ${name} page is not accessible:\n${found.join('\n')}`);
}

function escaped(text) {
  return text.replace(/[.*+?^${}()|[\]\\]/g, '\\$&').replace(/[_\s]+/g, '[_\\s]+');
}

const browser = await launch();
const page = await openPage(browser, { base: values.base });
try {
  await drive(page);
  await shoot(page, values.out, 'arrived');
  say('arrived');
  await lookAtTheMap(page);
} catch (thrown) {
  await shoot(page, values.out, 'failed').catch(() => undefined);
  process.stdout.write(`FAIL  ${thrown instanceof Error ? thrown.message : thrown}\n`);
  process.exitCode = 1;
} finally {
  await browser.close();
}
