// SPDX-License-Identifier: Apache-2.0
// Floor plans: uploaded, laid under a map by pins, and shown with the chair, in a real browser against the pretended house.
// Usage: node tests/browser/plans_test.mjs [FOLDER FOR SCREENSHOTS [WORDS]]     after web/build.sh
import assert from 'node:assert/strict';
import { runChecks } from './browser.mjs';
import { tellOnPlan } from '../../web/dev/mock-plans.mjs';
import { inEveryLook, pretendedHouses, screenshotFolder, tab } from './house.mjs';

const out = screenshotFolder();
const { browser, withHouse } = await pretendedHouses();

const file = (name, text) => ({ name, mimeType: 'application/octet-stream', buffer: Buffer.from(text) });
const plansCard = (page) => page.getByRole('region', { name: 'Floor plans' });
const paper = (page) => page.getByTestId('floor-plan');
const part = (page, name) =>
  page.getByRole('navigation', { name: 'Of this map' }).getByRole('link', { name, exact: true });

async function upload(page, name, of = file('house.svg', '<svg></svg>')) {
  await tab(page, 'Tours');
  const card = plansCard(page);
  await card.getByLabel('Name of the plan').fill(name);
  await card.getByLabel('File', { exact: true }).setInputFiles(of);
  await card.getByRole('button', { name: 'Upload the plan' }).click();
}

/** As the pretended server does it. */
function tied(house) {
  house.plans.push({
    id: 'plan1',
    name: 'Ground floor',
    created_us: 1.7e15,
    maps: [],
    versions: [
      {
        version: 1,
        format: 'svg',
        created_us: 1.7e15,
        by: 'anna',
        bytes: 900,
        metres_per_unit: 0.01,
        up: null,
        wall_height_m: 2.5,
        lines: 16,
        triangles: 0,
        extent: { min_x_m: 0.3, min_y_m: 0.3, min_z_m: 0, max_x_m: 14.7, max_y_m: 14.7, max_z_m: 2.5 },
      },
    ],
  });
  const pins = [
    { image: 't1/p1.jpg', x_m: 1.2, y_m: 7.5, theta_rad: null },
    { image: 't1/p11.jpg', x_m: 14, y_m: 7.7, theta_rad: null },
  ];
  house.ties.set('m1', { plan: 'plan1', version: 1, tied_us: 1.7e15, by: 'anna', pins });
  house.maps[0].plan = { id: 'plan1', version: 1, tied_us: 1.7e15 };
}

/** A page of a house whose map is tied before anybody looks. */
const withPlan = (check, look) =>
  withHouse(async (page, house, mock) => {
    tied(house);
    await page.reload();
    await check(page, house, mock);
  }, look);

const sign = (page, kind) => paper(page).locator(`[data-kind=${kind}]`);

/** Where the middle of a sign is on the plan, as shares of its width and height. */
async function shareOf(page, locator) {
  const [at, box] = [await locator.boundingBox(), await paper(page).boundingBox()];
  return { x: (at.x - box.x) / box.width, y: (at.y - box.y) / box.height };
}

