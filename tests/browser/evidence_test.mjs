// SPDX-License-Identifier: Apache-2.0
// What of a map a person should look at, in a real browser against the pretended house.
// Usage: node tests/browser/evidence_test.mjs [FOLDER FOR SCREENSHOTS [WORDS]]     after web/build.sh
import assert from 'node:assert/strict';
import { runChecks } from './browser.mjs';
import { inEveryLook, pretendedHouses, screenshotFolder, tab } from './house.mjs';

const out = screenshotFolder();
const { browser, withHouse } = await pretendedHouses();

const list = (page) => page.getByRole('region', { name: 'What to look at' });
const doubt = (page, question = 'Are these one and the same place?') =>
  page.getByRole('region', { name: question });

async function open(page) {
  await tab(page, 'Map');
  await page.getByRole('navigation', { name: 'Of this map' }).getByRole('link', { name: 'Evidence' }).click();
  await list(page).waitFor();
}

/** More than a page of doubts. */
function manyDoubts(house) {
  const [image_a, image_b] = ['t1/p2.jpg', 't1/p6.jpg'];
  house.moreDoubts = Array.from({ length: 30 }, (_, i) => ({
    kind: 'mixed_place',
    image_a: i % 2 ? image_a : image_b,
    image_b: `t1/p${(i % 13) + 1}b.jpg`,
    place_a: 'p2',
    place_b: 'p2',
    state: 'accepted',
    by: 'method',
    probability: 0.1,
    effect: 0.1,
    weight: 0.01 - i * 1e-4,
    masses_before: null,
    masses_after: null,
    support: null,
    plausibility: null,
    neighbours: [],
    reasons: [],
    if_yes: [],
    if_no: [{ kind: 'split', place: 'p2', images: ['t1/p2b.jpg'] }],
  }));
}

