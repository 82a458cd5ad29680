// SPDX-License-Identifier: Apache-2.0
// A chair on the building's plan against a running server: uploads the plan, ties the map to it where the tour's pictures were
// taken, says where the chair is, sends it somewhere, and compares the arrow on the plan with the truth of the simulator on the
// way and at its end. Pictures, wide and on a phone, are left in DIR.
// Usage: node tests/browser/plan_pose_test.mjs --base URL --name N --password P --plan FILE --poses FILE --truth FILE
//        --destination LABEL --out DIR
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import { findings, kPhone, kWide, launch, openPage, shoot, signIn, sticksOut } from './browser.mjs';

const kPatienceMs = 120_000;
const kArrivalMs = 240_000;
const kNear_m = 0.5; // of the truth; it is 0.2 m and less as a rule (docs/experiments/plan_localisation.md)
const kOld_s = 10; // so old may a pose on the page be on a busy machine while the chair drives on
const kStandsMs = 30_000; // after which the page has the chair where it stands

const options = ['base', 'name', 'password', 'plan', 'poses', 'truth', 'destination', 'out'];
const { values } = parseArgs({
  options: Object.fromEntries(options.map((key) => [key, { type: 'string' }])),
});
for (const key of options) if (!values[key]) throw new Error(`--${key} is missing`);

const begun = performance.now();
const say = (text) => process.stdout.write(`${((performance.now() - begun) / 1000).toFixed(1)} s  ${text}\n`);

const small = (page) => page.getByRole('region', { name: 'Floor plan', exact: true });
const paper = (page) => small(page).getByTestId('floor-plan');
const arrow = (page) => paper(page).locator('[data-kind=arrow]');

/** The robot's REST calls are of this page: signed in as it is. */
const call = (page, method, path, body) =>
  page.evaluate(
    async ([method, path, body]) => {
      const answer = await fetch(`/api/v1${path}`, {
        method,
        headers: { 'Content-Type': 'application/json', 'Idempotency-Key': String(Math.random()) },
        ...(body === undefined ? {} : { body: JSON.stringify(body) }),
      });
      if (!answer.ok) throw new Error(`${method} ${path}: ${answer.status} ${await answer.text()}`);
      return answer.json();
    },
    [method, path, body],
  );

/** Where the chair truly was, several times a second, oldest first. */
function truths() {
  const lines = readFileSync(values.truth, 'utf8').trim().split('\n');
  return lines.map((line) => JSON.parse(line));
}

/** The least that a pose is off from where the chair was of late. */
function offOfLate_m(pose) {
  const all = truths();
  const late = all.filter(({ t_us }) => t_us >= all.at(-1).t_us - kOld_s * 1e6);
  return Math.min(...late.map((one) => apart_m(pose, one)));
}

/** How far off each of these poses is from where the chair was when its picture was taken; nearest truth within a second. */
function offWhenTaken_m(poses) {
  const all = truths();
  return poses.flatMap((pose) => {
    const then = all.reduce((a, b) => (Math.abs(b.t_us - pose.t_us) < Math.abs(a.t_us - pose.t_us) ? b : a));
    return Math.abs(then.t_us - pose.t_us) < 1e6 ? [apart_m(pose, then)] : [];
  });
}

/** Where the arrow is, in metres and radians of the plan. */
async function arrowPose(page) {
  return arrow(page).evaluate((sign) => {
    const box = sign.parentElement.getBoundingClientRect();
    const at = sign.getBoundingClientRect();
    const [left, up, width, height] = sign.parentElement
      .querySelector('.floor-plan-walls')
      .getAttribute('viewBox')
      .split(' ')
      .map(Number);
    const [, turn] = /rotate\((-?\d+)\)/.exec(sign.querySelector('path').getAttribute('transform'));
    return {
      x_m: left + ((at.left - box.left) / box.width) * width,
      y_m: -(up + ((at.top - box.top) / box.height) * height),
      theta_rad: (-Number(turn) * Math.PI) / 180,
    };
  });
}

const apart_m = (a, b) => Math.hypot(a.x_m - b.x_m, a.y_m - b.y_m);
const turned_rad = (a, b) =>
  Math.abs(Math.atan2(Math.sin(a.theta_rad - b.theta_rad), Math.cos(a.theta_rad - b.theta_rad)));

async function uploadPlan(page) {
  await page.getByRole('navigation', { name: 'Pages' }).getByRole('link', { name: 'Tours' }).click();
  const card = page.getByRole('region', { name: 'Floor plans' });
  await card.getByLabel('Name of the plan').fill('House');
  await card.getByLabel('File', { exact: true }).setInputFiles(values.plan);
  await card.getByRole('button', { name: 'Upload the plan' }).click();
  await card.getByText('House', { exact: true }).first().waitFor({ timeout: kPatienceMs });
  const { plans } = await call(page, 'GET', '/plans');
  return plans[0].id;
}

/** Six places, far apart, where their pictures were taken. */
async function tie(page, plan, map) {
  const graph = await call(page, 'GET', `/maps/${map}/graph`);
  const poses = JSON.parse(readFileSync(values.poses, 'utf8'));
  const every = Math.max(1, Math.floor(graph.places.length / 6));
  const pins = graph.places
    .filter((_, i) => i % every === 0)
    .flatMap(({ id, prototype }) => {
      const pose = poses[prototype.split('/').at(-1)];
      return pose ? [{ place: id, x_m: pose[0], y_m: pose[1], theta_rad: pose[2] }] : [];
    });
  const tied = await call(page, 'PUT', `/maps/${map}/plan`, { plan, pins });
  say(`${pins.length} pins, ${tied.rms_m.toFixed(2)} m off`);
}

