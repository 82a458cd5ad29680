// SPDX-License-Identifier: Apache-2.0

/** From each key of a text, typed into the search for places, until the next frame, in milliseconds. The field is empty again. */
export async function keyTimes(page, text = 'ward 3 near the office') {
  const field = page.getByLabel('Find a place');
  const times = [];
  for (const key of text) {
    await field.focus();
    await page.evaluate(() => {
      globalThis.keyShown = new Promise((done) =>
        document.activeElement.addEventListener(
          'keydown',
          ({ timeStamp }) =>
            requestAnimationFrame(() => setTimeout(() => done(performance.now() - timeStamp))),
          { once: true },
        ),
      );
      return null;
    });
    await page.keyboard.press(key === ' ' ? 'Space' : key);
    times.push(await page.evaluate(() => globalThis.keyShown));
  }
  await field.fill('');
  return times;
}
