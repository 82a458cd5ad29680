// SPDX-License-Identifier: Apache-2.0
// How alike the pictures of a map are, as a matrix, in a real browser against the pretended house.
// Usage: node tests/browser/similarity_test.mjs [FOLDER FOR SCREENSHOTS [WORDS]]     after web/build.sh
import assert from 'node:assert/strict';
import { largeGraph } from '../../web/dev/mock-large.mjs';
import { runChecks } from './browser.mjs';
import { inEveryLook, pretendedHouses, screenshotFolder, tab } from './house.mjs';

const out = screenshotFolder();
const { browser, withHouse } = await pretendedHouses();

/** 25,000 pictures at 5,000 places. */
function manyPictures(house) {
  const each = 5;
  const graph = largeGraph('m1', 5000);
  graph.places.forEach((one, i) => {
    one.members = Array.from({ length: each }, (_, k) => `t1/p${each * i + k + 1}.jpg`);
    one.prototype = one.members[0];
  });
  for (const one of graph.destinations) one.image = graph.places.find(({ id }) => id === one.place).prototype;
  house.taught = graph;
  house.graph = structuredClone(graph);
}

const matrix = (page) => page.getByTestId('matrix');
const twoPictures = (page) => page.getByRole('region', { name: 'The two pictures' });
const tiles = (page) => matrix(page).locator('img');

/** Presses a cell of the matrix as it is when all is shown. */
async function press(page, column, row, pictures) {
  const { width, height } = await matrix(page).boundingBox();
  const position = { x: ((column + 0.5) * width) / pictures, y: ((row + 0.5) * height) / pictures };
  await matrix(page).click({ position });
}

const part = (page, name) =>
  page.getByRole('navigation', { name: 'Of this map' }).getByRole('link', { name, exact: true });