async function look(page, name) {
  await small(page).evaluate((one) => one.scrollIntoView({ block: 'center' }));
  await page.waitForTimeout(600);
  await shoot(page, values.out, `${name}-desktop`);
  await page.setViewportSize(kPhone);
  await small(page).evaluate((one) => one.scrollIntoView({ block: 'center' }));
  await page.waitForTimeout(600);
  await shoot(page, values.out, `${name}-phone`);
  assert.ok(!(await sticksOut(page)), `${name} can be scrolled sideways on a phone`);
  assert.deepEqual(await findings(page), [], name);
  await page.setViewportSize(kWide);
}

async function run(page) {
  await signIn(page, values.name, values.password);
  await page
    .locator('.where-words', { hasText: /^I am (in|near|somewhere)/ })
    .waitFor({ timeout: kPatienceMs });
  const [robot] = (await call(page, 'GET', '/robots')).robots;
  assert.equal(await page.locator('.floor-plan').count(), 0, 'nobody has tied a plan');
  await tie(page, await uploadPlan(page), robot.map);
  await page.getByRole('navigation', { name: 'Pages' }).getByRole('link', { name: 'Go' }).click();
  const opinion = small(page).getByTestId('plan-opinion');
  await opinion.waitFor({ timeout: kPatienceMs });
  say(await opinion.innerText());
  assert.match(await opinion.innerText(), /^Not found on the plan yet/);
  assert.equal(await arrow(page).count(), 0);
  assert.ok((await paper(page).locator('.cloud').getAttribute('d')).split('M').length > 100, 'particles');
  await look(page, 'plan-searching');

  await call(page, 'PUT', `/robots/${robot.id}/place`, { label: 'bedroom' });
  await page
    .locator('.where-words', { hasText: /^I am (in|near|somewhere)/ })
    .waitFor({ timeout: kPatienceMs });
  const goal = page
    .locator('.destination', { hasText: new RegExp(`^\\s*${values.destination}`, 'i') })
    .first();
  await goal.click();
  await arrow(page).waitFor({ timeout: kArrivalMs });
  say('the plan has found the chair');
  const journey = page.getByTestId('journey');
  let compared = 0;
  let farthest_m = 0;
  for (const until = performance.now() + kArrivalMs; performance.now() < until;) {
    const phase = await journey.getAttribute('data-phase');
    if (phase === 'arrived') break;
    assert.ok(!['failed', 'stopped', 'refused'].includes(phase), await journey.innerText());
    if ((await arrow(page).count()) === 1) {
      const off_m = offOfLate_m(await arrowPose(page));
      compared += 1;
      farthest_m = Math.max(farthest_m, off_m);
      if (compared === 8) await look(page, 'plan-driving');
    }
    await page.waitForTimeout(500);
  }
  assert.equal(await journey.getAttribute('data-phase'), 'arrived');
  const real = truths().at(-1);
  const stands = (pose) => apart_m(pose, real) < kNear_m && turned_rad(pose, real) < 0.2;
  let shown = await arrowPose(page);
  for (const until = performance.now() + kStandsMs; !stands(shown) && performance.now() < until;) {
    await page.waitForTimeout(500);
    shown = await arrowPose(page);
  }
  say(
    `arrived; the arrow was ${compared} times at most ${farthest_m.toFixed(2)} m off, and is ${apart_m(shown, real).toFixed(2)} m ` +
      `and ${turned_rad(shown, real).toFixed(2)} rad off; the page says: ${await opinion.innerText()}`,
  );
  assert.ok(compared >= 8 && farthest_m < kNear_m, 'it follows the chair');
  assert.ok(stands(shown), JSON.stringify([shown, real]));
  await look(page, 'plan-arrived');
  const [{ mission }] = (await call(page, 'GET', '/robots')).robots;
  const { poses } = await call(page, 'GET', `/robots/${robot.id}/missions/${mission.id}/plan`);
  const impossible = poses.filter(({ word }) => word === 'impossible').length;
  const off_m = offWhenTaken_m(poses.filter(({ lost }) => lost === null));
  say(
    `${poses.length} pictures of it are kept, ${impossible} of which called the place impossible; ` +
      `${off_m.length} are at most ${Math.max(...off_m).toFixed(2)} m off`,
  );
  assert.ok(off_m.length > 20 && Math.max(...off_m) < kNear_m, 'each is where its picture was taken');
  assert.ok(poses.length > 30 && poses.at(-1).x_m !== null, 'what was said of the mission is kept');
  await page.goto(`/map/${robot.map}/plan`);
  await page.locator('[data-kind=arrow]').waitFor({ timeout: kPatienceMs });
  await shoot(page, values.out, 'plan-map-page');
  await call(page, 'DELETE', `/maps/${robot.map}/plan`).catch(() => undefined); // its answer is empty
  await page.locator('[data-kind=arrow]').waitFor({ state: 'detached', timeout: kPatienceMs });
  assert.deepEqual(page.complaints, []);
}

const browser = await launch();
const page = await openPage(browser, { base: values.base });
try {
  await run(page);
} catch (thrown) {
  await shoot(page, values.out, 'failed').catch(() => undefined);
  process.stdout.write(
    `FAIL  ${thrown instanceof Error ? (thrown.stack ?? thrown.message) : String(thrown)}\n`,
  );
  process.exitCode = 1;
} finally {
  await browser.close();
  say(`screenshots: ${values.out}`);
}
