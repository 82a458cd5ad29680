// SPDX-License-Identifier: Apache-2.0
// Drafts of a map, in a real browser against the pretended house.
// Usage: node tests/browser/drafts_test.mjs [FOLDER FOR SCREENSHOTS [WORDS]]     after web/build.sh
import assert from 'node:assert/strict';
import { runChecks, shoot } from './browser.mjs';
import { inEveryLook, pretendedHouses, screenshotFolder, tab } from './house.mjs';

const out = screenshotFolder();
const { browser, withHouse } = await pretendedHouses();

const bar = (page) => page.getByRole('region', { name: 'Draft', exact: true });
const list = (page) => page.getByRole('region', { name: 'Drafts', exact: true });
const other = (page) => page.getByRole('region', { name: 'What is other' });
const chosen = (page) => page.locator('.inspector');
const kClose = [
  { kind: 'block_edge', from: 'p6', to: 'p12', blocked: true },
  { kind: 'block_edge', from: 'p12', to: 'p6', blocked: true },
];

async function begin(page, name = '') {
  await tab(page, 'Map');
  await list(page).getByLabel('What it is about').fill(name);
  await list(page).getByRole('button', { name: 'Begin a draft' }).click();
  await bar(page).getByText('You are working on a draft; the chair does not use it yet.').waitFor();
}

async function choose(page, title) {
  await page
    .getByRole('region', { name: 'Places', exact: true })
    .getByRole('button', { name: title, exact: true })
    .click();
  await page.getByRole('heading', { level: 2, name: title, exact: true }).waitFor();
}

/** The place before the bathroom; others are near it, too. */
async function besideBathroom(page) {
  await choose(page, 'Bathroom');
  await chosen(page).getByRole('button', { name: 'Near the bathroom', exact: true }).click();
  await page.getByRole('heading', { level: 2, name: 'Near the bathroom', exact: true }).waitFor();
}

const sure = async (scope, name, verb) => {
  await scope.getByRole('button', { name }).click();
  await scope.getByRole('group').getByRole('button', { name: verb, exact: true }).click();
};