const checks = [
  [
    'a dot of the matrix shows its two pictures, their places, and how the map has them',
    withHouse(async (page) => {
      await tab(page, 'Map');
      await part(page, 'Similarity').click();
      await tiles(page).first().waitFor();
      await press(page, 8, 1, 26);
      const card = twoPictures(page);
      await card.getByRole('link', { name: 'Kitchen', exact: true }).waitFor();
      await card.getByText('Picture 9 of Ground floor, along the top').waitFor();
      await card.getByRole('link', { name: 'Hall', exact: true }).waitFor();
      await card.getByText('Picture 2 of Ground floor, down the side').waitFor();
      assert.equal(await card.getByTestId('small-map').locator('.mark').count(), 2);
      await page.waitForURL('**/map/m1/similarity/9/2');
      await page.mouse.move(0, 0);
      await card.getByText('They are 40 % alike.').waitFor();
      await page.reload();
      await card.getByRole('link', { name: 'Kitchen', exact: true }).waitFor();
      await press(page, 0, 1, 26);
      await card.getByText('The map takes both for one place.').waitFor();
      await press(page, 6, 22, 26);
      await card.getByText('The map leaves open whether they are one place.').waitFor();
      await card.getByText('What is in both pictures').click();
      await card.getByText('16 things are in both pictures').waitFor();
      await card.getByRole('link', { name: 'What may be wrong at the place of A' }).click();
      await page.waitForURL('**/map/m1/evidence/place/p4');
      await page.getByLabel('At the place').waitFor();
    }),
  ],
  [
    'the mouse shows what it is over, and what was chosen comes back',
    withHouse(async (page) => {
      await page.goto('/map/m1/similarity/9/2');
      const card = twoPictures(page);
      await card.getByText('Picture 9 of').waitFor();
      const { x, y, width } = await matrix(page).boundingBox();
      await page.mouse.move(x + (20.5 * width) / 26, y + (4.5 * width) / 26);
      await card.getByText('Picture 21 of Ground floor, along the top').waitFor();
      await page.mouse.move(x + width + 30, y);
      await card.getByText('Picture 9 of Ground floor, along the top').waitFor();
    }),
  ],
  [
    'the matrix is read by keyboard and ear: arrows, sizes, and two pictures by number or place',
    withHouse(async (page) => {
      await page.goto('/map/m1/similarity/14/14');
      await tiles(page).first().waitFor();
      const said = (hasText) =>
        page.getByTestId('cell-words').filter({ hasText }).waitFor({ state: 'attached' });
      await matrix(page).focus();
      await page.keyboard.press('ArrowRight');
      await said('Picture 15 of Ground floor, ');
      await page.keyboard.press('Shift+ArrowLeft');
      await page.keyboard.press('Shift+ArrowLeft');
      await page.keyboard.press('Shift+ArrowUp');
      await page.keyboard.press('ArrowUp');
      await page.keyboard.press('ArrowUp');
      await said(
        'Picture 1 of Ground floor, the hall, and picture 2 of Ground floor, the hall. The map takes both',
      );
      const width = () =>
        tiles(page)
          .last()
          .evaluate((one) => one.clientWidth);
      const before = await width();
      await page.keyboard.press('+');
      await page.waitForFunction(
        (was) => document.querySelector('.matrix-sheet img').clientWidth > 1.4 * was,
        before,
      );
      await page.keyboard.press('0');
      await page.waitForFunction(
        (was) => document.querySelector('.matrix-sheet img').clientWidth === was,
        before,
      );
      await page.getByLabel('A, along the top').fill('24');
      await page.getByLabel('B, down the side').fill('cellar');
      await page.keyboard.press('Enter');
      await page.getByText('The map has no picture or place “cellar”.').waitFor();
      await page.getByLabel('B, down the side').fill('kitchen');
      await page.keyboard.press('Enter');
      await said(/^Picture 24 of .+, and picture 9 of .+, the kitchen\. .+ They are 40 % alike\.$/);
    }),
  ],
  [
    '25,000 pictures stay quick: few tiles and few pictures at every size, and hands move and enlarge it',
    withHouse(async (page, house) => {
      manyPictures(house);
      const asked = new Set();
      page.on('request', (one) => /similarity\/\d/.test(one.url()) && asked.add(new URL(one.url()).pathname));
      await page.goto('/map/m1/similarity');
      await tiles(page).first().waitFor();
      const few = async (most) => {
        const shown = [await tiles(page).count(), await page.locator('.strip img').count()];
        assert.ok(shown[0] <= most && shown[1] <= 40, `${shown} tiles and pictures are shown`);
      };
      await few(12);
      const coarse = Number(await matrix(page).getAttribute('data-level'));
      assert.ok(coarse >= 5, `level ${coarse} shows all`);
      const { x, y, width } = await matrix(page).boundingBox();
      await page.mouse.move(x + 0.6 * width, y + 0.4 * width);
      for (let i = 0; i < 12; i += 1) await page.mouse.wheel(0, -400);
      await page.locator('[data-testid=matrix][data-level="0"]').waitFor();
      await few(12);
      const title = twoPictures(page).getByText(/^Picture \d+ of Ground floor, along the top$/);
      const picture = async () => Number(/\d+/.exec(await title.innerText())[0]);
      await page.mouse.move(x + 0.6 * width, y + 0.4 * width + 1);
      await title.waitFor();
      const there = await picture();
      assert.ok(Math.abs(there - 15_000) < 100, `the mouse is over picture ${there}`);
      await page.mouse.down();
      await page.mouse.move(x + 0.6 * width - 200, y + 0.4 * width, { steps: 5 });
      await page.mouse.up();
      await page.mouse.move(x + 0.6 * width, y + 0.4 * width);
      await page.waitForTimeout(500);
      assert.ok((await picture()) > there, 'the hand did not move it');
      await few(12);
      assert.ok(asked.size < 120, `${asked.size} tiles were asked for`);
      await page.getByLabel('A, along the top').fill('20000');
      await page.getByLabel('B, down the side').fill('ward 1');
      await page.getByRole('button', { name: 'Show both' }).click();
      await twoPictures(page).getByText('Picture 20000 of').waitFor();
      await twoPictures(page).getByRole('link', { name: 'Ward 1', exact: true }).waitFor();
    }),
  ],
  [
    'two fingers enlarge the matrix and one moves it',
    withHouse(
      async (page, house) => {
        manyPictures(house);
        await page.goto('/map/m1/similarity');
        await tiles(page).first().waitFor();
        const level = async () => Number(await matrix(page).getAttribute('data-level'));
        const before = await level();
        const { x, y, width } = await matrix(page).boundingBox();
        const touch = await page.context().newCDPSession(page);
        const fingers = (type, ...at) =>
          touch.send('Input.dispatchTouchEvent', {
            type,
            touchPoints: at.map((dx, id) => ({ x: x + dx, y: y + 90, id })),
          });
        await fingers('touchStart', width / 2 - 20);
        await fingers('touchStart', width / 2 - 20, width / 2 + 20);
        for (let d = 30; d < 130; d += 10) await fingers('touchMove', width / 2 - d, width / 2 + d);
        await fingers('touchEnd');
        await page.waitForFunction(
          (was) => Number(document.querySelector('[data-testid=matrix]').dataset.level) < was,
          before,
        );
        await page.touchscreen.tap(x + width / 2, y + width / 2);
        await twoPictures(page)
          .getByText(/Picture \d+ of Ground floor, along the top/)
          .waitFor();
        assert.equal((await page.evaluate(() => scrollY)) >= 0, true);
      },
      { size: { width: 390, height: 844 }, touch: true },
    ),
  ],
  [
    'a map that was not built here has no matrix, and the page says what to do',
    withHouse(async (page, house) => {
      house.built = false;
      await page.goto('/map/m1/similarity');
      await page.getByText('How alike the pictures are is not known').waitFor();
    }),
  ],
  [
    'the matrix at every width and in light and dark is accessible and fits',
    inEveryLook(withHouse, out, async (page, house, see) => {
      await page.goto('/map/m1/similarity/9/2');
      await twoPictures(page).getByText('Picture 9 of').waitFor();
      await see('similarity');
      await matrix(page).evaluate((one) => one.scrollIntoView({ block: 'center' }));
      await see('similarity-matrix');
      await twoPictures(page).evaluate((one) => one.scrollIntoView());
      await see('similarity-card');
    }),
  ],
];

const wanted = process.argv[3] ?? '';
await runChecks(checks.filter(([name]) => name.includes(wanted)));
await browser.close();
process.stdout.write(`screenshots: ${out}\n`);
