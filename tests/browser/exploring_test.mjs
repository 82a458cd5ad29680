// SPDX-License-Identifier: Apache-2.0
// A robot that maps a building by itself, in a real browser against the pretended house.
// Usage: node tests/browser/exploring_test.mjs [FOLDER FOR SCREENSHOTS [WORDS]]     after web/build.sh
import assert from 'node:assert/strict';
import { runChecks, shoot, sticksOut } from './browser.mjs';
import { inEveryLook, pretendedHouses, screenshotFolder, tab } from './house.mjs';

const out = screenshotFolder();
const { browser, withHouse } = await pretendedHouses();

const status = (page) => page.getByTestId('status');
const stage = (page, phase) => page.locator(`[data-testid=status][data-phase=${phase}]`).waitFor();
const plan = (page) => page.getByTestId('plan');
const fences = (page) => page.getByRole('region', { name: 'Fences' });
const together = (page) => page.getByRole('region', { name: 'Together with' });
const press = (scope, name) => scope.getByRole('button', { name, exact: true }).click();
const kNarrow = { width: 360, height: 780 };

async function open(page, house) {
  await tab(page, 'Robots');
  await page.getByRole('link', { name: /^Let it map a building by itself/ }).click();
  assert.equal(new URL(page.url()).pathname, `/robots/${house.robots[0].id}/explore`);
}

async function start(page, house) {
  await open(page, house);
  await press(page, 'Start: Chair maps the building');
  await stage(page, 'exploring');
}

/** Another robot, of which the page hears as of every other one. */
function addRobot(house, name) {
  const robot = house.newRobot(name, 'm1');
  house.robots.push(robot);
  house.tellRobot(robot);
  return robot;
}

/** Somebody lets it map the building from another window, and goes on watching. */
async function startElsewhere(page, house, robot) {
  const headers = { origin: new URL(page.url()).origin };
  const root = `/api/v1/robots/${robot.id}`;
  const taken = await page.request.post(`${root}/lease`, { data: { take_over: true }, headers });
  const { lease } = await taken.json();
  await page.request.post(`${root}/explorations`, { data: { lease_id: lease.id }, headers });
  watch(house, robot, 'anna');
}

function watch(house, robot, holder) {
  robot.lease = { id: 'elsewhere', holder, epoch: 7, until_ms: Date.now() + 600_000 };
  house.tellRobot(robot);
}

async function bond(page, kind, pill) {
  await page.locator(`[data-testid=together][data-bond=${kind}]`).waitFor();
  await together(page).getByText(pill, { exact: true }).waitFor();
}

const companionOf = async (page, robot) =>
  (await (await page.request.get(`/api/v1/robots/${robot.id}/exploration`)).json()).companion;

/** Until a robot knows with which one it shares; what is asked of it before that hangs on the lease of who asked. */
async function knowsItsCompanion(page, robot) {
  const until_ms = Date.now() + 30_000;
  while (!(await companionOf(page, robot))) {
    assert.ok(Date.now() < until_ms, `${robot.name} was not told with whom it shares`);
    await page.waitForTimeout(100);
  }
}

/** Until it has taken so many pictures, as the page tells. */
async function pictures(page, least) {
  await page.waitForFunction(
    (n) => Number(document.querySelector('.explore-figures dd')?.textContent) >= n,
    least,
  );
}

/** How many of the plan's pixels are other than what nothing is known of. */
const seen = (page) =>
  plan(page)
    .locator('canvas')
    .evaluate((canvas) => {
      const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      const last = data.length - 8; // in a corner
      let other = 0;
      for (let at = 0; at < data.length; at += 4)
        if ([0, 1, 2].some((n) => data[at + n] !== data[last + n])) other += 1;
      return other / (data.length / 4);
    });

async function tapCorners(page, shares) {
  const box = await plan(page).boundingBox();
  for (const [x, y] of shares) await page.mouse.click(box.x + x * box.width, box.y + y * box.height);
}

async function drawFence(page) {
  await press(fences(page), 'Draw a fence');
  await plan(page).scrollIntoViewIfNeeded();
  await tapCorners(page, [
    [0.3, 0.3],
    [0.45, 0.3],
    [0.45, 0.5],
    [0.3, 0.5],
  ]);
  await fences(page).getByText('4 corners.').waitFor();
}

