// SPDX-License-Identifier: Apache-2.0
// The dashboard in a real browser against the pretended house of web/dev/mock-server.mjs.
// Usage: node tests/browser/mock_test.mjs [FOLDER FOR SCREENSHOTS [WORDS]]     after web/build.sh; WORDS: only checks that
// have them in their name
import assert from 'node:assert/strict';
import { mkdtempSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { largeGraph } from '../../web/dev/mock-large.mjs';
import { kCamera } from '../../web/dev/mock-server.mjs';
import { findings, kPhone, kWide, openPage, runChecks, shoot, signIn, sticksOut } from './browser.mjs';
import { inEveryLook, pretendedHouses, screenshotFolder, tab } from './house.mjs';

const out = screenshotFolder();
const { browser, withHouse } = await pretendedHouses();

const journey = (page) => page.getByTestId('journey');
const destination = (page, name) => page.locator('.destination', { hasText: name });

const question = (page) => page.getByTestId('question');

/** Sends the chair, which comes to stand and asks whether it is there. */
async function askAt(page, house, name) {
  await destination(page, name).click();
  await phaseIs(page, 'driving');
  house.steer({ do: 'ask' });
  await question(page).waitFor();
}

async function phaseIs(page, phase) {
  await page.locator(`[data-testid=journey][data-phase=${phase}]`).waitFor();
}

/** The share of the viewport that STOP and what stays in view with it take. */
function dockShare(page) {
  return page.evaluate(() => {
    const rail = document.querySelector('.rail');
    const stays = getComputedStyle(rail).position === 'static' ? rail.querySelector('.stop-dock') : rail;
    const { width, height } = stays.getBoundingClientRect();
    return (width * height) / (innerWidth * innerHeight);
  });
}

const checks = [
  [
    'a wrong password is told, the right one signs in, and signing out ends it',
    withHouse(
      async (page) => {
        await page.goto('/');
        await page.getByLabel('Your name').fill('anna');
        await page.getByLabel('Password').fill('wrong');
        await page.getByRole('button', { name: 'Sign in' }).click();
        await page.getByText('The name or the password is not right.').waitFor();
        await signIn(page, 'anna', 'homeward');
        await tab(page, 'Settings');
        await page.getByRole('button', { name: 'Sign out' }).click();
        await page.getByRole('heading', { name: 'Sign in' }).waitFor();
      },
      { name: null },
    ),
  ],
  [
    'the set-up link makes the first account',
    withHouse(
      async (page, house) => {
        await page.goto('/setup#first');
        await page.getByLabel('Your name').fill('olga');
        await page.getByLabel('Password', { exact: true }).fill('long enough');
        await page.getByLabel('Password again').fill('long enough');
        assert.deepEqual(await findings(page), []);
        await page.getByRole('button', { name: 'Make the account' }).click();
        await page.getByRole('heading', { name: 'Robots', exact: true }).waitFor();
        assert.deepEqual(
          house.users.map((one) => [one.name, one.role]),
          [['olga', 'admin']],
        );
      },
      { name: null, fresh: true },
    ),
  ],
  [
    'a set-up link that is not valid any more says what to do',
    withHouse(
      async (page) => {
        await page.goto('/setup#second');
        await page.getByLabel('Your name').fill('olga');
        await page.getByLabel('Password', { exact: true }).fill('long enough');
        await page.getByLabel('Password again').fill('long enough');
        await page.getByRole('button', { name: 'Make the account' }).click();
        await page.getByText('Use the newest one that the server printed.').waitFor();
      },
      { name: null, fresh: true },
    ),
  ],
  [
    'a press on a destination drives there and tells the arrival',
    withHouse(async (page, house) => {
      await destination(page, 'Kitchen').click();
      await phaseIs(page, 'driving');
      await journey(page).getByText('On the way to Kitchen').waitFor();
      await page.getByRole('progressbar').waitFor();
      house.steer({ do: 'go_on' });
      await phaseIs(page, 'arrived');
      await journey(page).getByText('Arrived: Kitchen').waitFor();
      await page.getByText('I am in the kitchen.').waitFor();
      assert.equal(house.robots[0].lease.holder, 'anna');
    }),
  ],
  [
    'STOP by press and by Escape stops the chair and says that it stands',
    withHouse(async (page, house) => {
      for (const press of [
        () => page.getByRole('button', { name: /^STOP/ }).click(),
        () => page.keyboard.press('Escape'),
      ]) {
        house.robots[0].belief.place = 'p1';
        await destination(page, 'Living room').click();
        await phaseIs(page, 'driving');
        await press();
        await page.getByTestId('stop-word').getByText('Chair has stopped.').waitFor();
        await phaseIs(page, 'stopped');
        await journey(page).getByText('Stopped by Anna.').waitFor();
        assert.equal(house.robots[0].state, 'stopped');
      }
    }),
  ],
  [
    'STOP is on every page, in view, and a viewer may press it but not drive',
    withHouse(
      async (page, house) => {
        await page.getByText('Your account may look and may stop the chair, but not send it.').waitFor();
        await destination(page, 'Kitchen').click({ force: true });
        assert.equal(house.robots[0].mission, null);
        for (const name of ['Map', 'Tours', 'Robots', 'Settings', 'Go']) {
          await tab(page, name);
          const box = await page.getByRole('button', { name: /^STOP/ }).boundingBox();
          assert.ok(
            box && box.y >= 0 && box.y + box.height <= kPhone.height,
            `STOP is out of view on ${name}`,
          );
          assert.ok(box.width >= 200 && box.height >= 80, `STOP is small on ${name}`);
        }
        for (const size of [
          kWide,
          { width: 844, height: 390 },
          { width: 640, height: 400 },
          { width: 320, height: 568 },
          { width: 375, height: 540 },
          { width: 320, height: 320 },
        ]) {
          await page.setViewportSize(size);
          await page.waitForTimeout(200); // dynamic viewport units follow a little later
          const box = await page.getByRole('button', { name: /^STOP/ }).boundingBox();
          const name = `${size.width} x ${size.height}`;
          assert.ok(box && box.y >= 0 && box.y + box.height <= size.height, `STOP is out of view at ${name}`);
          assert.ok(
            box.width >= 200 && box.height >= Math.min(64, size.height / 6),
            `STOP is small at ${name}`,
          );
          assert.ok(!(await sticksOut(page)), `the page is wider than ${name}`);
          const share = await dockShare(page);
          assert.ok(size.height > 600 || share <= 0.25, `what stays in view takes ${share} of ${name}`);
          await shoot(page, out, `size-${size.width}x${size.height}`);
        }
        await page.getByRole('button', { name: /^STOP/ }).click();
        await page.getByTestId('stop-word').getByText('Chair has stopped.').waitFor();
      },
      { name: 'vera', size: kPhone },
    ),
  ],
  [
    'without the server the page says so, and STOP sends the rider to the button on the chair',
    withHouse(async (page, house) => {
      house.steer({ do: 'unreachable', on: true });
      await page.getByText('The house server cannot be reached.').waitFor();
      await page.getByText('The house server is out of reach, so the chair cannot be sent.').waitFor();
      await page.keyboard.press('Escape');
      await page.getByTestId('stop-word').getByText('Use the stop button on the chair!').waitFor();
      await shoot(page, out, 'unreachable');
      house.steer({ do: 'unreachable', on: false });
      await page.getByTestId('stop-word').getByText('Chair has stopped.').waitFor();
      await page
        .getByText('The house server cannot be reached.')
        .waitFor({ state: 'detached', timeout: 20_000 });
    }),
  ],
  [
    'a server that falls silent is noticed, as is a STOP that nobody hears, and both end', // how soon: silence_test.mjs
    withHouse(async (page, house) => {
      const stopWord = page.getByTestId('stop-word');
      const silence = page.getByText('The house server cannot be reached.');
      await destination(page, 'Living room').click();
      await phaseIs(page, 'driving');
      house.steer({ do: 'silent', on: true });
      await page.keyboard.press('Escape');
      await stopWord.getByText('STOP was not heard').waitFor();
      await stopWord.getByText('Use the stop button on the chair!').waitFor();
      await silence.waitFor();
      await page.getByText(/^What you see is \d+ s old\.$/).waitFor();
      await page
        .locator('.where')
        .getByText(/^Last heard \d s ago\.$/)
        .waitFor();
      await page.getByText('The house server is out of reach, so the chair cannot be sent.').waitFor();
      assert.equal(await destination(page, 'Kitchen').getAttribute('aria-disabled'), 'true');
      await shoot(page, out, 'silent');
      await page.setViewportSize(kPhone);
      await page.waitForTimeout(300);
      await shoot(page, out, 'silent-phone');
      assert.ok(!(await sticksOut(page)), 'the page is wider than a phone');
      await page.setViewportSize(kWide);
      // Long enough for more than one attempt to reach the server, none of which is heard.
      await page.waitForTimeout(7000);
      await stopWord.getByText('STOP was not heard').waitFor();
      house.steer({ do: 'silent', on: false });
      await stopWord.getByText('Chair has stopped.').waitFor();
      await silence.waitFor({ state: 'detached' });
      await page.waitForTimeout(1000); // what was asked for meanwhile is heard now too
      // No alarm is left for the next drive.
      await destination(page, 'Kitchen').click();
      await phaseIs(page, 'driving');
      await page.waitForTimeout(5000);
      assert.equal(await page.locator('.stop-word.bad').count(), 0);
    }),
  ],
  [
    'a chair that arrived while the server was silent ends the alarm of a STOP that nobody heard',
    withHouse(async (page, house) => {
      await destination(page, 'Kitchen').click();
      await phaseIs(page, 'driving');
      house.steer({ do: 'silent', on: true });
      await page.keyboard.press('Escape');
      await page.getByTestId('stop-word').getByText('STOP was not heard').waitFor();
      house.steer({ do: 'go_on' });
      for (let i = 0; i < 100 && house.robots[0].mission.state !== 'arrived'; i += 1)
        await page.waitForTimeout(50);
      assert.equal(house.robots[0].mission.state, 'arrived');
      house.steer({ do: 'silent', on: false });
      await phaseIs(page, 'arrived');
      await page.locator('.stop-word.bad').waitFor({ state: 'detached' });
    }),
  ],
  [
    'a chair that does not know where it is says so, and a refusal gives its reason',
    withHouse(async (page, house) => {
      house.steer({
        do: 'robot',
        set: { belief: { updates: 3, place: null, probability: null, top: [], lost: true } },
      });
      await page.getByText('I am not sure where I am.').waitFor();
      await destination(page, 'Kitchen').click();
      await phaseIs(page, 'refused');
      await journey(page).getByText('The robot does not know where it is.').waitFor();
    }),
  ],
  [
    'a chair that is not sure where it is can be sent, and says that it looks around first',
    withHouse(async (page, house) => {
      const belief = {
        updates: 3,
        place: 'p1',
        probability: 0.2,
        top: [{ place: 'p1', probability: 0.2 }],
        lost: true,
      };
      house.steer({ do: 'robot', set: { belief } });
      await page.getByText('I am not sure where I am.').waitFor();
      await destination(page, 'Bedroom').click();
      await journey(page).getByText('The robot is not sure where it is; it looks around first.').waitFor();
      house.steer({ do: 'go_on' });
      await phaseIs(page, 'arrived');
      assert.equal(await journey(page).getByText('it looks around first').count(), 0);
    }),
  ],
  [
    'a person says by keyboard where a chair is that does not know it, and it begins there',
    withHouse(
      async (page, house) => {
        const lost = { updates: 3, place: null, probability: null, top: [], lost: true };
        house.steer({ do: 'robot', set: { belief: lost } });
        const asking = page.getByTestId('said-place');
        const offer = page.getByRole('button', { name: 'Say where Chair is' });
        await offer.focus();
        await page.keyboard.press('Enter');
        await asking.getByRole('heading', { name: 'Where is Chair?' }).waitFor();
        const here = asking.getByRole('button', { name: 'Chair is here' });
        assert.ok(await here.isDisabled(), 'nothing is chosen yet');
        assert.ok(!(await sticksOut(page)), 'the page is wider than a phone');
        assert.deepEqual(await findings(page), []);
        await page.keyboard.press('Tab');
        await page.keyboard.press('Space');
        await page.keyboard.press('ArrowDown');
        assert.ok(await asking.getByRole('radio', { name: 'Kitchen' }).isChecked());
        await shoot(page, out, 'said-place');
        house.steer({ do: 'robot', set: { online: false } });
        await asking.waitFor({ state: 'detached' }); // nobody would hear it
        house.steer({ do: 'robot', set: { online: true } });
        await offer.click();
        await asking.getByRole('button', { name: 'Cancel' }).click();
        await offer.click();
        await asking.getByRole('radio', { name: 'Kitchen' }).check();
        await here.click();
        await page.getByText('I take it that I am in the kitchen, unless I see something else.').waitFor();
        await page.getByText('I am in the kitchen.', { exact: true }).waitFor();
        assert.deepEqual(house.said, { place: 'p5', by: 'ben' });
        // Where it knows the way, it is offered quietly; what goes wrong is told.
        await page.getByRole('button', { name: 'Chair is somewhere else' }).click();
        await asking.getByRole('radio', { name: 'Bathroom' }).check();
        for (const one of [...house.graph.places, ...house.graph.destinations])
          if (one.label === 'bathroom') one.label = 'bath'; // renamed a moment ago
        await here.click();
        await asking.getByRole('alert').getByText("The map has no place called 'bathroom'.").waitFor();
        await destination(page, 'Hall').click();
        await asking.waitFor({ state: 'detached' }); // it drives
        assert.equal(await page.getByRole('button', { name: 'Chair is somewhere else' }).count(), 0);
        house.steer({ do: 'go_on' });
        await phaseIs(page, 'arrived');
      },
      { name: 'ben', size: kPhone },
    ),
  ],
  [
    'a viewer says nothing of where the chair is',
    withHouse(
      async (page) => {
        await page.getByText('I am in the hall.').waitFor();
        assert.equal(await page.getByRole('button', { name: 'Chair is somewhere else' }).count(), 0);
      },
      { name: 'vera' },
    ),
  ],
  [
    'a chair that is not certain of its destination asks, and a yes makes it arrive',
    withHouse(
      async (page, house) => {
        assert.equal(await question(page).count(), 0);
        await askAt(page, house, 'Living room');
        await question(page).getByRole('heading', { name: 'Is this the living room?' }).waitFor();
        await page.getByRole('alert').getByText('Chair asks: Is this the living room?').waitFor();
        await question(page).getByText('60 s more').waitFor();
        for (const name of ['Yes, this is it', 'No']) {
          const box = await question(page).getByRole('button', { name, exact: true }).boundingBox();
          assert.ok(box.width >= 120 && box.height >= 80, `${name} is small`);
          assert.ok(box.y >= 0 && box.y + box.height <= kPhone.height, `${name} is out of view`);
        }
        const stop = await page.getByRole('button', { name: /^STOP/ }).boundingBox();
        assert.ok(stop.y >= 0 && stop.y + stop.height <= kPhone.height, 'STOP is out of view');
        await question(page).getByRole('button', { name: 'Yes, this is it' }).click();
        await phaseIs(page, 'arrived');
        await journey(page).getByText('I am quite sure that this is the living room.').waitFor();
        await question(page).waitFor({ state: 'detached' });
        assert.deepEqual(house.answers, [{ here: true, by: 'anna' }]);
      },
      { size: kPhone },
    ),
  ],
  [
    'a no ends the journey with who said so, and a stop takes the question away',
    withHouse(async (page, house) => {
      await askAt(page, house, 'Kitchen');
      await question(page).getByRole('button', { name: 'No', exact: true }).click();
      await phaseIs(page, 'failed');
      await journey(page).getByText('Somebody says that this is not kitchen.').waitFor();
      await question(page).waitFor({ state: 'detached' });
      await page.getByRole('button', { name: 'Try again' }).click();
      await phaseIs(page, 'driving');
      house.steer({ do: 'ask' });
      await question(page).waitFor();
      await page.keyboard.press('Escape');
      await phaseIs(page, 'stopped');
      await question(page).waitFor({ state: 'detached' });
    }),
  ],
  [
    'of two browsers the first answer counts, and both see the question vanish',
    withHouse(async (page, house, mock) => {
      await askAt(page, house, 'Kitchen');
      const other = await openPage(browser, { base: mock.url });
      await signIn(other, 'ben', 'homeward');
      await question(other).waitFor();
      await question(other).getByRole('button', { name: 'No', exact: true }).click();
      await question(other).getByText('Anna is driving.').waitFor();
      assert.deepEqual(house.answers, []);
      const viewer = await openPage(browser, { base: mock.url });
      await signIn(viewer, 'vera', 'homeward');
      await question(viewer).getByText('Somebody who may drive the chair can answer.').waitFor();
      assert.equal(await question(viewer).getByRole('button').count(), 0);
      const again = await openPage(browser, { base: mock.url });
      await signIn(again, 'anna', 'homeward');
      await question(again).getByRole('button', { name: 'Yes, this is it' }).click();
      for (const one of [page, other, viewer, again]) {
        await question(one).waitFor({ state: 'detached' });
        await phaseIs(one, 'arrived');
      }
      assert.equal(house.answers.length, 1);
      for (const one of [other, viewer, again]) await one.context().close();
    }),
  ],
  [
    'somebody else who drives is named, and is replaced only on purpose',
    withHouse(
      async (page, house) => {
        house.steer({ do: 'hold', holder: 'anna' });
        await destination(page, 'Kitchen').click();
        await page.getByText('anna is driving the chair just now.').waitFor();
        assert.equal(house.robots[0].mission, null);
        await page.getByRole('button', { name: 'Take over' }).click();
        await phaseIs(page, 'driving');
        house.steer({ do: 'go_on' });
        await phaseIs(page, 'arrived');
        assert.equal(house.robots[0].lease.holder, 'ben');
      },
      { name: 'ben' },
    ),
  ],
  [
    'another destination while the chair drives is asked for again first, on both pages',
    withHouse(async (page, house) => {
      const asked = page.getByText('Chair is on the way to Living room.');
      const goal = () => house.robots[0].mission.destination;
      await destination(page, 'Living room').click();
      await phaseIs(page, 'driving');
      const first = house.robots[0].mission.id;
      await destination(page, 'Living room').click(); // it goes there already
      await destination(page, 'Kitchen').click();
      await asked.waitFor();
      await shoot(page, out, 'diversion');
      assert.deepEqual([goal(), house.robots[0].mission.id], ['living_room', first]);
      await page.getByRole('button', { name: 'Go on to Living room' }).click();
      await asked.waitFor({ state: 'detached' });
      await tab(page, 'Map');
      await page.getByRole('button', { name: 'Bathroom', exact: true }).click();
      await page.getByRole('button', { name: 'Send the chair here' }).click();
      await asked.waitFor();
      assert.equal(goal(), 'living_room');
      await page.getByRole('button', { name: 'Go to Bathroom instead' }).click();
      await journey(page).getByText('to Bathroom').waitFor();
      await asked.waitFor({ state: 'detached' });
      // The question goes before the server has answered.
      for (let i = 0; i < 100 && house.robots[0].mission.place !== 'p13'; i += 1)
        await page.waitForTimeout(50);
      assert.equal(house.robots[0].mission.place, 'p13');
    }),
  ],
  [
    'who stopped the chair, a driver who went away and a lost connection have words of their own, with when',
    withHouse(async (page, house) => {
      for (const [reason, words] of [
        [{ code: 'stopped_by', parameters: { by: 'vera' } }, 'Stopped by vera on the way to Kitchen'],
        [{ code: 'nobody_watching', parameters: {} }, 'Nobody was driving any more on the way to Kitchen'],
        [{ code: 'robot_gone', parameters: {} }, 'Connection lost on the way to Kitchen'],
      ]) {
        house.robots[0].belief.place = 'p1';
        await destination(page, 'Kitchen').click();
        await phaseIs(page, 'driving');
        house.steer({ do: 'halt', reason });
        await journey(page).getByText(words, { exact: true }).waitFor();
        await journey(page)
          .getByText(/^Sent by anna at .*\. Ended at .*\.$/)
          .waitFor();
        await shoot(page, out, `ended-${reason.code}`);
      }
      await tab(page, 'Robots');
      await page.getByText(/That was at .*\./).waitFor();
    }),
  ],
  [
    'loading the page again lets the chair go on, and the session that ended says so',
    withHouse(async (page, house) => {
      await destination(page, 'Living room').click();
      await phaseIs(page, 'driving');
      const kept = page.waitForRequest((one) => one.method() === 'PUT' && one.url().endsWith('/lease'));
      await page.reload();
      await kept;
      house.steer({ do: 'go_on' });
      await phaseIs(page, 'arrived');
      house.sessions.clear();
      await page.keyboard.press('Escape');
      await page.getByText('You were signed out.').waitFor();
    }),
  ],
  [
    'a place is renamed; after a change by somebody else the map is loaded again first',
    withHouse(async (page, house) => {
      await tab(page, 'Map');
      await page.getByRole('button', { name: 'Kitchen', exact: true }).click();
      house.steer({ do: 'edit' });
      const name = page.getByLabel('Name', { exact: true });
      await name.fill('Cooking corner');
      await page.getByRole('button', { name: 'Save', exact: true }).click();
      await page.getByText('Somebody else changed the map in the meantime.').waitFor();
      assert.equal(await name.inputValue(), 'Cooking corner');
      assert.equal(house.graph.places.find((one) => one.id === 'p5').label, 'kitchen');
      await page.getByRole('button', { name: 'Save', exact: true }).click();
      await page.getByText('Named Cooking corner.').waitFor();
      assert.equal(house.graph.places.find((one) => one.id === 'p5').label, 'Cooking corner');
      await tab(page, 'Go');
      await destination(page, 'Cooking corner').waitFor();
    }),
  ],
  [
    'what is being typed stays when somebody else names the place, and that is said',
    withHouse(async (page, house) => {
      await tab(page, 'Map');
      await page.getByRole('button', { name: 'Kitchen', exact: true }).click();
      const name = page.getByLabel('Name', { exact: true });
      await name.fill('Cooking corn');
      house.steer({ do: 'change', edits: [{ kind: 'rename', place: 'p5', label: 'Galley' }], by: 'ben' });
      await page.getByRole('heading', { name: 'Galley' }).waitFor();
      await page.getByText('Somebody has named this place “Galley” meanwhile.').waitFor();
      assert.equal(await name.inputValue(), 'Cooking corn');
      await name.pressSequentially('er');
      await shoot(page, out, 'rename-both');
      await page.getByRole('button', { name: 'Save', exact: true }).click();
      await page.getByText('Named Cooking corner.').waitFor();
      await page.getByRole('heading', { name: 'Cooking corner' }).waitFor();
      // Where nothing is being typed, the field follows.
      house.steer({ do: 'change', edits: [{ kind: 'rename', place: 'p5', label: 'Galley' }], by: 'ben' });
      await page.getByRole('heading', { name: 'Galley' }).waitFor();
      assert.equal(await name.inputValue(), 'Galley');
      assert.equal(await page.getByText('meanwhile').count(), 0);
    }),
  ],
  [
    'a place that gets a name becomes a goal for riders',
    withHouse(async (page, house) => {
      await tab(page, 'Map');
      await page
        .getByRole('button', { name: /^Near the hall/ })
        .first()
        .click();
      await page.getByLabel('Name', { exact: true }).fill('Coat stand');
      await page.getByRole('button', { name: 'Save', exact: true }).click();
      await page.getByText('Named Coat stand.').waitFor();
      await tab(page, 'Go');
      await destination(page, 'Coat stand').click();
      await phaseIs(page, 'driving');
      house.steer({ do: 'go_on' });
      await journey(page).getByText('Arrived: Coat stand').waitFor();
    }),
  ],
  [
    'a way is closed, and the chair is then refused with the reason',
    withHouse(async (page, house) => {
      await tab(page, 'Map');
      await page.getByRole('button', { name: 'Kitchen', exact: true }).click();
      await page.getByRole('button', { name: 'Close the way to Near the kitchen' }).click();
      await page.getByText('This way is closed now.').waitFor();
      assert.equal(house.graph.edges.filter((one) => one.blocked).length, 2);
      await page.getByRole('button', { name: 'Send the chair here' }).click();
      await journey(page)
        .getByText(/There is no way from .+ to .+: the freest leads over the way from/)
        .waitFor();
    }),
  ],
  [
    'closing a way is one change: it is taken back as a whole, and made again',
    withHouse(async (page, house) => {
      await tab(page, 'Map');
      await page.getByRole('button', { name: 'Kitchen', exact: true }).click();
      const place = page.getByRole('region', { name: 'Chosen place: Kitchen' });
      const history = page.getByRole('region', { name: 'Changes by people' });
      const closed = place.getByText('Closed', { exact: true });
      const blocked = () => house.graph.edges.filter((one) => one.blocked).length;
      const back = history.getByRole('button', { name: /^Take the newest back/ });
      const again = history.getByRole('button', { name: /^Make it again/ });
      assert.ok((await back.isDisabled()) && (await again.isDisabled()), 'nothing was changed yet');
      await place.getByRole('button', { name: 'Close the way to Near the kitchen' }).click();
      await closed.waitFor();
      await history.getByText('closed a way: Kitchen – Near the kitchen').waitFor();
      assert.equal(await history.getByRole('listitem').count(), 1);
      assert.equal(blocked(), 2);
      await back.click();
      await history.getByText('The newest change was taken back.').waitFor();
      await closed.waitFor({ state: 'detached' });
      await history.getByText('(taken back)').waitFor();
      assert.equal(blocked(), 0);
      assert.ok(await back.isDisabled(), 'no change stands');
      await again.click();
      await history.getByText('The change was made again.').waitFor();
      await closed.waitFor();
      assert.equal(blocked(), 2);
      await history.scrollIntoViewIfNeeded();
      await shoot(page, out, 'history');
      // One direction alone is not closed, and says so.
      const opened = { kind: 'block_edge', from: 'p5', to: 'p4', blocked: false };
      house.steer({ do: 'change', edits: [opened], by: 'ben' });
      await place.getByText('Closed in one direction', { exact: true }).waitFor();
      await place.getByRole('button', { name: 'Open the way to Near the kitchen' }).click();
      await page.getByText('This way is open again.').waitFor();
      assert.equal(blocked(), 0);
    }),
  ],
  [
    'a shortcut is accepted by what speaks for it, and rejected again',
    withHouse(async (page, house) => {
      await tab(page, 'Map');
      const card = page.getByRole('region', { name: 'Shortcuts', exact: true });
      await card.getByText('2.6 m straight instead of 9.4 m by the way that was driven.').waitFor();
      assert.equal(await card.locator('img').count(), 2);
      await card.getByRole('button', { name: /^Accept the shortcut/ }).click();
      await card.getByText('Accepted', { exact: true }).waitFor();
      assert.deepEqual([house.graph.shortcuts[0].state, house.graph.shortcuts[0].by], ['accepted', 'anna']);
      await card.getByRole('button', { name: /^Reject the shortcut/ }).click();
      await card.getByText('Rejected', { exact: true }).waitFor();
      await page.getByText('rejected a shortcut').first().waitFor();
    }),
  ],
  [
    'a press on a place of the drawing chooses it',
    withHouse(async (page) => {
      await tab(page, 'Map');
      const canvas = page.getByTestId('graph');
      await canvas.locator('canvas').first().waitFor();
      await page.waitForTimeout(500); // the drawing fits itself to its box
      const box = await canvas.boundingBox();
      const inked = await page.locator('.graph-ways').evaluate((one) => {
        const { data } = one.getContext('2d').getImageData(0, 0, one.width, one.height);
        return data.filter((value, i) => i % 4 === 3 && value > 0).length;
      });
      assert.ok(inked > 500, `the ways are drawn: ${inked} pixels`);
      // The drawing shows the unit square with a margin; the kitchen is at (0.34, 0.08), found by trying around there.
      let found = false;
      for (let dy = 0; dy < 0.25 && !found; dy += 0.03)
        for (let dx = -0.08; dx <= 0.08 && !found; dx += 0.03) {
          await page.mouse.click(box.x + (0.34 + dx) * box.width, box.y + (0.06 + dy) * box.height);
          found = await page.getByRole('heading', { name: 'Kitchen', exact: true }).isVisible();
        }
      assert.ok(found, 'no press chose the kitchen');
    }),
  ],
  [
    'of a map of 5,000 places only the rows in view are made, and few pictures asked for',
    withHouse(async (page, house) => {
      house.graph = largeGraph('m1', 5000);
      await page.reload();
      let pictures = 0;
      page.on('request', (one) => (pictures += Number(one.url().includes('/thumbnail'))));
      await tab(page, 'Map');
      const list = page.getByRole('region', { name: 'Places', exact: true });
      await list.getByText('5000 places').waitFor();
      await list.getByRole('button', { name: 'Laboratory 16' }).waitFor();
      await page.getByTestId('graph').locator('canvas').first().waitFor();
      await page.waitForTimeout(500);
      assert.ok((await list.getByRole('listitem').count()) < 30, 'rows out of view are made');
      assert.ok(pictures < 100, `${pictures} pictures were asked for`);
      await shoot(page, out, 'large-map');
      // The tab key goes on to rows that were not made before, and a row with the focus stays.
      await page.getByLabel('Find a place').focus();
      for (let i = 0; i < 20; i += 1) await page.keyboard.press('Tab');
      const row = page.locator('.long-list li:focus-within');
      assert.equal(await row.getAttribute('aria-posinset'), '20');
      assert.equal(await row.getAttribute('aria-setsize'), '5000');
      await list.locator('.long-list').evaluate((one) => (one.scrollTop = 200_000));
      await list.getByText('Near the').first().waitFor();
      assert.equal(await row.getAttribute('aria-posinset'), '20');
      await page.getByLabel('Find a place').fill('office 33');
      await list.getByRole('button', { name: 'Office 33', exact: true }).click();
      await page.getByRole('heading', { name: 'Office 33' }).waitFor();
      await shoot(page, out, 'large-map-chosen');
      // A place that is a dot among thousands is chosen by a press, too.
      await page.goto('/map/m1/place/p1234');
      const ring = page.locator('.place-marks .chosen[data-place=p1234]');
      await ring.waitFor();
      const [x, y] = await Promise.all(['cx', 'cy'].map((name) => ring.getAttribute(name).then(Number)));
      await page.getByLabel('Find a place').fill('office 33');
      await list.getByRole('button', { name: 'Office 33', exact: true }).click();
      await page.getByRole('heading', { name: 'Office 33' }).waitFor();
      const graph = await page.getByTestId('graph').boundingBox();
      await page.mouse.click(graph.x + x, graph.y + y);
      await ring.waitFor();
      assert.ok(page.url().endsWith('/place/p1234'), page.url());
    }),
  ],
  [
    'a folder of pictures becomes a tour, and the tour a map',
    withHouse(async (page, house) => {
      const folder = mkdtempSync(join(tmpdir(), 'homeward-tour-'));
      for (let n = 0; n < 5; ++n) writeFileSync(join(folder, `000${n}.jpg`), `picture ${n}`);
      writeFileSync(join(folder, 'camera.json'), JSON.stringify(kCamera));
      const scanner = {
        angle_min_rad: -1.57,
        angle_step_rad: 1.57,
        range_max_m: 12,
        robot_from_scan: { x_m: 0.3, y_m: 0, theta_rad: 0 },
      };
      const about = { format: 'homeward-scans', version: 1, ...scanner };
      writeFileSync(join(folder, 'scans.json'), JSON.stringify(about));
      writeFileSync(join(folder, 'scans.csv'), 'filename,r0,r1,r2\n0001.jpg,1.25,,12.000\n');
      await tab(page, 'Tours');
      await page.getByLabel('Name of the tour').fill('Upstairs');
      await shoot(page, out, 'tours-new');
      await page.getByLabel('Folder of pictures').setInputFiles(folder);
      await page.getByText('5 pictures found, with the camera, range sweeps.').waitFor();
      await page.getByRole('button', { name: 'Send 5 pictures' }).click();
      await page.getByText('Upstairs is complete, with 5 pictures.').waitFor();
      assert.equal(house.tours.at(-1).images, 5);
      assert.deepEqual(house.sweeps, [
        { tour: house.tours.at(-1).id, n: 1, ...scanner, ranges_m: [1.25, null, 12] },
      ]);
      await page.getByLabel('Name of the map').fill('Upstairs map');
      await page.getByRole('button', { name: 'Build the map' }).click();
      await page.getByRole('progressbar', { name: 'Building Upstairs map' }).waitFor();
      await page.locator('li', { hasText: 'Upstairs map' }).getByText('Ready').waitFor();
    }),
  ],
  [
    'an upload that ends while its page is left and opened again is in the list of tours',
    withHouse(async (page, house) => {
      const folder = mkdtempSync(join(tmpdir(), 'homeward-tour-'));
      for (let n = 0; n < 5; ++n) writeFileSync(join(folder, `000${n}.jpg`), `picture ${n}`);
      writeFileSync(join(folder, 'camera.json'), JSON.stringify(kCamera));
      await tab(page, 'Tours');
      await page.getByLabel('Name of the tour').fill('Upstairs');
      await page.getByLabel('Folder of pictures').setInputFiles(folder);
      await page.route('**/complete', async (route) => {
        await new Promise((done) => setTimeout(done, 1500));
        await route.continue();
      });
      await page.getByRole('button', { name: 'Send 5 pictures' }).click();
      const row = page
        .getByRole('region', { name: 'Tours', exact: true })
        .locator('li', { hasText: 'Upstairs' });
      await row.getByText('Not complete').waitFor(); // it is known while it is being sent
      await tab(page, 'Go');
      await tab(page, 'Tours');
      await row.getByText('Not complete').waitFor();
      await row.getByText('Complete', { exact: true }).waitFor();
      await row.getByText(/^5 pictures/).waitFor();
      assert.equal(house.tours.at(-1).state, 'complete');
    }),
  ],
  [
    'a map is built from what was chosen, and no tour of another map is chosen by itself',
    withHouse(async (page, house) => {
      house.tours.push({ ...house.tours[0], id: 't8', name: 'Garden house' });
      await tab(page, 'Tours');
      const tick = (name) => page.getByRole('checkbox', { name });
      await tick('Garden house').waitFor();
      assert.deepEqual(
        [await tick('Ground floor').isChecked(), await tick('Garden house').isChecked()],
        [false, true],
      );
      house.tours.push({ ...house.tours[0], id: 't9', name: 'Upstairs' });
      await page.reload();
      await tick('Upstairs').waitFor();
      assert.equal(
        await page.getByRole('checkbox', { checked: true }).count(),
        0,
        'nobody knows which belong together',
      );
      await page.getByLabel('Name of the map').fill('Upper floor');
      assert.ok(await page.getByRole('button', { name: 'Build the map' }).isDisabled());
      await tick('Upstairs').check();
      await shoot(page, out, 'build-choice');
      await page.getByRole('button', { name: 'Build the map' }).click();
      await page.getByRole('progressbar', { name: 'Building Upper floor' }).waitFor();
      assert.deepEqual(house.maps.at(-1).tours, ['t9']);
    }),
  ],
  [
    'tours join a map that is there',
    withHouse(async (page, house) => {
      await tab(page, 'Tours');
      await page
        .getByLabel('What to make of the tours')
        .selectOption({ label: 'More of the map Ground floor' });
      await page.getByText('Every complete tour is in this map already.').waitFor();
      house.tours.push({ ...house.tours[0], id: 't9', name: 'The new wing' });
      await page.reload();
      await page
        .getByLabel('What to make of the tours')
        .selectOption({ label: 'More of the map Ground floor' });
      assert.ok(await page.getByRole('checkbox', { name: 'The new wing' }).isChecked());
      await page.getByRole('button', { name: 'Add to the map' }).click();
      await page.getByRole('progressbar', { name: 'Adding to Ground floor' }).waitFor();
      assert.equal(house.jobs.at(-1).kind, 'add');
    }),
  ],
  [
    'a warning of a build shows its pictures without ids, and stays away once it was put away',
    withHouse(async (page) => {
      await tab(page, 'Tours');
      await page.getByLabel('Name of the map').fill('Again');
      await page.getByRole('checkbox', { name: 'Ground floor' }).check();
      await page.getByRole('button', { name: 'Build the map' }).click();
      const row = page.locator('li', { hasText: 'Again' });
      await row.getByText('The tour jumps at 1 of 25 steps: p5.jpg to p11.jpg.').waitFor();
      assert.ok(!(await row.innerText()).includes('t1/'), 'the id of the tour is shown');
      await row.getByRole('img', { name: 'p5.jpg' }).waitFor();
      await row.getByRole('img', { name: 'p11.jpg' }).waitFor();
      await row.scrollIntoViewIfNeeded();
      await shoot(page, out, 'build-warning');
      await row.getByRole('button', { name: 'Hide this: what is to be known of Again' }).click();
      await row.getByText('The tour jumps').waitFor({ state: 'detached' });
      await page.reload();
      await row.getByText('Ready').waitFor();
      assert.equal(await row.getByText('The tour jumps').count(), 0);
    }),
  ],
  [
    'of places that look alike those are shown that somebody can tell, with why they are open',
    withHouse(async (page) => {
      await tab(page, 'Map');
      const card = page.getByRole('region', { name: 'Places that look alike' });
      await card
        .getByText('Between 55 % and 80 % sure that they are one place: too little to decide.')
        .waitFor();
      assert.equal(await card.locator('.pairs > li').count(), 1, 'places beside each other are no question');
      assert.ok(!(await card.innerText()).includes('100 %'));
      await card.scrollIntoViewIfNeeded();
      await shoot(page, out, 'look-alikes');
    }),
  ],
  [
    'what drives saw is taken or discarded, and a map may keep it at once',
    withHouse(async (page, house) => {
      await tab(page, 'Tours');
      house.steer({ do: 'offer' });
      await page
        .getByText(
          '3 new appearances from drives. kitchen would gain 2 new appearances. Near the kitchen would gain 1 new appearance.',
        )
        .waitFor();
      await page.getByRole('img', { name: 'Near the kitchen' }).waitFor();
      await shoot(page, out, 'drive-news');
      await page.getByRole('button', { name: 'Take what drives saw into Ground floor' }).click();
      await page.getByText('kitchen gained 2 new appearances.').waitFor();
      await page.getByRole('button', { name: 'Hide what drives taught Ground floor' }).click();
      await page.getByText('kitchen gained 2 new appearances.').waitFor({ state: 'detached' });
      house.steer({ do: 'offer' });
      await tab(page, 'Map');
      await page.getByRole('button', { name: 'Discard what drives saw for Ground floor' }).click();
      await page.getByText('3 new appearances from drives.').waitFor({ state: 'detached' });
      assert.equal(house.jobs.at(-1).state, 'cancelled');
      await tab(page, 'Tours');
      const setting = page.getByLabel('When a drive saw places of Ground floor in a new light');
      assert.equal(await setting.inputValue(), 'ask');
      await setting.selectOption('auto');
      await page.waitForFunction(() => !document.querySelector('select:disabled'));
      assert.equal(house.maps[0].refine, 'auto');
    }),
  ],
  [
    'a new robot shows its token once and is given a map',
    withHouse(async (page, house) => {
      await tab(page, 'Robots');
      await page.getByLabel('Name of the robot').fill('Walker');
      await page.getByRole('button', { name: 'Add', exact: true }).click();
      assert.match(await page.getByTestId('secret').innerText(), /^hw_/);
      await page.getByRole('button', { name: 'I have kept it' }).click();
      assert.equal(await page.getByTestId('secret').count(), 0);
      await page.getByLabel('Map of Walker').selectOption({ label: 'Ground floor' });
      await page.waitForFunction(
        () =>
          [...document.querySelectorAll('dd')].filter((one) => one.textContent === 'Ground floor').length ===
          2,
      );
      assert.equal(house.robots[1].map, 'm1');
    }),
  ],
  [
    'people are added with a role',
    withHouse(async (page, house) => {
      await tab(page, 'Settings');
      const form = page.locator('form', { hasText: 'Add a person' });
      await form.getByLabel('Name').fill('carl');
      await form.getByLabel('First password').fill('carls password');
      await form.getByLabel('Role').selectOption('carer');
      await form.getByRole('button', { name: 'Add' }).click();
      await page.getByText('carl can sign in now.').waitFor();
      assert.equal(house.users.at(-1).role, 'carer');
    }),
  ],
  [
    'every page at every width and in light and dark is accessible and fits',
    inEveryLook(withHouse, out, async (page, house, see) => {
      await see('go');
      await destination(page, 'Bathroom').click();
      await phaseIs(page, 'driving');
      await see('driving');
      house.steer({ do: 'ask' });
      await question(page).waitFor();
      await see('question');
      await question(page).getByRole('button', { name: 'Yes, this is it' }).click();
      await phaseIs(page, 'arrived');
      await see('arrived');
      for (const name of ['Tours', 'Robots', 'Settings']) {
        await tab(page, name);
        await see(name.toLowerCase());
      }
      await tab(page, 'Map');
      await page.getByRole('button', { name: 'Kitchen', exact: true }).click();
      await page.waitForTimeout(600);
      await see('map');
      house.steer({
        do: 'robot',
        set: { belief: { updates: 3, place: null, probability: null, top: [], lost: true } },
      });
      await tab(page, 'Go');
      await destination(page, 'Kitchen').click();
      await phaseIs(page, 'refused');
      await see('refused');
      await tab(page, 'Settings');
      await page.getByRole('button', { name: 'Sign out' }).click();
      await page.getByRole('heading', { name: 'Sign in' }).waitFor();
      await see('sign-in');
    }),
  ],
];

const wanted = process.argv[3] ?? '';
await runChecks(checks.filter(([name]) => name.includes(wanted)));
await browser.close();
process.stdout.write(`screenshots: ${out}\n`);
