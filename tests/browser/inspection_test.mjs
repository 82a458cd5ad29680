// SPDX-License-Identifier: Apache-2.0
// How a map was driven, how it came about and how it was built, in a real browser against the pretended house.
// Usage: node tests/browser/inspection_test.mjs [FOLDER FOR SCREENSHOTS [WORDS]]     after web/build.sh
import { runChecks } from './browser.mjs';
import { inEveryLook, pretendedHouses, screenshotFolder } from './house.mjs';

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