const checks = [
  [
    'a robot maps a building from the start to the tour: paused, sent on, over, and a map is built of it',
    withHouse(async (page, house) => {
      await open(page, house);
      await page.getByText('Walk with it and watch it').waitFor();
      await page.getByLabel('Minutes at most').fill('soon');
      await page.getByText('Limits are numbers').waitFor();
      await page.getByLabel('Minutes at most').fill('90');
      house.stands = 2;
      await press(page, 'Start: Chair maps the building');
      await stage(page, 'exploring');
      assert.equal(house.robots[0].lease.holder, 'anna');
      await pictures(page, 2);
      const early = await seen(page);
      house.stands = 12;
      await pictures(page, 12);
      const late = await seen(page);
      assert.ok(late > 0.2 && late !== early, `the plan does not grow: ${early}, ${late}`);
      const words = /^Plan of the building\. Chair maps the building by itself\. 12 pictures, .* m driven/;
      await page.getByRole('img', { name: words }).waitFor();
      await press(status(page), 'Pause');
      await stage(page, 'paused');
      await status(page).getByText('Stopped by anna.').waitFor();
      house.steer({ do: 'go_on' });
      await press(status(page), 'Go on');
      await stage(page, 'exploring');
      await stage(page, 'ended');
      await status(page).getByRole('progressbar', { name: 'Pictures on the server' }).waitFor();
      await stage(page, 'uploaded');
      await status(page).getByText('I could not get to 1 place').waitFor();
      await status(page).getByRole('link', { name: 'Build a map of it' }).click();
      const { tour } = await page.request
        .get(`/api/v1/robots/${house.robots[0].id}/exploration`)
        .then((one) => one.json());
      assert.equal(new URL(page.url()).pathname, `/tours/${tour}`);
      assert.ok(await page.getByRole('checkbox', { name: /^Explored by Chair/ }).isChecked());
      await page.getByLabel('Name of the map').fill('Explored');
      await press(page, 'Build the map');
      await page.getByText('Building Explored').first().waitFor();
      assert.deepEqual(house.maps.at(-1).tours, [tour]);
    }),
  ],
  [
    'STOP and Escape pause it, its lease is kept meanwhile, and it is finished with what there is',
    withHouse(async (page, house) => {
      await start(page, house);
      await pictures(page, 3);
      const { until_ms } = house.robots[0].lease;
      await page.waitForTimeout(4500);
      assert.ok(house.robots[0].lease.until_ms > until_ms, 'the lease is kept');
      await page.keyboard.press('Escape');
      await page.getByTestId('stop-word').getByText('Chair has stopped.').waitFor();
      await stage(page, 'paused');
      await press(status(page), 'Finish with what there is now');
      await page.getByText(/^Make a tour of \d+ pictures\?/).waitFor();
      await press(status(page), 'Finish with what there is');
      await stage(page, 'uploaded');
      await status(page).getByText('It was ended with what there is.').waitFor();
      await page.getByText('Let it map a building once more').click();
      await press(page, 'Start: Chair maps the building');
      await stage(page, 'exploring');
      await pictures(page, 1);
    }),
  ],
  [
    'a fence is drawn by taps, kept by the robot, and removed',
    withHouse(async (page, house) => {
      await start(page, house);
      await pictures(page, 8);
      await press(status(page), 'Pause');
      await stage(page, 'paused');
      await drawFence(page);
      await shoot(page, out, 'fence-drawn');
      await press(fences(page), 'Take the last corner back');
      await fences(page).getByText('3 corners.').waitFor();
      await press(fences(page), 'Close the fence');
      await fences(page).getByText('Fence 1').waitFor();
      await fences(page)
        .getByText(/^3 corners, /)
        .waitFor();
      const told = async () =>
        (await (await page.request.get(`/api/v1/robots/${house.robots[0].id}/exploration`)).json()).fences;
      assert.equal((await told())[0].length, 3);
      await press(fences(page), 'Remove fence 1');
      await fences(page).getByRole('group').getByRole('button', { name: 'Remove', exact: true }).click();
      await fences(page).getByText('Fence 1').waitFor({ state: 'detached' });
      assert.deepEqual(await told(), []);
    }),
  ],
  [
    'a fence is made by keyboard alone: where the robot stands, and from numbers',
    withHouse(async (page, house) => {
      await start(page, house);
      await pictures(page, 2);
      await fences(page).getByRole('button', { name: 'Draw a fence' }).focus();
      await page.keyboard.press('Enter');
      await page.waitForFunction(() => document.activeElement?.textContent === 'A new fence');
      await fences(page).getByRole('button', { name: 'Corner where the robot stands' }).focus();
      await page.keyboard.press('Enter');
      await fences(page).getByText('1 corner.').waitFor();
      for (const [x, y] of [
        ['2', '−1'],
        ['2,5', '1'],
      ]) {
        await fences(page).getByLabel('x in metres').focus();
        await page.keyboard.type(x);
        await page.keyboard.press('Tab');
        await page.keyboard.type(y);
        await page.keyboard.press('Enter');
      }
      await fences(page).getByText('x 2.5 m, y 1.0 m').waitFor();
      await fences(page).getByRole('button', { name: 'Close the fence' }).focus();
      await page.keyboard.press('Enter');
      await fences(page).getByText('Fence 1').waitFor();
      await page.waitForFunction(() => document.activeElement?.textContent === 'Draw a fence');
      const { fences: told } = await page.request
        .get(`/api/v1/robots/${house.robots[0].id}/exploration`)
        .then((one) => one.json());
      assert.deepEqual(told[0].slice(1), [
        [2, -1],
        [2.5, 1],
      ]);
    }),
  ],
  [
    'the plan moves and grows by buttons, wheel and drag, and shows all again',
    withHouse(async (page, house) => {
      await start(page, house);
      await pictures(page, 12);
      const group = page.locator('.explore-plan');
      const all = group.getByRole('button', { name: 'Show all' });
      const fits = async (wanted) =>
        page.waitForFunction(
          (want) =>
            document.querySelector('.plan-buttons [aria-pressed]')?.getAttribute('aria-pressed') === want,
          String(wanted),
        );
      await fits(true);
      const before = await seen(page);
      await press(group, 'Enlarge');
      await fits(false);
      assert.ok((await seen(page)) > before, 'it did not grow');
      await all.click();
      await fits(true);
      await press(group, 'Look further left');
      await fits(false);
      await all.click();
      const box = await plan(page).boundingBox();
      await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
      await page.mouse.wheel(0, -300);
      await fits(false);
      await all.click();
      await page.mouse.move(box.x + 100, box.y + 100);
      await page.mouse.down();
      await page.mouse.move(box.x + 160, box.y + 130, { steps: 4 });
      await page.mouse.up();
      await fits(false);
    }),
  ],
  [
    'two robots map the building together: chosen once for both, joined, not heard of, and each by itself again',
    withHouse(async (page, house) => {
      house.stands = 2;
      await start(page, house);
      assert.equal(await together(page).count(), 0, 'there is no other robot');
      const bruno = addRobot(house, 'Bruno');
      await together(page).getByText('No other robot maps the building now.').waitFor();
      await startElsewhere(page, house, bruno);
      await together(page).getByText('Maps the building, 2 pictures.').waitFor();
      await press(together(page), 'Map together with Bruno');
      await together(page)
        .getByText(/^Sent\. \w+ has not said yet that it knows\.$/)
        .waitFor();
      await bond(page, 'looking', 'Not joined yet');
      await together(page).getByText('Chair has 2 pictures of Bruno').waitFor();
      assert.ok(await companionOf(page, bruno), 'Bruno was told as well');
      watch(house, bruno, 'anna');
      house.stands = 8;
      await bond(page, 'joined', 'Joined');
      await page.getByRole('heading', { name: 'Together with Bruno' }).waitFor();
      await together(page).getByText('It has 8 pictures of it').waitFor();
      bruno.online = false;
      house.tellRobot(bruno);
      await bond(page, 'silent', 'Not heard of');
      await together(page).getByText('Nothing is heard of Bruno.').waitFor();
      bruno.online = true;
      house.tellRobot(bruno);
      await bond(page, 'joined', 'Joined');
      await press(together(page), 'Each by itself again');
      await together(page).getByText('Two robots at once').waitFor();
      assert.deepEqual(
        [await companionOf(page, house.robots[0]), await companionOf(page, bruno)],
        [null, null],
      );
    }),
  ],
  [
    'a robot that somebody else drives is not taken from them: the page says what is left to do, and does it later',
    withHouse(async (page, house) => {
      await start(page, house);
      const bruno = addRobot(house, 'Bruno');
      await startElsewhere(page, house, bruno);
      watch(house, bruno, 'ben');
      await press(together(page), 'Map together with Bruno');
      await bond(page, 'one_sided', 'Half done');
      await together(page)
        .getByText(/^ben is driving Bruno: ask ben to choose Chair/)
        .waitFor();
      assert.equal(bruno.lease.holder, 'ben');
      assert.equal(await together(page).getByRole('button', { name: 'Tell Bruno too' }).count(), 0);
      await together(page).getByRole('link', { name: 'To the page of Bruno' }).click();
      assert.equal(new URL(page.url()).pathname, `/robots/${bruno.id}/explore`);
      await together(page).getByText('shares with this one already').waitFor();
      await pictures(page, 4); // from so many on they can be joined; it may stop while nobody drives it
      await page.goBack();
      bruno.lease = null;
      house.tellRobot(bruno);
      await press(together(page), 'Tell Bruno too');
      await knowsItsCompanion(page, bruno);
      watch(house, bruno, 'anna');
      await bond(page, 'joined', 'Joined');
    }),
  ],
  [
    'somebody else who drives is asked about, and a robot that is not connected is not started',
    withHouse(async (page, house) => {
      house.steer({ do: 'hold', holder: 'ben' });
      await open(page, house);
      await page.getByText('ben is driving Chair.').waitFor();
      await press(page, 'Start: Chair maps the building');
      await page.getByText('ben is driving Chair just now.').waitFor();
      assert.equal(house.robots[0].mission, null);
      await press(page, 'Take over');
      await stage(page, 'exploring');
      await press(status(page), 'Pause');
      await stage(page, 'paused');
      house.steer({ do: 'robot', set: { online: false } });
      await status(page).getByText('Chair is not connected, so it cannot be told anything.').waitFor();
      assert.ok(await status(page).getByRole('button', { name: 'Go on' }).isDisabled());
    }),
  ],
  [
    'Go says that the robot maps the building, offers no place, and STOP works there',
    withHouse(async (page, house) => {
      await start(page, house);
      await tab(page, 'Go');
      const journey = page.getByTestId('journey');
      await journey.getByText('Maps the building by itself').waitFor();
      await page.getByText('Chair maps the building by itself. Stop it before you send it.').waitFor();
      const kitchen = page.locator('.destination', { hasText: 'Kitchen' });
      assert.equal(await kitchen.getAttribute('aria-disabled'), 'true');
      await page.waitForTimeout(300);
      await shoot(page, out, 'go-while-exploring');
      await tab(page, 'Robots');
      await page.getByText('Maps the building by itself').waitFor();
      await shoot(page, out, 'robots-while-exploring');
      await tab(page, 'Go');
      await page.keyboard.press('Escape');
      await journey.getByText('Mapping the building was paused').waitFor();
      await kitchen.click();
      await journey.getByText('On the way to Kitchen').waitFor();
      await page.goBack();
      await tab(page, 'Tours');
      await page.getByRole('link', { name: 'With Chair' }).click();
      await status(page).getByText('Chair is on its way to a place. Stop it first.').waitFor();
    }),
  ],
  [
    'who may only look watches, and has nothing to press but STOP',
    withHouse(
      async (page, house) => {
        const [robot] = house.robots;
        await page.goto(`/robots/${robot.id}/explore`);
        await page.getByText('Somebody who may install things starts it.').waitFor();
        assert.equal(await page.getByRole('button', { name: /^Start/ }).count(), 0);
        const anna = await page
          .context()
          .browser()
          .newContext({ baseURL: new URL(page.url()).origin });
        const origin = new URL(page.url()).origin;
        const ask = async (path, data) => {
          const answer = await anna.request.post(`/api/v1/${path}`, { data, headers: { origin } });
          return answer.json();
        };
        await ask('login', { name: 'anna', password: 'homeward' });
        const { lease } = await ask(`robots/${robot.id}/lease`, {});
        await ask(`robots/${robot.id}/explorations`, { lease_id: lease.id });
        await stage(page, 'exploring');
        await pictures(page, 2);
        assert.equal(await status(page).getByRole('button').count(), 0);
        await shoot(page, out, 'viewer');
        await page.reload(); // what was told before is asked for
        await pictures(page, 2);
        await page.getByRole('button', { name: /^STOP/ }).click();
        await stage(page, 'paused');
        assert.equal(await status(page).getByRole('button').count(), 0);
        await anna.close();
      },
      { name: 'vera' },
    ),
  ],
  [
    'at 360 pixels nothing has to be scrolled sideways',
    withHouse(
      async (page, house) => {
        const all = [];
        const see = async (name) => {
          await page.waitForTimeout(300);
          await shoot(page, out, `narrow-${name}`);
          if (await sticksOut(page)) all.push(name);
        };
        await open(page, house);
        await see('intro');
        await press(page, 'Start: Chair maps the building');
        await pictures(page, 12);
        await see('exploring');
        await press(status(page), 'Pause');
        await stage(page, 'paused');
        await status(page).getByText('Limits for going on').click();
        await see('paused');
        await drawFence(page);
        await see('drawing');
        await press(fences(page), 'Close the fence');
        const bruno = addRobot(house, 'Bruno with a name that is long');
        await startElsewhere(page, house, bruno);
        await together(page).scrollIntoViewIfNeeded();
        await see('offers');
        watch(house, bruno, 'ben');
        await press(together(page), `Map together with ${bruno.name}`);
        await bond(page, 'one_sided', 'Half done');
        await see('half');
        watch(house, bruno, 'anna');
        await press(together(page), `Tell ${bruno.name} too`);
        watch(house, bruno, 'anna');
        await bond(page, 'joined', 'Joined');
        await see('joined');
        await press(fences(page), 'Remove fence 1');
        await see('fences');
        await press(fences(page), 'Keep');
        await press(status(page), 'Finish with what there is now');
        await see('finish');
        assert.deepEqual(all, []);
      },
      { size: kNarrow },
    ),
  ],
  [
    'an exploration at every width and in light and dark is accessible and fits',
    inEveryLook(withHouse, out, async (page, house, see) => {
      await tab(page, 'Tours');
      await page.getByRole('heading', { name: 'Let a robot map a building by itself' }).waitFor();
      await see('explore-tours');
      await open(page, house);
      await see('explore-intro');
      await press(page, 'Start: Chair maps the building');
      await pictures(page, 12);
      await see('explore-watching');
      await drawFence(page);
      await see('explore-drawing');
      await press(fences(page), 'Close the fence');
      await fences(page).getByText('Fence 1').waitFor();
      house.steer({ do: 'go_on' });
      await pictures(page, 30);
      await press(status(page), 'Pause');
      await stage(page, 'paused');
      await page.evaluate(() => scrollTo(0, 0));
      await see('explore-paused');
      await plan(page).scrollIntoViewIfNeeded();
      await see('explore-plan');
      await press(status(page), 'Finish with what there is now');
      await press(status(page), 'Finish with what there is');
      await stage(page, 'uploaded');
      await page.evaluate(() => scrollTo(0, 0));
      await see('explore-uploaded');
    }),
  ],
  [
    'two robots together at every width and in light and dark are accessible and fit',
    inEveryLook(withHouse, out, async (page, house, see) => {
      house.stands = 3;
      await start(page, house);
      await pictures(page, 3);
      const bruno = addRobot(house, 'Bruno');
      const look = async (name) => {
        await together(page).scrollIntoViewIfNeeded();
        await see(`explore-together-${name}`);
      };
      await startElsewhere(page, house, bruno);
      await together(page).getByText('Maps the building, 3 pictures.').waitFor();
      await look('offers');
      watch(house, bruno, 'ben');
      await press(together(page), 'Map together with Bruno');
      await bond(page, 'one_sided', 'Half done');
      await look('half');
      watch(house, bruno, 'anna');
      await press(together(page), 'Tell Bruno too');
      watch(house, bruno, 'anna');
      await bond(page, 'looking', 'Not joined yet');
      house.stands = 12;
      await bond(page, 'joined', 'Joined');
      await together(page).getByText('It has 12 pictures of it').waitFor();
      await look('joined');
    }),
  ],
];

const wanted = process.argv[3] ?? '';
await runChecks(checks.filter(([name]) => name.includes(wanted)));
await browser.close();
process.stdout.write(`screenshots: ${out}\n`);
