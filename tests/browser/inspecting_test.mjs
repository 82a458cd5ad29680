// SPDX-License-Identifier: Apache-2.0
// Everything that can be changed about a map, and all that is shown of how it came about, in a real browser on the real
// server.
// Usage: node tests/browser/inspecting_test.mjs --base URL --name N --password P [--out FOLDER]
import assert from 'node:assert/strict';
import { mkdtempSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { findings, kPhone, launch, runChecks, shoot, sticksOut } from './browser.mjs';
import { person, realServer, takeBack } from './person.mjs';

const values = realServer();
const out = values.out ?? mkdtempSync(join(tmpdir(), 'homeward-screens-'));
const kBuildMs = 900_000; // beside other tests, which may have the processors first
const browser = await launch();
const anna = await person(browser, values.base, values.name, values.password);
const { page, ask } = anna;
const [{ id: map, name: map_name }] = (await ask('GET', '/maps')).maps;
const graph = () => ask('GET', `/maps/${map}/graph`);
const chosen = page.locator('.inspector');
const history = page.getByRole('region', { name: 'Changes by people' });
const part = (name) =>
  page.getByRole('navigation', { name: 'Of this map' }).getByRole('link', { name, exact: true });

/** A name as the page writes it. */
const in_words = (name) => name.replaceAll('_', ' ');

/** Opens the map page at a place. */
async function at(place) {
  await page.goto(`/map/${map}/place/${place}`);
  await chosen.getByRole('heading', { level: 2 }).waitFor();
}

/** A part of the place that opens on a press. */
async function open(title) {
  const section = chosen
    .locator('details')
    .filter({ has: page.getByText(title) })
    .last();
  await section.locator('summary').first().click();
  return section;
}

/** Takes the newest change back; the map is as it was before. */
async function take_back(before) {
  await takeBack(history, ask, map);
  assert.deepEqual({ ...(await graph()), revision: 0 }, { ...before, revision: 0 });
}

async function see(name) {
  await page.waitForTimeout(400);
  await shoot(page, out, name);
  assert.deepEqual(await findings(page), [], name);
  assert.equal(await sticksOut(page), false, `${name}: wider than the screen`);
}

/** Two places beside each other, of which neither has a label, and the second more than two pictures. */
async function two_places() {
  const { places, edges } = await graph();
  const of = (id) => places.find((one) => one.id === id);
  const plain = ({ label }) => label === '';
  const edge = edges.find(
    ({ from, to }) => plain(of(from)) && plain(of(to)) && of(to).members.length > 2 && of(to).name !== '',
  );
  assert.ok(edge, 'every place has a label');
  return [of(edge.from), of(edge.to)];
}

const checks = [
  [
    'a place tells of when its pictures are, and by which looks in which light it is recognised',
    async () => {
      const { places } = await graph();
      const known = places.find(({ label }) => label !== '');
      assert.ok(known.brightness > 0, JSON.stringify(known));
      await at(known.id);
      const pictures = await open('All pictures, by tour');
      await pictures.getByText(/brought .+, \d+ pictures?, in their order/).waitFor();
      const looks = await open(/^Recognised by: /);
      await looks.getByText(/^From the tour .+, brought .+, in good light$/).waitFor();
      await see('inspect-place');
    },
  ],
  [
    'two places are joined, and parted again as they were',
    async () => {
      const before = await graph();
      const [first, second] = await two_places();
      await at(first.id);
      const section = await open('Join with another place');
      await section.getByLabel('Find by name').fill(in_words(second.name));
      await section.getByRole('radio').first().check();
      await section.getByRole('button', { name: 'Join the two' }).click();
      await chosen.getByText('are one place now.').waitFor();
      const joined = await graph();
      assert.equal(joined.places.length, before.places.length - 1);
      await take_back(before);
    },
  ],
  [
    'pictures become a place of their own, or go to another',
    async () => {
      const before = await graph();
      const [first, second] = await two_places();
      await at(second.id);
      const section = await open('Take pictures out');
      await section.getByRole('checkbox').last().check();
      await section.getByRole('button', { name: 'Make a place of them' }).click();
      await section.getByText('1 picture is a place of its own now.').waitFor();
      const { places } = await graph();
      assert.deepEqual(places.at(-1).members, second.members.slice(-1));
      await take_back(before);
      await at(second.id);
      const again = await open('Take pictures out');
      await again.getByRole('checkbox').first().check();
      await again.getByLabel('Where they belong').selectOption({ label: 'To another place' });
      await again.getByLabel('Find by name').fill(in_words(first.name));
      await again.getByRole('radio').first().check();
      await again.getByRole('button', { name: 'Move them' }).click();
      await again.getByText(/^1 picture went to/).waitFor();
      const moved = (await graph()).places.find(({ members }) => members.includes(second.members[0]));
      assert.notEqual(moved.id, second.id);
      await take_back(before);
    },
  ],
  [
    'a way comes, is driven slowly until a drive confirms it, closes in one direction, and goes',
    async () => {
      const before = await graph();
      const [first] = await two_places();
      const known = new Set(before.edges.filter(({ from }) => from === first.id).map(({ to }) => to));
      const far = before.places.find(({ id, label }) => label !== '' && id !== first.id && !known.has(id));
      await at(first.id);
      const section = await open('Add a way');
      await section.getByLabel('Find by name').fill(in_words(far.label));
      await section.getByRole('radio').first().check();
      await section.getByRole('button', { name: 'Add the way' }).click();
      await section.getByText(/^There is a way to .+ now\.$/).waitFor();
      const added = (await graph()).edges.filter(({ from, to }) => from === first.id && !known.has(to));
      assert.equal(added.length, 1);
      assert.equal(added[0].by, 'person');
      const far_title = new RegExp(`Both directions of the way to ${in_words(far.label)}`, 'i');
      await chosen.getByText(far_title).click();
      const way = chosen.locator('details').filter({ hasText: far_title }).last();
      await way.getByText('Driven slowly until').first().waitFor();
      await way.getByRole('button', { name: /^Close this direction, from here/ }).click();
      await chosen.getByText('Closed in one direction').waitFor();
      const of_way = ({ from, to }) => from === added[0].from && to === added[0].to;
      assert.ok((await graph()).edges.find(of_way).blocked);
      await way.getByRole('button', { name: /^Remove the way to/ }).click();
      await way.getByRole('group').getByRole('button', { name: 'Remove the way', exact: true }).click();
      for (const until = Date.now() + 10_000; (await graph()).edges.some(of_way);)
        assert.ok(Date.now() < until, 'the way is still there');
      assert.deepEqual((await graph()).edges, before.edges);
    },
  ],
  [
    'a destination comes, gets a name, a sign and a picture, and goes',
    async () => {
      const before = await graph();
      const [, second] = await two_places();
      await at(second.id);
      const adding = await open('Add a destination');
      await adding.getByLabel('Name of the new destination').fill('Corner');
      await adding.getByRole('radio').first().check();
      await adding.getByRole('button', { name: 'Add the destination' }).click();
      await adding.getByText('Riders can be sent to Corner now.').waitFor();
      const here = await open('Destinations here: 1');
      await here.getByLabel('Name of the destination Corner').fill('Reading corner');
      await here.getByRole('button', { name: 'Save', exact: true }).click();
      await here.getByText('The destination is called Reading corner now.').waitFor();
      await here.getByText('Its sign').click();
      await here.getByRole('radio', { name: 'Seat' }).check();
      await here.getByText('Reading corner shows another sign now.').waitFor();
      await here.getByText('Where the chair stands').click();
      await here
        .getByRole('radio', { name: /\.(jpg|png)$/ })
        .nth(1)
        .check();
      await here.getByText('The chair comes to stand at Reading corner as in that picture now.').waitFor();
      const [made] = (await graph()).destinations.filter(({ place }) => place === second.id);
      assert.deepEqual([made.label, made.pictogram], ['Reading corner', 'seat']);
      assert.ok(second.members.slice(1).includes(made.image));
      await here.getByRole('button', { name: 'Remove the destination Reading corner' }).click();
      await here.getByRole('group').getByRole('button', { name: 'Remove', exact: true }).click();
      await chosen.getByText('Destinations here: 1').waitFor({ state: 'detached' });
      assert.deepEqual((await graph()).destinations, before.destinations);
    },
  ],
  [
    'who is not sure of a doubt leaves it for last, by name',
    async () => {
      const doubts = async () => (await ask('GET', `/maps/${map}/doubts?limit=1000`)).doubts;
      const [asked] = await doubts();
      assert.ok(asked, 'this house leaves nothing open');
      await page.goto(`/map/${map}`);
      await part('Evidence').click();
      const doubt = page.locator('.doubt');
      await doubt.locator('img').first().waitFor();
      await doubt.getByRole('button', { name: /^Not sure/ }).click();
      await page.getByText('Saved.').waitFor();
      const now = await doubts();
      const last = now.find(({ image_a, image_b }) => image_a === asked.image_a && image_b === asked.image_b);
      assert.equal(last.set_aside_by, values.name);
      assert.ok(now.indexOf(last) >= now.filter((one) => one.set_aside_by === null).length);
    },
  ],
  [
    'two states of the map stand beside each other',
    async () => {
      const { revision, places } = await graph();
      for (const [i, label] of ['Larder', 'Pantry'].entries()) {
        const edits = [{ kind: 'rename', place: places.at(-1).id, label }];
        await ask('POST', `/maps/${map}/edits`, { edits }, { 'If-Match': `"r${revision + i}"` });
      }
      await page.goto(`/map/${map}`);
      await part('Changes').click();
      const other = page.getByRole('region', { name: 'What is other' });
      await other.getByText('From “As it was built”').waitFor();
      assert.equal(await page.getByTestId('graph').count(), 2);
      const larder = page
        .getByLabel('Compare')
        .getByRole('option')
        .filter({ hasText: /Larder/ })
        .last();
      await page.getByLabel('Compare').selectOption(await larder.getAttribute('value'));
      await other.getByText(/^From “After .*Larder/).waitFor();
      await other.getByText('“Larder” is called “Pantry” now.').waitFor();
      await see('mend-changes');
    },
  ],
  [
    'the report of the build is read, printed and opened on its own',
    async () => {
      await page.goto(`/map/${map}`);
      await part('Report').click();
      const frame = page.getByTitle(`Report of the map ${map_name}`);
      const content = frame.contentFrame();
      await content.getByRole('heading', { level: 1, name: map_name }).waitFor();
      await content.getByRole('heading', { name: 'Weak ways' }).waitFor();
      assert.ok((await content.locator('img, svg image').count()) > 3, 'it has its pictures');
      await frame.evaluate((one) => (one.contentWindow.print = () => (globalThis.printed = true)));
      await page.getByRole('button', { name: 'Print' }).click();
      assert.equal(await page.evaluate(() => globalThis.printed), true);
      await see('inspect-report');
      const [alone] = await Promise.all([
        page.context().waitForEvent('page'),
        page.getByRole('link', { name: 'Open on its own' }).click(),
      ]);
      await alone.getByRole('heading', { name: 'Weak ways' }).waitFor();
      await alone.close();
    },
  ],
  [
    'a map is built again, and what people changed is kept',
    async () => {
      const before = await graph();
      const [first] = await two_places();
      await at(first.id);
      await chosen.getByLabel('Name', { exact: true }).fill('Larder');
      await chosen.getByRole('button', { name: 'Save', exact: true }).click();
      await chosen.getByText('Named Larder.').waitFor();
      const { revision } = await graph();
      await part('Report').click();
      const again = page.getByRole('region', { name: 'Build it again' });
      await again.getByRole('button', { name: `Build again ${map_name}` }).click();
      await again.getByRole('button', { name: 'Build again', exact: true }).click();
      await again.getByRole('progressbar').waitFor();
      await again.getByRole('progressbar').waitFor({ state: 'detached', timeout: kBuildMs });
      assert.equal(await again.getByText(/could not be|was cancelled/).count(), 0);
      const after = await graph();
      const where = (state) => state.places.find(({ members }) => members.includes(first.prototype));
      assert.ok(after.revision > revision, 'it was not built');
      assert.equal(where(after).label, 'Larder');
      assert.deepEqual(
        after.destinations.map(({ label }) => label),
        before.destinations.map(({ label }) => label),
      );
      await see('mend-built-again');
      await page.goto(`/map/${map}`);
      await takeBack(history, ask, map);
      assert.equal(where(await graph()).label, first.label);
    },
  ],
  [
    'how alike all pictures are is moved over, and two of them are looked at',
    async () => {
      const { images } = await ask('GET', `/maps/${map}/similarity`);
      const { places } = await graph();
      const { members } = places.find((one) => one.label !== '' && one.members.length > 1);
      const [a, b] = members.map((one) => images.indexOf(one) + 1);
      await page.goto(`/map/${map}`);
      await part('Similarity').click();
      const matrix = page.getByTestId('matrix');
      await matrix.locator('img').first().waitFor();
      const drawn = await matrix
        .locator('img')
        .first()
        .evaluate((one) => one.decode().then(() => one.naturalWidth));
      assert.equal(drawn, 256);
      await page.getByLabel('A, along the top').fill(String(a));
      await page.getByLabel('B, down the side').fill(String(b));
      await page.keyboard.press('Enter');
      const two = page.getByRole('region', { name: 'The two pictures' });
      await two.getByText('The map takes both for one place.').waitFor();
      await two.getByText(/alike\.$/).waitFor();
      await page.waitForURL(`**/map/${map}/similarity/${a}/${b}`);
      await two.getByText('What is in both pictures').click();
      await two.getByText(/things? (is|are) in both pictures/).waitFor();
      await see('inspect-similarity');
    },
  ],
  [
    'on a phone and by night all of it fits',
    async () => {
      const phone = await person(browser, values.base, values.name, values.password, {
        size: kPhone,
        scheme: 'dark',
      });
      for (const [where, ready] of [
        ['changes', phone.page.getByRole('region', { name: 'What is other' })],
        ['report', phone.page.getByTitle(`Report of the map ${map_name}`)],
        ['similarity/3/40', phone.page.getByTestId('matrix').locator('img').first()],
        ['evidence', phone.page.locator('.doubt img').first()],
      ]) {
        await phone.page.goto(`/map/${map}/${where}`);
        await ready.waitFor();
        await phone.page.waitForTimeout(600);
        const name = `inspect-${where.split('/')[0]}-phone`;
        await shoot(phone.page, out, name);
        assert.deepEqual(await findings(phone.page), [], name);
        assert.equal(await sticksOut(phone.page), false, `${name}: wider than the screen`);
      }
      assert.deepEqual(phone.page.complaints, []);
      await phone.page.context().close();
    },
  ],
];

await runChecks(checks);
assert.deepEqual(page.complaints, [], 'the page complained');
await browser.close();
process.stdout.write(`screenshots: ${out}\n`);
