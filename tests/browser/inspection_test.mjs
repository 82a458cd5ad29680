// SPDX-License-Identifier: Apache-2.0
// How a map was driven, how it came about and how it was built, in a real browser against the pretended house.
// Usage: node tests/browser/inspection_test.mjs [FOLDER FOR SCREENSHOTS [WORDS]]     after web/build.sh
import assert from 'node:assert/strict';
import { findings, runChecks, shoot } from './browser.mjs';
import { inEveryLook, pretendedHouses, screenshotFolder, tab } from './house.mjs';

const out = screenshotFolder();
const { browser, withHouse } = await pretendedHouses();

/** Both directions of a way of the place that is shown. */
async function directions(page, other) {
  await page.getByText(`Both directions of the way to ${other}`).click();
  return page
    .locator('.inspector details')
    .filter({ hasText: `of the way to ${other}` })
    .last();
}

/** Three changes, of which the second is taken back. */
function someChanges(house) {
  const change = (by, edits) => house.steer({ do: 'change', by, edits });
  change('ben', [{ kind: 'rename', place: 'p5', label: 'big kitchen' }]);
  change('anna', [{ kind: 'delete', place: 'p12' }]);
  change('ben', [{ kind: 'add_edge', from: 'p5', to: 'p9' }]);
}

const part = (page, name) =>
  page.getByRole('navigation', { name: 'Of this map' }).getByRole('link', { name, exact: true });
const other = (page) => page.getByRole('region', { name: 'What is other' });
const history = (page) => page.getByRole('region', { name: 'Changes by people' });
const pathname = (page) => new URL(page.url()).pathname;

