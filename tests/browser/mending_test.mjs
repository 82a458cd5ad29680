// SPDX-License-Identifier: Apache-2.0
// What docs/mend-a-map.md tells, done in a real browser on the real server; with --out its pictures go there.
// Usage: node tests/browser/mending_test.mjs --base URL --name N --password P [--out FOLDER]
import assert from 'node:assert/strict';
import { mkdtempSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { findings, kPhone, launch, runChecks, shoot, sticksOut } from './browser.mjs';
import { person, realServer, takeBack } from './person.mjs';

const values = realServer();
const out = values.out ?? mkdtempSync(join(tmpdir(), 'homeward-screens-'));
const kCheckMs = 900_000; // of some three hundred pictures, beside other tests, which may have the processors first

const browser = await launch();

const somebody = (name, password, look) => person(browser, values.base, name, password, look);

const anna = await somebody(values.name, values.password);
const [{ id: map }] = (await anna.ask('GET', '/maps')).maps;
const graph = () => anna.ask('GET', `/maps/${map}/graph`);
const drafts = async () => (await anna.ask('GET', `/maps/${map}/drafts`)).drafts;
const tab = (page, name) =>
  page.getByRole('navigation', { name: 'Pages' }).getByRole('link', { name }).click();
const bar = (page) => page.getByRole('region', { name: 'Draft', exact: true });
const list = (page) => page.getByRole('region', { name: 'Drafts', exact: true });
const other = (page) => page.getByRole('region', { name: 'What is other' });
const chosen = (page) => page.locator('.inspector');
const history = (page) => page.getByRole('region', { name: /^Changes (by people|in this draft)$/ });

/** A name as the page writes it: with a capital or not, without underscores. */
const called = (name) =>
  new RegExp(`^${name.replaceAll('_', ' ').replace(/[.*+?^${}()|[\]\\]/g, '\\$&')}$`, 'i');
const places = (page) => page.getByRole('region', { name: 'Places', exact: true });
const title = (page, name) => page.getByRole('heading', { level: 2, name: called(name) });

async function choose(page, place) {
  await places(page)
    .getByRole('button', { name: called(place) })
    .click();
  await title(page, place).waitFor();
}

async function begin(page, name) {
  await tab(page, 'Map');
  await list(page).getByLabel('What it is about').fill(name);
  await list(page).getByRole('button', { name: 'Begin a draft' }).click();
  await bar(page).getByText('You are working on a draft; the chair does not use it yet.').waitFor();
}

const sure = async (scope, name, verb) => {
  await scope.getByRole('button', { name }).click();
  await scope.getByRole('group').getByRole('button', { name: verb, exact: true }).click();
};

async function see(page, name) {
  await page.waitForTimeout(400);
  await shoot(page, out, name);
  assert.deepEqual(await findings(page), [], name);
  assert.equal(await sticksOut(page), false, `${name}: wider than the screen`);
}

/** A place on a way between destinations that has none itself; without it some are cut off, or have a long way round. */
async function bridge() {
  const { places, edges, destinations } = await graph();
  const named = new Set(destinations.map((one) => one.place));
  const reached = (without) => {
    const seen = new Set([destinations[0].place]);
    for (const here of seen)
      for (const { from, to } of edges) if (from === here && to !== without) seen.add(to);
    return seen;
  };
  return places.find(
    (place) => !named.has(place.id) && destinations.some((one) => !reached(place.id).has(one.place)),
  );
}

const checks = [
  [
    'a place says where it lies, and is named',
    async () => {
      const { page } = anna;
      const before = await graph();
      assert.equal(new Set(before.places.map((one) => one.name)).size, before.places.length);
      const place = before.places.find((one) => / (from|past) /.test(one.name));
      assert.ok(place, 'every place has a label');
      await tab(page, 'Map');
      await choose(page, place.name);
      await see(page, 'mend-place');
      await chosen(page).getByLabel('Name', { exact: true }).fill('Fish tank');
      await chosen(page).getByRole('button', { name: 'Save', exact: true }).first().click();
      await chosen(page).getByText('Named Fish tank.').waitFor();
      await title(page, 'Fish tank').waitFor();
      await history(page)
        .getByRole('button', { name: /^Take the newest back/ })
        .click();
      await title(page, place.name).waitFor();
      const after = await graph();
      assert.deepEqual(after.places, before.places);
    },
  ],
  [
    'a draft that would cut the house in two is told so before it counts',
    async () => {
      const { page } = anna;
      const before = await graph();
      const place = await bridge();
      assert.ok(place, 'no place of this house is needed');
      await begin(page, 'Tidy up');
      await choose(page, place.name);
      await chosen(page).getByText('Remove this place').click();
      await sure(chosen(page), /^Remove the place/, 'Remove');
      await other(page)
        .getByText(/is no place any more/)
        .waitFor();
      await bar(page)
        .getByRole('button', { name: /^Check it/ })
        .click();
      await bar(page)
        .getByText(/get worse|gets worse/)
        .first()
        .waitFor({ timeout: kCheckMs });
      await bar(page).scrollIntoViewIfNeeded();
      await see(page, 'mend-check');
      await history(page)
        .getByRole('button', { name: /^Take the newest back/ })
        .click();
      await other(page).getByText('Nothing yet').waitFor();
      assert.deepEqual(await graph(), before);
    },
  ],
  [
    'a draft without harm is checked, published as one change, and taken back',
    async () => {
      const { page } = anna;
      const before = await graph();
      const place = before.places.find((one) => one.label !== '');
      await choose(page, place.name);
      await chosen(page).getByLabel('Name', { exact: true }).fill('Winter garden');
      await chosen(page).getByRole('button', { name: 'Save', exact: true }).first().click();
      await other(page)
        .getByText(/is called .*Winter garden.* now/)
        .waitFor();
      await bar(page)
        .getByRole('button', { name: /^Check it/ })
        .click();
      await bar(page)
        .getByText(/Nothing gets worse/)
        .waitFor({ timeout: kCheckMs });
      await bar(page).scrollIntoViewIfNeeded();
      await see(page, 'mend-draft');
      await sure(bar(page), /^Publish the draft/, 'Publish');
      await page.getByText('was published: the chair uses it now.').waitFor();
      const after = await graph();
      assert.equal(after.places.find((one) => one.id === place.id).label, 'Winter garden');
      assert.deepEqual(await drafts(), []);
      await takeBack(history(page), anna.ask, map);
      assert.deepEqual((await graph()).places, before.places);
    },
  ],
  [
    'two people see what the other does without asking',
    async () => {
      const { page, ask } = anna;
      await ask('POST', '/users', { name: 'ben', password: 'a long password', role: 'installer' });
      const ben = await somebody('ben', 'a long password');
      const [first] = (await graph()).places;
      await tab(page, 'Map');
      const draft = await ben.ask('POST', `/maps/${map}/drafts`, { name: 'By ben' });
      const began = performance.now();
      await list(page).getByText('By ben').first().waitFor();
      process.stdout.write(
        `      a draft of somebody else is seen after ${Math.round(performance.now() - began)} ms\n`,
      );
      const edits = [{ kind: 'rename', place: first.id, label: 'Bens corner' }];
      const changed = await ben.ask(
        'POST',
        `/maps/${map}/drafts/${draft.id}/edits`,
        { edits },
        { 'If-Match': '"d1"' },
      );
      await ben.ask(
        'POST',
        `/maps/${map}/drafts/${draft.id}/publish`,
        {},
        { 'If-Match': `"d${changed.version}"` },
      );
      const published = performance.now();
      await places(page)
        .getByRole('button', { name: called('Bens corner') })
        .waitFor();
      process.stdout.write(
        `      what was published is seen after ${Math.round(performance.now() - published)} ms\n`,
      );
      await ben.page.context().close();
    },
  ],
  [
    'what may be wrong is looked at, answered, and the answer is taken back',
    async () => {
      const { page, ask } = anna;
      const { total, doubts } = await ask('GET', `/maps/${map}/doubts?about=undecided`);
      const [asked] = doubts;
      assert.ok(asked, 'this house leaves nothing open');
      await tab(page, 'Map');
      await page
        .getByRole('navigation', { name: 'Of this map' })
        .getByRole('link', { name: 'Evidence' })
        .click();
      const doubt = page.locator('.doubt');
      await page
        .getByRole('region', { name: 'What to look at' })
        .getByRole('listitem')
        .nth(doubts.indexOf(asked))
        .getByRole('button')
        .click();
      await doubt.locator('img').first().waitFor();
      const pair = await ask('GET', `/maps/${map}/pair?image_a=${asked.image_a}&image_b=${asked.image_b}`);
      if (pair.matches.length > 0) await doubt.locator('.pair-marks').waitFor();
      await see(page, 'mend-evidence');
      await doubt.getByRole('button', { name: /^No/ }).first().click();
      await page.getByText('Saved.').waitFor();
      const now = await ask('GET', `/maps/${map}/doubts?about=undecided`);
      assert.ok(
        now.doubts.every((one) => one.image_a !== asked.image_a || one.image_b !== asked.image_b),
        'it is asked again',
      );
      await page.getByRole('link', { name: 'Places', exact: true }).click();
      await takeBack(history(page), anna.ask, map);
      assert.equal((await ask('GET', `/maps/${map}/doubts?about=undecided`)).total, total);
    },
  ],
  [
    'on a phone it fits',
    async () => {
      const { page } = await somebody(values.name, values.password, { size: kPhone, scheme: 'dark' });
      await tab(page, 'Map');
      await see(page, 'mend-map-phone');
      await page
        .getByRole('navigation', { name: 'Of this map' })
        .getByRole('link', { name: 'Evidence' })
        .click();
      await page.locator('.doubt img').first().waitFor();
      await see(page, 'mend-evidence-phone');
      assert.deepEqual(page.complaints, []);
    },
  ],
];

await runChecks(checks);
assert.deepEqual(anna.page.complaints, [], 'the page complained');
await browser.close();
process.stdout.write(`screenshots: ${out}\n`);
