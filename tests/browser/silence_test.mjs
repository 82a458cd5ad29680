// SPDX-License-Identifier: Apache-2.0
// A server that is frozen and wakes up again, as a dashboard on it tells it. Usage, with the server's process:
// node tests/browser/silence_test.mjs --base URL --name N --password P --pid PID --out DIR
import assert from 'node:assert/strict';
import { parseArgs } from 'node:util';
import { launch, openPage, runChecks, shoot, signIn } from './browser.mjs';

// What people are promised, from the freeze and from the press.
const kNoticedMs = 3000;
const kUnheardMs = 1000;
const kQuietMs = 8000; // without any news but heartbeats

const { values } = parseArgs({
  options: {
    base: { type: 'string' },
    name: { type: 'string' },
    password: { type: 'string' },
    pid: { type: 'string' },
    out: { type: 'string' },
  },
});
const pid = Number(values.pid);

const browser = await launch();
const page = await openPage(browser, { base: values.base });
const silence = page.getByText('The house server cannot be reached.');
const stopWord = page.getByTestId('stop-word');

await runChecks([
  [
    'a server that has nothing to tell is no silent one',
    async () => {
      await signIn(page, values.name, values.password);
      await page.getByRole('button', { name: /^STOP/ }).waitFor();
      await page.evaluate(() => {
        globalThis.noticed = 0;
        new MutationObserver(() => {
          if (document.body.innerText.includes('cannot be reached')) globalThis.noticed += 1;
        }).observe(document.body, { childList: true, subtree: true });
      });
      await page.waitForTimeout(kQuietMs);
      assert.equal(await page.evaluate(() => globalThis.noticed), 0);
    },
  ],
  [
    'a server that freezes is noticed within 3 s, with the age of what is shown, and a STOP within 1 s',
    async () => {
      process.kill(pid, 'SIGSTOP');
      await silence.waitFor({ timeout: kNoticedMs });
      await page.getByText(/^What you see is [2-4] s old\.$/).waitFor();
      await page.keyboard.press('Escape');
      await stopWord.getByText('STOP was not heard').waitFor({ timeout: kUnheardMs });
      await stopWord.getByText('Use the stop button on the chair!').waitFor();
      await shoot(page, values.out, 'frozen');
      await page.waitForTimeout(kQuietMs);
      await silence.waitFor();
    },
  ],
  [
    'when it wakes up all of that ends by itself',
    async () => {
      process.kill(pid, 'SIGCONT');
      await silence.waitFor({ state: 'detached', timeout: 10_000 });
      await stopWord.getByText('Stop received').waitFor({ timeout: 10_000 });
      assert.equal(await stopWord.getByText('was not heard').count(), 0);
    },
  ],
  [
    'a STOP that is pressed before anybody has noticed says within 1 s that nobody has heard it',
    async () => {
      process.kill(pid, 'SIGSTOP');
      await page.keyboard.press('Escape');
      await stopWord.getByText('STOP was not heard').waitFor({ timeout: kUnheardMs });
      process.kill(pid, 'SIGCONT');
      await stopWord.getByText('Stop received').waitFor({ timeout: 10_000 });
    },
  ],
]);
await browser.close();