const checks = [
  [
    'a way tells how often it was driven and failed, and when last, in each direction',
    withHouse(async (page) => {
      await page.goto('/map/m1/place/p2');
      const way = await directions(page, 'Hall');
      await way.getByText(/^Driven 9 times, last on .+\.$/).waitFor();
      await way.getByText(/^Driven 12 times, failed once, last on .+\.$/).waitFor();
      await page.goto('/map/m1/place/p13');
      const hard = await directions(page, 'Near the bathroom');
      await hard.getByText(/^Failed once, last on .+\. Never driven to its end\.$/).waitFor();
      await hard.getByText('Not driven yet.').waitFor();
    }),
  ],
  [
    'a way that a person drew is driven slowly until it was driven, and again after its places were changed',
    withHouse(async (page, house) => {
      const slow = 'Driven slowly until a drive has come to its end here.';
      const ben = (edits) => house.steer({ do: 'change', by: 'ben', edits });
      ben([{ kind: 'add_edge', from: 'p5', to: 'p9' }]);
      await page.goto('/map/m1/place/p5');
      const way = await directions(page, 'Bedroom');
      await way.getByText(slow).first().waitFor();
      const drive = { from: 'p5', to: 'p9', driven: 1, failed: 0, last_failed_us: null };
      house.drives.push({ ...drive, last_driven_us: Date.now() * 1000 + 1 });
      await page.reload();
      const driven = await directions(page, 'Bedroom');
      const out_of_here = driven.getByRole('listitem').filter({ hasText: 'From here' });
      await out_of_here.getByText(/^Driven once, last on/).waitFor();
      await driven.getByRole('listitem').filter({ hasText: 'Back to here' }).getByText(slow).waitFor();
      await out_of_here.getByText(slow).waitFor({ state: 'detached' });
      await page.waitForTimeout(5);
      ben([{ kind: 'move', into: 'p9', images: ['t1/p8b.jpg'] }]);
      await out_of_here.getByText(slow).waitFor();
    }),
  ],
  [
    'a place tells by which looks it is recognised: from where, of when, and in which light',
    withHouse(async (page) => {
      await page.goto('/map/m1');
      await page.getByRole('button', { name: 'Kitchen', exact: true }).click();
      const chosen = page.locator('.inspector');
      await chosen.getByText('Recognised by: 3').click();
      await chosen.getByText(/^From the tour Ground floor, brought .+, in good light$/).waitFor();
      await chosen.getByText(/^From the tour Ground floor, brought .+, in dim light$/).waitFor();
      await chosen.getByText('Seen on a drive, in the dark').waitFor();
      await page.waitForTimeout(300);
      assert.deepEqual(await findings(page), []);
      await shoot(page, out, 'recognised-by');
    }),
  ],
  [
    'two states of a map stand beside each other, with what is other in words, at an address of their own',
    withHouse(async (page, house) => {
      someChanges(house);
      await tab(page, 'Map');
      await part(page, 'Changes').click();
      await other(page).getByText('From “As it was built” to “As it is now”.').waitFor();
      await other(page).getByText('“kitchen” is called “big kitchen” now.').waitFor();
      await other(page)
        .getByText(/is no place any more/)
        .waitFor();
      await other(page).getByText('The way between Big kitchen and Bedroom is new.').waitFor();
      assert.equal(await page.getByTestId('graph').count(), 2);
      await page.getByLabel('Compare').selectOption({ index: 1 });
      await other(page)
        .getByText(/^From “After ben named a place “big kitchen”/)
        .waitFor();
      assert.equal(await other(page).getByText('is called “big kitchen” now').count(), 0);
      assert.equal(pathname(page), '/map/m1/changes/1');
      await page.getByLabel('With').selectOption({ index: 0 });
      await other(page)
        .getByText(/is no place any more/)
        .waitFor();
      await other(page).getByText('is new').waitFor({ state: 'detached' });
      assert.equal(pathname(page), '/map/m1/changes/1/2');
      await page.reload();
      await other(page)
        .getByText(/is no place any more/)
        .waitFor();
    }),
  ],
  [
    'before and after a change is one press away, by keyboard',
    withHouse(async (page, house) => {
      someChanges(house);
      await tab(page, 'Map');
      await history(page)
        .getByRole('link', { name: /^Before and after: ben named a place/ })
        .focus();
      await page.keyboard.press('Enter');
      await other(page).getByText('1 difference').waitFor();
      assert.equal(pathname(page), '/map/m1/changes/0/1');
      await other(page)
        .getByRole('button', { name: /^Show on the map/ })
        .click();
      await page.getByText('Ringed in the drawings: Big kitchen').waitFor();
      assert.equal(pathname(page), '/map/m1/changes/0/1/place/p5');
      await page.getByRole('link', { name: 'Open it in the map as it is' }).click();
      await page.locator('.inspector').getByRole('heading', { level: 2, name: 'Big kitchen' }).waitFor();
    }),
  ],
  [
    'a change that was taken back is no state, and a map that nobody changed has one',
    withHouse(async (page, house) => {
      await page.goto('/map/m1/changes');
      await page.getByText('The map is as it was built').waitFor();
      someChanges(house);
      await page.getByLabel('Compare').waitFor();
      assert.equal(await page.getByLabel('Compare').getByRole('option').count(), 3);
      await history(page)
        .getByRole('button', { name: /^Take the newest back/ })
        .click();
      await history(page).getByText('(taken back)').waitFor();
      await page.waitForFunction(
        () => document.querySelectorAll('.form-columns select')[0].options.length === 2,
      );
      assert.equal(
        await history(page)
          .getByRole('link', { name: /^Before and after/ })
          .count(),
        2,
      );
    }),
  ],
  [
    'two states at every width and in light and dark are accessible and fit',
    inEveryLook(withHouse, out, async (page, house, see) => {
      someChanges(house);
      await page.goto('/map/m1/changes');
      await other(page).waitFor();
      await page.waitForTimeout(700);
      await see('changes');
      await page.getByTestId('graph').first().scrollIntoViewIfNeeded();
      await page.mouse.wheel(0, 250);
      await see('changes-drawings');
      await other(page).scrollIntoViewIfNeeded();
      await see('changes-list');
    }),
  ],
  [
    'the report of the build stands in the page, whole and without scripts, to print and to open on its own',
    withHouse(async (page) => {
      await tab(page, 'Map');
      await part(page, 'Report').click();
      const frame = page.getByTitle('Report of the map Ground floor');
      const content = frame.contentFrame();
      await content.getByRole('heading', { level: 1, name: 'Ground floor' }).waitFor();
      assert.equal(await frame.getAttribute('sandbox'), 'allow-same-origin allow-modals');
      const inner = () =>
        frame.evaluate((one) => one.contentDocument.documentElement.scrollHeight - one.clientHeight);
      await page.waitForTimeout(200);
      assert.ok((await inner()) <= 1, 'the report scrolls inside the page');
      await frame.evaluate((one) => (one.contentWindow.print = () => (globalThis.printed = true)));
      await page.getByRole('button', { name: 'Print' }).click();
      assert.equal(await page.evaluate(() => globalThis.printed), true);
      const [alone] = await Promise.all([
        page.context().waitForEvent('page'),
        page.getByRole('link', { name: 'Open on its own' }).click(),
      ]);
      await alone.getByRole('heading', { name: 'Weak places' }).waitFor();
      await page.reload();
      await content.getByRole('heading', { name: 'All places' }).waitFor();
    }),
  ],
  [
    'a map is built again where its report is, and what is to be known of that stands there',
    withHouse(async (page, house) => {
      await page.goto('/map/m1/report');
      const again = page.getByRole('region', { name: 'Build it again' });
      await again.getByRole('button', { name: /^Build again/ }).click();
      await again.getByRole('button', { name: 'Keep' }).click();
      assert.equal(house.jobs.length, 0, 'nobody was sure');
      await again.getByRole('button', { name: /^Build again/ }).click();
      await again.getByRole('button', { name: 'Build again', exact: true }).click();
      await again.getByRole('button', { name: /^Hide this: what is to be known/ }).waitFor();
      assert.deepEqual(
        house.jobs.map(({ kind, state }) => [kind, state]),
        [['build', 'done']],
      );
      assert.deepEqual(await findings(page), []);
    }),
  ],
  [
    'Escape stops the chair also out of the report',
    withHouse(async (page, house) => {
      await page.goto('/map/m1/report');
      await page.frameLocator('iframe').getByRole('heading', { name: 'Weak places' }).click();
      assert.equal(await page.evaluate(() => document.activeElement.localName), 'iframe');
      await page.keyboard.press('Escape');
      await page
        .getByTestId('stop-word')
        .getByText(/stop|stand/i)
        .waitFor();
      await page.waitForTimeout(400);
      assert.equal(house.robots[0].state, 'stopped');
    }),
  ],
  [
    'a map that was not built here has no report, and the page says what to do',
    withHouse(async (page, house) => {
      house.built = false;
      await page.goto('/map/m1/report');
      await page.getByText('There is no report of this map. The map was not built here').waitFor();
      await page.getByText('Build it here').getByRole('link', { name: 'Tours' }).click();
      await page.getByRole('heading', { level: 1, name: 'Tours' }).waitFor();
    }),
  ],
  [
    'the report at every width and in light and dark is accessible and fits',
    inEveryLook(withHouse, out, async (page, house, see) => {
      await page.goto('/map/m1/report');
      await page.frameLocator('iframe').getByRole('heading', { level: 1 }).waitFor();
      await see('report');
    }),
  ],
  [
    'how ways were driven is accessible and fits at every width and in light and dark',
    inEveryLook(withHouse, out, async (page, house, see) => {
      house.steer({ do: 'change', by: 'ben', edits: [{ kind: 'add_edge', from: 'p5', to: 'p9' }] });
      await page.goto('/map/m1/place/p5');
      const way = await directions(page, 'Bedroom');
      await directions(page, 'Near the kitchen');
      await way.getByText('Driven slowly').first().waitFor();
      await way.scrollIntoViewIfNeeded();
      await see('driven');
    }),
  ],
];

const wanted = process.argv[3] ?? '';
await runChecks(checks.filter(([name]) => name.includes(wanted)));
await browser.close();
process.stdout.write(`screenshots: ${out}\n`);