const checks = [
  [
    'what is changed in a draft is told there, taken back and made again, and the map stays as it is',
    withHouse(async (page, house) => {
      await begin(page, 'Night ward');
      assert.equal(new URL(page.url()).pathname, `/map/m1/draft/${house.drafts[0].id}`);
      await other(page).getByText('Nothing yet').waitFor();
      await choose(page, 'Kitchen');
      await chosen(page).getByLabel('Name', { exact: true }).fill('Galley');
      await chosen(page).getByRole('button', { name: 'Save', exact: true }).first().click();
      await chosen(page).getByText('Named Galley.').waitFor();
      await other(page).getByText('“kitchen” is called “Galley” now.').waitFor();
      await page.getByTestId('legend').getByText('Changed').waitFor();
      await chosen(page).getByRole('button', { name: 'Close the way to Near Galley' }).click();
      await other(page).getByText('The way between Near Galley and Galley is closed.').waitFor();
      await other(page).getByText('The map falls into 2 parts').waitFor();
      const history = page.getByRole('region', { name: 'Changes in this draft' });
      await history.getByRole('button', { name: /^Take the newest back/ }).click();
      await other(page).getByText('is closed').waitFor({ state: 'detached' });
      await history.getByRole('button', { name: /^Make it again/ }).click();
      await other(page).getByText('is closed').waitFor();
      assert.deepEqual([house.edits.length, house.graph.revision], [0, 1]);
      await shoot(page, out, 'draft');
      await page.reload(); // its address leads here again
      await bar(page).getByRole('heading', { name: 'Night ward' }).waitFor();
      await bar(page).getByRole('button', { name: 'Leave it for now' }).click();
      await page.getByRole('heading', { level: 2, name: 'Kitchen', exact: true }).waitFor();
      await list(page)
        .getByText(/Begun by anna, .* 2 changes, at Kitchen/)
        .waitFor();
    }),
  ],
  [
    'a draft is published as one change of the map, by keyboard',
    withHouse(async (page, house) => {
      await begin(page);
      const publish = bar(page).getByRole('button', { name: 'Publish the draft Draft of anna' });
      assert.ok(await publish.isDisabled(), 'there is nothing to publish');
      await choose(page, 'Kitchen');
      await chosen(page).getByRole('button', { name: 'Close the way to Near the kitchen' }).click();
      await other(page).getByText('is closed').waitFor();
      await publish.focus();
      await page.keyboard.press('Enter');
      await page.waitForFunction(() => document.activeElement?.textContent === 'Keep');
      await page.keyboard.press('Shift+Tab');
      await page.waitForTimeout(1500); // what is told meanwhile takes the focus away from nobody
      await page.keyboard.press('Enter');
      await page.getByText('“Draft of anna” was published: the chair uses it now.').waitFor();
      assert.equal(house.graph.edges.filter((one) => one.blocked).length, 2);
      const history = page.getByRole('region', { name: 'Changes by people' });
      await history.getByText('closed a way: Kitchen – Near the kitchen').waitFor();
      assert.deepEqual([house.drafts.length, new Set(house.edits.map((one) => one.change)).size], [0, 1]);
      await history.getByRole('button', { name: /^Take the newest back/ }).click();
      await chosen(page).getByText('Closed', { exact: true }).waitFor({ state: 'detached' });
    }),
  ],
  [
    'a draft is discarded only when that is meant',
    withHouse(async (page, house) => {
      await begin(page, 'A thought');
      await bar(page).getByRole('button', { name: 'Discard the draft A thought' }).click();
      await bar(page).getByRole('button', { name: 'Keep' }).click();
      assert.equal(house.drafts.length, 1);
      await sure(bar(page), 'Discard the draft A thought', 'Discard');
      await page.getByText('“A thought” was discarded.').waitFor();
      assert.equal(house.drafts.length, 0);
    }),
  ],
  [
    'drafts of others come and go within a second, and are told where they touch the same places',
    withHouse(async (page, house) => {
      await begin(page);
      await choose(page, 'Bathroom');
      await chosen(page).getByRole('button', { name: 'Close the way to Near the bathroom' }).click();
      await other(page).getByText('is closed').waitFor();
      // By the events alone: nothing is asked for.
      await page.route('**/drafts', (route) => route.abort());
      house.steer({ do: 'draft', by: 'ben', name: 'Bath day', edits: kClose });
      await bar(page).getByText('ben changes Near the bathroom too, in the draft “Bath day”.').waitFor();
      await besideBathroom(page);
      await chosen(page).getByText('ben tries changes here, in the draft “Bath day”.').waitFor();
      await shoot(page, out, 'draft-overlap');
      await bar(page).getByRole('button', { name: 'Leave it for now' }).click();
      const theirs = list(page).getByRole('listitem').filter({ hasText: 'Bath day' });
      await theirs.getByText('ben closed a way').waitFor();
      house.steer({ do: 'draft_discard', draft: house.drafts.find((one) => one.by === 'ben').id });
      await theirs.waitFor({ state: 'detached' });
      assert.equal(await chosen(page).getByText('ben tries changes').count(), 0);
      // One that is open ends before the eyes of whoever looks at it.
      await list(page).getByRole('button', { name: 'Open the draft Draft of anna' }).click();
      await bar(page).waitFor();
      house.steer({ do: 'draft_discard', draft: house.drafts[0].id });
      await page.getByText('This draft is gone: it was published or discarded.').waitFor();
      await page.getByRole('button', { name: 'Understood' }).click();
      assert.equal(new URL(page.url()).pathname.includes('draft'), false);
    }),
  ],
  [
    'a check tells how far it is, then in sentences with pictures what gets worse',
    withHouse(async (page) => {
      await begin(page);
      await besideBathroom(page);
      await chosen(page).getByText('Remove this place').click();
      await sure(chosen(page), 'Remove the place Near the bathroom', 'Remove');
      await other(page).getByText('Near the bathroom is no place any more.').waitFor();
      await bar(page).getByRole('button', { name: 'Check it on the tours' }).click();
      await bar(page).getByRole('progressbar', { name: 'Checking the draft' }).waitFor();
      await bar(page).getByText('4 things get worse. Look at them before you publish.').waitFor();
      await bar(page).getByText('Near the bathroom the chair would be lost on 2 of 14 pictures.').waitFor();
      await bar(page).getByRole('img', { name: 'Picture p12b.jpg' }).waitFor();
      await bar(page).getByText('The chair could not drive from Hall to Bathroom any more.').waitFor();
      await shoot(page, out, 'draft-worse');
      const history = page.getByRole('region', { name: 'Changes in this draft' });
      await history.getByRole('button', { name: /^Take the newest back/ }).click();
      await bar(page).getByText('This was found before the latest change.').waitFor();
      await history.getByRole('button', { name: /^Make it again/ }).click();
      await choose(page, 'Kitchen');
      await chosen(page).getByLabel('Name', { exact: true }).fill('Galley');
      await chosen(page).getByRole('button', { name: 'Save', exact: true }).first().click();
      await history.getByText('named a place “Galley”').waitFor();
      await history.getByRole('button', { name: /^Take the newest back/ }).click();
      await history.getByText('(taken back)').waitFor();
      await history.getByRole('button', { name: /^Take the newest back/ }).click();
      await history.getByText('(taken back)').nth(1).waitFor();
      await history.getByRole('button', { name: /^Make it again: anna removed a place/ }).waitFor();
    }),
  ],
  [
    'of two people in one draft the later one sees what the other did, and repeats',
    withHouse(async (page, house) => {
      await begin(page);
      const [{ id, version }] = house.drafts;
      await choose(page, 'Kitchen');
      const earlier = async (route) => {
        house.steer({ do: 'draft_edit', draft: id, version, by: 'ben', edits: kClose });
        await route.continue();
      };
      await page.route('**/drafts/*/edits', earlier, { times: 1 });
      const name = chosen(page).getByLabel('Name', { exact: true });
      await name.fill('Galley');
      await chosen(page).getByRole('button', { name: 'Save', exact: true }).first().click();
      await page.getByText('Somebody else changed the map in the meantime.').waitFor();
      await other(page).getByText('is closed').waitFor();
      assert.equal(await name.inputValue(), 'Galley');
      await chosen(page).getByRole('button', { name: 'Save', exact: true }).first().click();
      await page.getByText('Named Galley.').waitFor();
      const history = page.getByRole('region', { name: 'Changes in this draft' });
      await history.getByLabel('Show the changes of').selectOption('ben');
      await history.getByText('named a place').waitFor({ state: 'detached' });
      await history.getByText('closed a way').waitFor();
    }),
  ],
  [
    'what does not hold any more once the map has changed is said, and left out on purpose',
    withHouse(async (page, house) => {
      await begin(page);
      await choose(page, 'Bathroom');
      await chosen(page).getByRole('button', { name: 'Close the way to Near the bathroom' }).click();
      await other(page).getByText('is closed').waitFor();
      await choose(page, 'Kitchen');
      await chosen(page).getByLabel('Name', { exact: true }).fill('Galley');
      await chosen(page).getByRole('button', { name: 'Save', exact: true }).first().click();
      await chosen(page).getByText('Named Galley.').waitFor();
      const gone = [{ kind: 'remove_edge', from: 'p12', to: 'p13' }];
      house.steer({ do: 'change', edits: gone, by: 'ben' });
      await bar(page).getByText('2 edits of this draft do not hold on it any more.').waitFor();
      const history = page.getByRole('region', { name: 'Changes in this draft' });
      await history.getByText('The map has no edge from p13 to p12.').waitFor();
      await bar(page).getByRole('button', { name: 'Publish the draft Draft of anna' }).click();
      await bar(page)
        .getByRole('group', { name: /without what does not hold/ })
        .getByRole('button', { name: 'Publish' })
        .click();
      await page.getByText('was published: the chair uses it now.').waitFor();
      assert.equal(house.graph.places.find((one) => one.id === 'p5').label, 'Galley');
    }),
  ],
  [
    'who may only look sees drafts, and cannot change or publish them',
    withHouse(
      async (page, house) => {
        house.steer({ do: 'draft', by: 'anna', name: 'Bath day', edits: kClose });
        await tab(page, 'Map');
        assert.equal(await page.getByRole('button', { name: 'Begin a draft' }).count(), 0);
        await list(page).getByRole('button', { name: 'Open the draft Bath day' }).click();
        await other(page).getByText('is closed').waitFor();
        assert.deepEqual(await bar(page).getByRole('button').allInnerTexts(), ['Leave it for now']);
      },
      { name: 'vera' },
    ),
  ],
  [
    'drafts at every width and in light and dark are accessible and fit',
    inEveryLook(withHouse, out, async (page, house, see) => {
      house.steer({ do: 'draft', by: 'ben', name: 'Bath day', edits: kClose });
      await tab(page, 'Map');
      await list(page).scrollIntoViewIfNeeded();
      await see('drafts-list');
      await begin(page, 'Without the bathroom');
      await choose(page, 'Bathroom');
      await chosen(page).getByText('Take pictures out').click();
      await chosen(page).getByRole('checkbox').last().check();
      await chosen(page).getByRole('button', { name: 'Make a place of them' }).click();
      await chosen(page).getByText('1 picture is a place of its own now.').waitFor();
      await choose(page, 'Bedroom');
      await chosen(page).getByText('Remove this place').click();
      await sure(chosen(page), 'Remove the place Bedroom', 'Remove');
      await other(page).getByText('Bedroom is no place any more.').waitFor();
      await choose(page, 'Bathroom');
      await chosen(page)
        .getByRole('button', { name: /^Close the way to/ })
        .first()
        .click();
      await bar(page).getByText('ben changes').waitFor();
      await bar(page).getByRole('button', { name: 'Check it on the tours' }).click();
      await bar(page).getByRole('progressbar').waitFor();
      await bar(page).getByText('Look at').waitFor();
      await page.waitForTimeout(500);
      await page.evaluate(() => scrollTo(0, 0));
      await see('draft-top');
      await page.getByTestId('legend').scrollIntoViewIfNeeded();
      await page.mouse.wheel(0, 500);
      await see('draft-drawing');
      await other(page).scrollIntoViewIfNeeded();
      await see('draft-difference');
    }),
  ],
];

const wanted = process.argv[3] ?? '';
await runChecks(checks.filter(([name]) => name.includes(wanted)));
await browser.close();
process.stdout.write(`screenshots: ${out}\n`);
