// SPDX-License-Identifier: Apache-2.0
// What a person can change about a map from its page, in a real browser against the pretended house.
// Usage: node tests/browser/map_edits_test.mjs [FOLDER FOR SCREENSHOTS [WORDS]]     after web/build.sh
import assert from 'node:assert/strict';
import { runChecks, shoot } from './browser.mjs';
import { inEveryLook, pretendedHouses, screenshotFolder, tab } from './house.mjs';

const out = screenshotFolder();
const { browser, withHouse } = await pretendedHouses();

const kinds = (house) => house.edits.map((one) => one.kind);
const placeOf = (house, id) => house.graph.places.find((one) => one.id === id);
const chosen = (page) => page.locator('.inspector');

/** Opens the map page at a place. */
async function at(page, place, title) {
  await page.goto(`/map/m1/place/${place}`);
  await page.getByRole('heading', { level: 2, name: title, exact: true }).waitFor();
}

/** A part of the place that opens on a press. */
async function open(page, title) {
  const section = chosen(page)
    .locator('details')
    .filter({ has: page.getByText(title) })
    .last();
  await section.locator('summary').first().click();
  return section;
}

const checks = [
  [
    'two places are joined, found by name, and the one with a name keeps it',
    withHouse(async (page, house) => {
      await at(page, 'p4', 'Near the kitchen');
      const section = await open(page, 'Join with another place');
      await section.getByLabel('Find by name').fill('kitch');
      await section.getByRole('radio', { name: 'Kitchen', exact: true }).check();
      await section.getByText('Near the kitchen and Kitchen become one place, called Kitchen').waitFor();
      await shoot(page, out, 'join');
      await section.getByRole('button', { name: 'Join the two' }).click();
      await page.getByRole('heading', { level: 2, name: 'Kitchen', exact: true }).waitFor();
      await chosen(page).getByText('Near the kitchen and Kitchen are one place now.').waitFor();
      assert.equal(placeOf(house, 'p4'), undefined);
      assert.equal(placeOf(house, 'p5').members.length, 4);
      assert.equal(new URL(page.url()).pathname, '/map/m1/place/p5');
    }),
  ],
  [
    'a place to join with is chosen by a press in the drawing, and in the list',
    withHouse(async (page, house) => {
      await at(page, 'p4', 'Near the kitchen');
      const section = await open(page, 'Join with another place');
      await section.getByRole('button', { name: 'Choose in the drawing' }).click();
      await page.locator('.graph-pick').waitFor();
      await page
        .getByRole('region', { name: 'Places', exact: true })
        .getByRole('button', { name: 'Bathroom', exact: true })
        .click();
      await page.locator('.graph-pick').waitFor({ state: 'detached' });
      assert.ok(await section.getByRole('radio', { name: 'Bathroom', exact: true }).isChecked());
      await page.getByRole('heading', { level: 2, name: 'Near the kitchen' }).waitFor();
      assert.deepEqual(kinds(house), []);
    }),
  ],
  [
    'pictures leave a place by keyboard: to a place of their own, or to another',
    withHouse(async (page, house) => {
      await at(page, 'p5', 'Kitchen');
      const section = await open(page, 'Take pictures out');
      const all = section.getByRole('checkbox');
      await all.first().check();
      await all.last().check();
      await section.getByText('At least one picture has to stay.').waitFor();
      const act = section.getByRole('button', { name: 'Make a place of them' });
      assert.ok(await act.isDisabled());
      await all.first().uncheck();
      await act.focus();
      await page.keyboard.press('Enter');
      await section.getByText('1 picture is a place of its own now.').waitFor();
      assert.deepEqual(placeOf(house, 'p14').members, ['t1/p5b.jpg']);
      await at(page, 'p13', 'Bathroom');
      const again = await open(page, 'Take pictures out');
      await again.getByRole('checkbox', { name: 'p13b.jpg' }).check();
      await again.getByLabel('Where they belong').selectOption({ label: 'To another place' });
      await again.getByRole('radio').first().check();
      await again.getByRole('button', { name: 'Move them' }).click();
      await again.getByText('1 picture went to Near the bathroom.').waitFor();
      assert.ok(placeOf(house, 'p12').members.includes('t1/p13b.jpg'));
      assert.deepEqual(kinds(house), ['split', 'move']);
    }),
  ],
  [
    'what the server refuses is said in its words, with the pictures concerned',
    withHouse(async (page, house) => {
      await at(page, 'p1', 'Hall');
      const section = await open(page, 'Add a way');
      // The way comes into being while this page does not hear of it.
      await section.getByRole('radio').first().check();
      await section.getByRole('button', { name: 'Add the way' }).click();
      await section.getByText('The map has the way between p1 and p2 already.').waitFor();
      assert.equal(await section.getByRole('alert').getByRole('img').count(), 2);
      await section.getByRole('alert').scrollIntoViewIfNeeded();
      await shoot(page, out, 'refused-edit');
      await section.getByLabel('Find by name').fill('bathroom');
      await section.getByRole('radio', { name: 'Bathroom', exact: true }).check();
      await section.getByRole('button', { name: 'Add the way' }).click();
      await section.getByText('There is a way to Bathroom now.').waitFor();
      assert.deepEqual(kinds(house), ['add_edge']);
    }),
  ],
  [
    'a way is closed in one direction, opened again, and removed',
    withHouse(async (page, house) => {
      await at(page, 'p13', 'Bathroom');
      await chosen(page).getByText('Hard to drive').waitFor();
      const section = await open(page, 'Both directions');
      await section.getByText('1.2 m, 90 % sure where to head, hard to drive.').first().waitFor();
      await section
        .getByRole('button', { name: 'Close this direction, from here: Near the bathroom' })
        .click();
      await chosen(page).getByText('Closed in one direction').waitFor();
      const blocked = () =>
        house.graph.edges.filter((one) => one.blocked).map((one) => `${one.from}>${one.to}`);
      assert.deepEqual(blocked(), ['p13>p12']);
      await section
        .getByRole('button', { name: 'Open this direction, from here: Near the bathroom' })
        .click();
      await chosen(page).getByText('This direction is open again.').waitFor();
      assert.deepEqual(blocked(), []);
      await section.getByRole('button', { name: 'Remove the way to Near the bathroom' }).click();
      await section
        .getByRole('group', { name: 'Remove this way, in both directions?' })
        .getByRole('button', { name: 'Remove the way' })
        .click();
      await chosen(page).getByText('None: the chair cannot drive to or from this place.').waitFor();
    }),
  ],
  [
    'a place is removed only when that is meant, and comes back by taking the change back',
    withHouse(async (page, house) => {
      await at(page, 'p9', 'Bedroom');
      const section = await open(page, 'Remove this place');
      await section.getByText('1 way and 1 destination here go with it.').waitFor();
      await section.getByRole('button', { name: 'Remove the place Bedroom' }).click();
      assert.deepEqual(kinds(house), []);
      await section
        .getByRole('group', { name: 'Remove Bedroom from the map?' })
        .getByRole('button', { name: 'Remove' })
        .click();
      const history = page.getByRole('region', { name: 'Changes by people' });
      await history.getByText('Bedroom was removed.').waitFor();
      assert.equal(await chosen(page).count(), 0);
      await history.getByRole('button', { name: /^Take the newest back/ }).click();
      await page
        .getByRole('region', { name: 'Places', exact: true })
        .getByRole('button', { name: 'Bedroom', exact: true })
        .waitFor();
    }),
  ],
  [
    'a destination is added, gets a name, a sign and a picture, and goes; riders see each',
    withHouse(async (page, house) => {
      await at(page, 'p3', 'Near the hall');
      const adding = await open(page, 'Add a destination');
      await adding.getByLabel('Name of the new destination').fill('Corner');
      await adding.getByRole('radio', { name: 'p3.jpg' }).check();
      await adding.getByRole('button', { name: 'Add the destination' }).click();
      await adding.getByText('Riders can be sent to Corner now.').waitFor();
      const here = await open(page, 'Destinations here: 1');
      await here.getByLabel('Name of the destination Corner').fill('Reading corner');
      await here.getByRole('button', { name: 'Save', exact: true }).click();
      await here.getByText('The destination is called Reading corner now.').waitFor();
      await here.getByText('Its sign').click();
      await here.getByRole('radio', { name: 'Seat' }).check();
      await here.getByText('Reading corner shows another sign now.').waitFor();
      await here.getByText('Where the chair stands').click();
      await here.getByRole('radio', { name: 'p3b.jpg' }).check();
      await here.getByText('The chair comes to stand at Reading corner as in that picture now.').waitFor();
      const [destination] = house.graph.destinations.filter((one) => one.place === 'p3');
      assert.deepEqual(
        [destination.label, destination.pictogram, destination.image],
        ['Reading corner', 'seat', 't1/p3b.jpg'],
      );
      await tab(page, 'Go');
      const card = page.locator('.destination', { hasText: 'Reading corner' });
      await card.locator('[data-pictogram=seat]').waitFor();
      await page
        .locator('.destination', { hasText: 'Kitchen' })
        .locator('[data-pictogram=kitchen]')
        .waitFor();
      await at(page, 'p3', 'Reading corner');
      const still = await open(page, 'Destinations here: 1');
      await still.getByRole('button', { name: 'Remove the destination Reading corner' }).click();
      await still.getByRole('group').getByRole('button', { name: 'Remove', exact: true }).click();
      await page.getByRole('heading', { level: 2, name: 'Near the hall', exact: true }).waitFor();
      assert.equal(house.graph.destinations.filter((one) => one.place === 'p3').length, 0);
    }),
  ],
  [
    'a place is titled by how it is told from others, and shows its pictures by tour',
    withHouse(async (page, house) => {
      placeOf(house, 'p3').name = 'third from the hall towards the kitchen';
      await at(page, 'p3', 'Third from the hall towards the kitchen');
      const pictures = await open(page, 'All pictures, by tour');
      await pictures.getByText('Ground floor').waitFor();
      assert.deepEqual(await pictures.getByRole('listitem').allInnerTexts(), ['p3.jpg', 'p3b.jpg']);
    }),
  ],
  [
    'how well the house is seen: ways that are hard to drive, parts that are not joined, tours',
    withHouse(async (page, house) => {
      await at(page, 'p5', 'Kitchen');
      const card = page.getByRole('region', { name: 'How well the house is seen' });
      await card.getByText('Tours in this map: 1').click();
      await card.getByText('26 pictures at 13 places').waitFor();
      await card.getByText('Ways that are hard to drive: 1').click();
      const edits = [{ kind: 'remove_edge', from: 'p4', to: 'p5' }];
      house.steer({ do: 'change', edits, by: 'ben' });
      await card.getByText('No open way leads to Kitchen.').waitFor();
      await shoot(page, out, 'coverage');
      await card.getByRole('button', { name: 'Bathroom – Near the bathroom' }).click();
      await page.getByRole('heading', { level: 2, name: 'Bathroom', exact: true }).waitFor();
    }),
  ],
  [
    'who may only look sees the ways and the pictures, and nothing to change',
    withHouse(
      async (page) => {
        await at(page, 'p5', 'Kitchen');
        assert.equal(await page.getByText('Change this place').count(), 0);
        const section = await open(page, 'Both directions');
        await section.getByText('1.2 m').first().waitFor();
        assert.equal(await section.getByRole('button').count(), 0);
      },
      { name: 'vera' },
    ),
  ],
  [
    'every part of a place at every width and in light and dark is accessible and fits',
    inEveryLook(withHouse, out, async (page, house, see) => {
      await at(page, 'p5', 'Kitchen');
      await see('place-closed');
      for (const title of [
        'Both directions',
        'Destinations here: 1',
        'Add a destination',
        'Take pictures out',
      ])
        await open(page, title);
      await chosen(page).getByText('Its sign').click();
      await chosen(page).getByText('Change this place').scrollIntoViewIfNeeded();
      await see('place-open');
      for (const title of ['Add a way', 'Join with another place', 'Remove this place', 'All pictures'])
        await open(page, title);
      await chosen(page).getByRole('button', { name: 'Choose in the drawing' }).first().click();
      await page.getByText('Join with another place').scrollIntoViewIfNeeded();
      await see('place-open-2');
      for (const title of ['Ways that are hard to drive', 'Tours in this map'])
        await page.locator('summary').filter({ hasText: title }).click();
      await page.getByText('Tours in this map').scrollIntoViewIfNeeded();
      await see('coverage');
      await tab(page, 'Go');
      await see('go-signs');
    }),
  ],
];

const wanted = process.argv[3] ?? '';
await runChecks(checks.filter(([name]) => name.includes(wanted)));
await browser.close();
process.stdout.write(`screenshots: ${out}\n`);