const checks = [
  [
    'an installer uploads a plan, pins two places, and the chair is on it',
    withHouse(async (page, house) => {
      await upload(page, 'Ground floor');
      await plansCard(page).getByText('14 m by 14 m, 16 lines').waitFor();
      await tab(page, 'Map');
      await part(page, 'Floor plan').click();
      await page.getByRole('button', { name: 'Lay the map onto this plan' }).click();
      const save = page.getByRole('button', { name: 'Save', exact: true });
      assert.equal(await save.isDisabled(), true);
      const places = page.getByRole('region', { name: 'Places' });
      const press = async (x, y) => {
        const { width, height } = await paper(page).boundingBox();
        await paper(page).click({ position: { x: x * width, y: y * height } });
      };
      await places.getByRole('button', { name: 'Hall', exact: true }).click();
      await page.getByText('Press the plan where this is: Hall.').waitFor();
      await press(0.1, 0.5);
      const hall = page.getByRole('group', { name: 'Hall' });
      await page.getByText('One more is needed.').waitFor();
      assert.ok(Number(await hall.getByLabel('Right, m').inputValue()) > 0.5);
      assert.equal(await save.isDisabled(), true);
      await places.getByRole('button', { name: 'Living room', exact: true }).click();
      await press(0.94, 0.5);
      await save.click();
      await page.getByText('The chair is in the hall.').waitFor();
      const tie = house.ties.get('m1');
      assert.deepEqual(
        tie.pins.map((one) => one.image),
        ['t1/p1.jpg', 't1/p11.jpg'],
      );
      const pinned = page.getByRole('list', { name: 'Pinned places' });
      await pinned.getByText('Living room').waitFor();
      assert.equal(await pinned.getByText(/^0\.\d\d m off$/).count(), 2);
      assert.equal(await sign(page, 'place').count(), 3, 'named places');
      const dots = await paper(page).locator('.dots').getAttribute('d');
      assert.equal(dots.split('M').length - 1, 8, 'places without a name');
      const chair = await shareOf(page, sign(page, 'chair'));
      assert.ok(Math.abs(chair.x - 0.1) < 0.02 && Math.abs(chair.y - 0.5) < 0.02, JSON.stringify(chair));
    }),
  ],
  [
    'numbers do for who cannot press the plan, and what is wrong is said',
    withHouse(async (page, house) => {
      await upload(page, 'Ground floor');
      await plansCard(page).getByText('16 lines').waitFor();
      await page.goto('/map/m1/plan');
      await page.getByRole('button', { name: 'Lay the map onto this plan' }).press('Enter');
      const places = page.getByRole('region', { name: 'Places' });
      const typed = async (title, x, y) => {
        await places.getByRole('button', { name: title, exact: true }).press('Enter');
        await page.getByRole('button', { name: `Type numbers for ${title}` }).press('Enter');
        const row = page.getByRole('group', { name: title });
        await row.getByLabel('Right, m').fill(x);
        await row.getByLabel('Up, m').fill(y);
      };
      await typed('Hall', '1.2', 'seven');
      await page.getByText('Say both distances in metres').waitFor();
      await page.getByRole('group', { name: 'Hall' }).getByLabel('Up, m').fill('7,5');
      await typed('Kitchen', '1.3', '7.5');
      await page.getByRole('button', { name: 'Save', exact: true }).press('Enter');
      await page.getByRole('alert').getByText('half a metre apart').waitFor();
      const kitchen = page.getByRole('group', { name: 'Kitchen' });
      await kitchen.getByLabel('Right, m').fill('5');
      await kitchen.getByLabel('Up, m').fill('13.5');
      await kitchen.getByLabel('Faces, °').fill('90');
      await page.getByRole('button', { name: 'Save', exact: true }).press('Enter');
      await page.getByText('The chair is in the hall.').waitFor();
      const [hall, second] = house.ties.get('m1').pins;
      assert.deepEqual([hall.x_m, hall.y_m, hall.theta_rad], [1.2, 7.5, null]);
      assert.ok(Math.abs(second.theta_rad - Math.PI / 2) < 1e-6);
    }),
  ],
  [
    'a file that cannot be read is refused with its line, and what was typed stays',
    withHouse(async (page, house) => {
      await upload(page, 'Ground floor', file('house.svg', '<svg>\n<path/>\nbroken</svg>'));
      const card = plansCard(page);
      await card.getByRole('alert').getByText('line 3').waitFor();
      assert.equal(await card.getByLabel('Name of the plan').inputValue(), 'Ground floor');
      assert.equal(house.plans.length, 0);
      await card.getByLabel('File', { exact: true }).setInputFiles(file('plan', '<svg>'));
      await card.getByText('does not say what kind of plan').waitFor();
      assert.equal(await card.getByRole('button', { name: 'Upload the plan' }).isDisabled(), true);
      await card.getByLabel('File', { exact: true }).setInputFiles(file('house.svg', '<svg></svg>'));
      await card.getByLabel('Metres in a unit of the file').fill('0.01');
      await card.getByRole('button', { name: 'Upload the plan' }).click();
      await card.getByText('16 lines').waitFor();
      assert.equal(house.plans[0].versions[0].metres_per_unit, 0.01);
      await card.getByLabel('Name of the plan').fill('In space');
      const add = page.getByRole('form', { name: 'Add a floor plan' });
      await add.getByLabel('File', { exact: true }).setInputFiles(file('house.wrl', '#VRML V2.0 utf8'));
      await add.getByLabel('Metres in a unit of the file').fill('');
      await add.getByLabel('Which axis points up').selectOption('y');
      await add.getByRole('button', { name: 'Upload the plan' }).click();
      await card.getByText('In space', { exact: true }).first().waitFor();
      const [version] = house.plans[1].versions;
      assert.deepEqual([version.format, version.metres_per_unit, version.up], ['wrl', null, 'y']);
    }),
  ],
  [
    'plans are renamed, get versions, and go when no map lies on them',
    withPlan(async (page, house) => {
      await tab(page, 'Tours');
      const card = plansCard(page);
      await card.getByText('Under Ground floor').waitFor();
      await card.getByText('Change').click();
      await card.getByLabel('Name', { exact: true }).fill('Annex');
      await card.getByRole('button', { name: 'Rename' }).click();
      await card.getByText('Annex', { exact: true }).first().waitFor();
      await card.getByLabel('Another version of it').setInputFiles(file('b.svg', '<svg></svg>'));
      await card.getByRole('button', { name: 'Upload this version' }).click();
      await card.getByText('Version 2').waitFor();
      await card.getByRole('button', { name: 'Remove Annex' }).click();
      await card
        .getByRole('group', { name: 'Remove this plan?' })
        .getByRole('button', { name: 'Remove' })
        .click();
      await card.getByText('is tied to this plan').waitFor();
      await page.goto('/map/m1/plan');
      await page.getByRole('button', { name: 'Go on to version 2 of the plan' }).click();
      await page.getByRole('group', { name: 'Living room' }).waitFor();
      await page.getByRole('button', { name: 'Save', exact: true }).click();
      await page.getByText('The chair is in the hall.').waitFor();
      assert.equal(house.ties.get('m1').version, 2);
      await page.getByRole('button', { name: 'Take the map off this plan' }).click();
      await page
        .getByRole('group', { name: /^Take the map off the plan/ })
        .getByRole('button', { name: 'Take the map off' })
        .click();
      await page.getByText('This map lies on no floor plan yet').waitFor();
      await tab(page, 'Tours');
      await card.getByRole('button', { name: 'Remove Annex' }).click();
      await card
        .getByRole('group', { name: 'Remove this plan?' })
        .getByRole('button', { name: 'Remove' })
        .click();
      await card.getByText('There is no plan of the building yet.').waitFor();
    }),
  ],
  [
    'whoever drives sees the chair and its way on the plan, and changes nothing',
    withPlan(
      async (page, house) => {
        const small = page.getByRole('region', { name: 'Floor plan' });
        await small.getByRole('img', { name: /The chair is in the hall/ }).waitFor();
        assert.equal(await sign(page, 'goal').count(), 0);
        const { width, height } = await paper(page).boundingBox();
        assert.ok(Math.abs(width / height - 1) < 0.02, `a square house is drawn ${width} by ${height}`);
        const goals = await page.getByRole('region', { name: 'Places to go to' }).boundingBox();
        const [card, drawn] = [await small.boundingBox(), await paper(page).boundingBox()];
        assert.ok(card.y >= goals.y + goals.height, 'it keeps nobody from the places to go to');
        assert.ok(Math.abs(drawn.x + drawn.width / 2 - card.x - card.width / 2) < 2, 'it is centred');
        const before = await shareOf(page, sign(page, 'chair'));
        await page.getByRole('button', { name: /Kitchen/ }).click();
        await small.getByRole('img', { name: /It goes to Kitchen/ }).waitFor();
        assert.equal(await sign(page, 'goal').count(), 1);
        assert.equal(await paper(page).locator('.way').count(), 1);
        house.steer({ do: 'go_on' });
        await small.getByRole('img', { name: /The chair is in the kitchen/ }).waitFor();
        const after = await shareOf(page, sign(page, 'chair'));
        assert.ok(after.x - before.x > 0.15 && before.y - after.y > 0.3, JSON.stringify([before, after]));
        await page.goto('/map/m1/plan');
        await page.getByText('The chair is in the kitchen.').waitFor();
        assert.equal(await page.getByRole('button', { name: 'Change where places lie' }).count(), 0);
        await tab(page, 'Tours');
        await plansCard(page).getByText('Ground floor', { exact: true }).waitFor();
        assert.equal(
          await plansCard(page)
            .getByRole('button', { name: /Remove/ })
            .count(),
          0,
        );
      },
      { name: 'ben' },
    ),
  ],
  [
    'the plan says by itself where the chair is, and that it disagrees, while it says anything',
    withPlan(
      async (page, house) => {
        const small = page.getByRole('region', { name: 'Floor plan' });
        await small.getByRole('img', { name: /The chair is in the hall/ }).waitFor();
        const cloud = paper(page).locator('.cloud');
        const nothing = async () => [await cloud.count(), await sign(page, 'arrow').count()];
        assert.deepEqual(await nothing(), [0, 0], 'nothing was told of it');
        assert.equal(await small.getByRole('list', { name: 'Signs of the floor plan' }).count(), 0);
        tellOnPlan(house, { x_m: 4, y_m: 6, theta_rad: 0, lost: 'searching' });
        await small.getByText('Not found on the plan yet').waitFor();
        await small.getByRole('img', { name: /Not found on the plan yet/ }).waitFor();
        assert.deepEqual(await nothing(), [1, 0], 'no arrow of one that was not found');
        assert.equal((await cloud.getAttribute('d')).split('M').length - 1, 200);
        tellOnPlan(house, { x_m: 1.2, y_m: 7.5, theta_rad: Math.PI / 2, word: 'possible' });
        await small.getByText('The walls of the plan agree').waitFor();
        const chair = await shareOf(page, sign(page, 'chair'));
        const arrow = await shareOf(page, sign(page, 'arrow'));
        assert.ok(Math.hypot(chair.x - arrow.x, chair.y - arrow.y) < 0.01, JSON.stringify([chair, arrow]));
        const turn = await sign(page, 'arrow').locator('path').getAttribute('transform');
        assert.equal(turn, 'rotate(-90)', 'a chair that faces up is drawn so');
        await small.getByText('Where the walls of the plan have it').waitFor();
        tellOnPlan(house, { x_m: 12, y_m: 7.5, theta_rad: 0, word: 'impossible' });
        await small.getByRole('status').getByText('The plan disagrees: by its walls').waitFor();
        await small.getByText('the chair is not in the hall').waitFor();
        let off = arrow;
        for (let i = 0; i < 40 && off.x - arrow.x <= 0.5; i += 1) {
          await page.waitForTimeout(50); // a sign stands where it stood for a frame longer
          off = await shareOf(page, sign(page, 'arrow'));
        }
        assert.ok(off.x - arrow.x > 0.5, JSON.stringify([chair, arrow, off]));
        await small.getByText('The plan disagrees').waitFor({ state: 'detached', timeout: 15_000 });
        assert.deepEqual(await nothing(), [0, 0], 'what was told some seconds ago is not of now');
        tellOnPlan(house, { x_m: 1.2, y_m: 7.5, theta_rad: 0, word: 'possible' });
        await sign(page, 'arrow').waitFor();
        house.steer({ do: 'robot', set: { online: false } });
        await sign(page, 'arrow').waitFor({ state: 'detached' });
      },
      { name: 'vera' },
    ),
  ],
  [
    'other windows follow when a map is laid on a plan or taken off it',
    withPlan(async (page, house, mock) => {
      await page.getByRole('region', { name: 'Floor plan' }).waitFor();
      const other = await page.context().newPage();
      await other.goto(`${mock.url}/map/m1/plan`);
      await other.getByRole('button', { name: 'Take the map off this plan' }).click();
      await other
        .getByRole('group', { name: /^Take the map off the plan/ })
        .getByRole('button', { name: 'Take the map off' })
        .click();
      await page.getByRole('region', { name: 'Floor plan' }).waitFor({ state: 'detached' });
      assert.equal(house.maps[0].plan, null);
    }),
  ],
  [
    'plans at every width and in light and dark are accessible and fit',
    inEveryLook(withHouse, out, async (page, house, see) => {
      tied(house);
      await page.reload();
      const small = page.getByRole('region', { name: 'Floor plan' });
      await small.waitFor();
      await page.getByRole('button', { name: /Kitchen/ }).click();
      await small.getByRole('img', { name: /It goes to Kitchen/ }).waitFor();
      await small.evaluate((one) => one.scrollIntoView({ block: 'center' }));
      await see('plan-go');
      const told = async (what, words, name) => {
        tellOnPlan(house, what);
        await page.getByText(words).waitFor();
        await see(name);
      };
      await told(
        { x_m: 5, y_m: 7, theta_rad: 0, lost: 'ambiguous' },
        /Not found on the plan/,
        'plan-go-searching',
      );
      await told(
        { x_m: 2.2, y_m: 7.6, theta_rad: 0.4, word: 'possible' },
        /walls of the plan agree/,
        'plan-go-agrees',
      );
      await told(
        { x_m: 9.9, y_m: 12, theta_rad: 2, word: 'impossible' },
        /The plan disagrees/,
        'plan-go-disagrees',
      );
      await page.goto('/map/m1/plan');
      await page.getByText('The chair is in the hall. It goes to Kitchen.').waitFor();
      await see('plan-map');
      await told(
        { x_m: 9.9, y_m: 12, theta_rad: 2, word: 'impossible' },
        /The plan disagrees/,
        'plan-map-disagrees',
      );
      await page.getByRole('button', { name: 'Change where places lie' }).click();
      await page.getByRole('group', { name: 'Living room' }).waitFor();
      await page.getByRole('button', { name: 'Enlarge' }).click();
      await see('plan-pins');
      await page.getByRole('heading', { name: 'Pinned places' }).evaluate((one) => one.scrollIntoView());
      await see('plan-pin-numbers');
      await tab(page, 'Tours');
      await plansCard(page).getByText('Change').click();
      await plansCard(page).evaluate((one) => one.scrollIntoView());
      await see('plan-list');
    }),
  ],
];

const wanted = process.argv[3] ?? '';
await runChecks(checks.filter(([name]) => name.includes(wanted)));
await browser.close();
process.stdout.write(`screenshots: ${out}\n`);