const checks = [
  [
    'a doubt shows two pictures turned to each other, what is in both, how the map stands and what speaks for it',
    withHouse(async (page) => {
      await open(page);
      const card = doubt(page);
      await card.getByText('The map leaves it open, and keeps them apart until somebody decides').waitFor();
      await card.getByText('it is between 55 % and 80 % sure that they are one place.').waitFor();
      await card.getByText('16 things are in both pictures; 13 of them lie as they would').waitFor();
      assert.equal(await card.locator('.pair-marks line').count(), 12);
      const moved = await card
        .locator('.half')
        .nth(1)
        .locator('img')
        .first()
        .evaluate((one) => one.style.left);
      assert.equal(moved, '-8%');
      await card.getByText('for one place 60 %, not known 30 %, against it 10 %').waitFor();
      await card.getByText('Near the kitchen and Near the bathroom become one place.').waitFor();
      await card
        .getByText(
          'Near the kitchen and Near the bathroom stay two places, also when the map is built again.',
        )
        .waitFor();
      await card.getByText('What lies around: 1 for it, 1 against it').click();
      await card.getByText('− against it').waitFor();
      await card.getByLabel('Mark what is in both').uncheck();
      assert.equal(await card.locator('.pair-marks').count(), 0);
      await card.getByRole('link', { name: 'Near the bathroom', exact: true }).first().click();
      await page
        .locator('.inspector')
        .getByRole('heading', { level: 2, name: 'Near the bathroom' })
        .waitFor();
    }),
  ],
  [
    'answers are saved by keyboard, and the next doubt comes',
    withHouse(async (page, house) => {
      await open(page);
      await list(page).getByText('1 to 2 of 2').waitFor();
      await doubt(page).getByText('Near the kitchen and Near the bathroom become one place.').waitFor();
      await doubt(page).getByRole('button', { name: 'No, two places' }).focus();
      await page.keyboard.press('Enter');
      await page.getByText('Saved.').waitFor();
      assert.equal(house.graph.hypotheses[2].decision, 'rejected');
      await list(page).getByText('1 to 1 of 1').waitFor();
      await doubt(page).getByText('between 100 % and 100 % sure').waitFor();
      await doubt(page).getByRole('button', { name: 'Not sure' }).click();
      await page.getByText('1 of them was left open').waitFor();
      assert.deepEqual(
        house.edits.map(({ kind, text, by }) => [kind, text, by]),
        [
          ['decide', 'reject', 'anna'],
          ['set_aside', 'same_place', 'anna'],
        ],
      );
      await page.reload();
      await list(page)
        .getByRole('button', { name: /anna was not sure\.$/ })
        .click();
      await doubt(page).getByText('anna was not sure.').waitFor();
      await doubt(page).getByRole('button', { name: 'Still not sure' }).waitFor();
      await doubt(page).getByRole('button', { name: 'Yes, one place' }).click();
      await page.getByText('There is nothing of this kind to look at.').waitFor();
      assert.equal(house.graph.hypotheses[1].decision, 'accepted');
      await page.getByLabel('Show').selectOption({ label: 'Decided by somebody' });
      await doubt(page).getByText('Somebody has decided that they are').waitFor();
    }),
  ],
  [
    'what somebody else was not sure of comes last',
    withHouse(async (page, house) => {
      await open(page);
      await doubt(page).getByText('Near the kitchen and Near the bathroom become one place.').waitFor();
      const about = { about: 'same_place', image_a: 't1/p4.jpg', image_b: 't1/p12.jpg' };
      house.steer({ do: 'change', by: 'ben', edits: [{ kind: 'set_aside', ...about }] });
      const last = list(page).getByRole('button').last();
      await last.getByText('ben was not sure.').waitFor();
      await doubt(page).getByText('between 100 % and 100 % sure').waitFor();
      await page.getByRole('link', { name: 'Places', exact: true }).click();
      const history = page.getByRole('region', { name: 'Changes by people' });
      await history
        .getByText('was not sure whether two places are one: Near the kitchen – Near the bathroom')
        .waitFor();
    }),
  ],
  [
    'a way that may not exist is removed',
    withHouse(async (page, house) => {
      await open(page);
      await page.getByLabel('Show').selectOption({ label: 'All' });
      await page.getByLabel('Kind').selectOption({ label: 'A way that may not exist' });
      const card = doubt(page, 'Can the chair drive straight between these?');
      await card.getByText('The map has a way here, from what was seen on a tour.').waitFor();
      await card.getByText('The way between Near the bathroom and Bathroom is removed.').waitFor();
      await card.getByRole('button', { name: 'No', exact: true }).click();
      await page.getByText('There is nothing of this kind to look at.').waitFor();
      assert.equal(house.graph.edges.filter((one) => one.from === 'p13').length, 0);
    }),
  ],
  [
    'doubts come in pages of 20, and by place',
    withHouse(async (page, house) => {
      manyDoubts(house);
      await open(page);
      await page.getByLabel('Show').selectOption({ label: 'All' });
      await list(page).getByText('1 to 20 of 34').waitFor();
      await list(page).getByRole('button', { name: 'Next 14 ones' }).click();
      await list(page).getByText('21 to 34 of 34').waitFor();
      assert.equal(await list(page).getByRole('listitem').count(), 14);
      await list(page).getByRole('button', { name: 'Earlier ones' }).click();
      await page.getByLabel('At the place').selectOption({ label: 'Bathroom' });
      await list(page).getByText('1 to 1 of 1').waitFor();
      assert.equal(new URL(page.url()).pathname, '/map/m1/evidence/place/p13');
      await page.reload();
      await page.getByLabel('Show').selectOption({ label: 'All' });
      await list(page).getByText('1 to 1 of 1').waitFor();
    }),
  ],
  [
    'answers go to the draft that is open, and the map stays as it is',
    withHouse(async (page, house) => {
      await tab(page, 'Map');
      await page.getByRole('button', { name: 'Begin a draft' }).click();
      await page.getByRole('region', { name: 'Draft', exact: true }).waitFor();
      await open(page);
      await page.getByText('Your answers go to the draft.').waitFor();
      await doubt(page).getByRole('button', { name: 'No, two places' }).click();
      await page.getByText('Saved.').waitFor();
      await doubt(page).getByRole('button', { name: 'Not sure' }).click();
      await page.getByText('You have looked at all of these.').waitFor();
      await list(page)
        .getByRole('button', { name: /looked at$/ })
        .first()
        .click();
      await doubt(page).getByText('Answered in this draft').waitFor();
      assert.deepEqual([house.edits.length, house.drafts[0].log.length], [0, 2]);
      await page.getByRole('link', { name: 'Places', exact: true }).click();
      const other = page.getByRole('region', { name: 'What is other' });
      await other
        .getByText('It is decided: Near the kitchen and Near the bathroom are two places.')
        .waitFor();
    }),
  ],
  [
    'who may only look sees the evidence and gives no answers',
    withHouse(
      async (page) => {
        await open(page);
        await doubt(page).getByText('The map leaves it open').waitFor();
        assert.equal(await page.getByRole('button', { name: 'Not sure' }).count(), 0);
      },
      { name: 'vera' },
    ),
  ],
  [
    'the evidence at every width and in light and dark is accessible and fits',
    inEveryLook(withHouse, out, async (page, house, see) => {
      manyDoubts(house);
      await open(page);
      await page.getByLabel('Show').selectOption({ label: 'All' });
      await doubt(page).locator('.pair-marks').waitFor();
      await doubt(page).getByText('What lies around').click();
      await page.evaluate(() => document.querySelector('.doubt').scrollIntoView());
      await see('evidence');
      await doubt(page).getByRole('button', { name: 'Not sure' }).scrollIntoViewIfNeeded();
      await page.mouse.wheel(0, 300);
      await see('evidence-answers');
      await doubt(page).getByRole('button', { name: 'Not sure' }).click();
      await page.getByLabel('Kind').selectOption({ label: 'One place that may be two' });
      await doubt(page, 'Do both pictures show one place?').waitFor();
      await see('evidence-mixed');
      await page.getByLabel('Kind').selectOption({ label: 'Two places that may be one' });
      await list(page).getByRole('button').last().click();
      await doubt(page).getByText('anna was not sure.').waitFor();
      await see('evidence-left-open');
    }),
  ],
];

const wanted = process.argv[3] ?? '';
await runChecks(checks.filter(([name]) => name.includes(wanted)));
await browser.close();
process.stdout.write(`screenshots: ${out}\n`);
