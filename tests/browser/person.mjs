// SPDX-License-Identifier: Apache-2.0
// Somebody who is signed in at the real server.
import assert from 'node:assert/strict';
import { parseArgs } from 'node:util';
import { openPage, signIn } from './browser.mjs';

const kPatienceMs = 60_000; // beside a chair that looks around on the same machine

/** --base, --name and --password, which tests on the real server need, and --out, where pictures go. */
export function realServer() {
  const { values } = parseArgs({
    options: {
      base: { type: 'string' },
      name: { type: 'string' },
      password: { type: 'string' },
      out: { type: 'string' },
    },
  });
  for (const key of ['base', 'name', 'password']) if (!values[key]) throw new Error(`--${key} is missing`);
  return values;
}

/** A page of theirs, and the server as they ask it. */
export async function person(browser, base, name, password, look = {}) {
  const page = await openPage(browser, { base, ...look });
  page.setDefaultTimeout(kPatienceMs);
  await signIn(page, name, password);
  const ask = async (method, path, data, headers = {}) => {
    const answer = await page.request.fetch(`/api/v1${path}`, {
      method,
      headers: { origin: base, ...headers },
      ...(data === undefined ? {} : { data }),
    });
    assert.ok(answer.ok(), `${method} ${path}: ${answer.status()} ${await answer.text()}`);
    return answer.status() === 204 ? null : answer.json();
  };
  return { page, ask };
}

/** Takes the newest change of a map back on its page, by the part with its history, and waits until the server has. */
export async function takeBack(history, ask, map) {
  const stand = async () => (await ask('GET', `/maps/${map}/history`)).edits.filter((one) => !one.undone);
  const { change } = (await stand()).at(-1);
  await history.getByRole('button', { name: /^Take the newest back/ }).click();
  for (const until = Date.now() + kPatienceMs; (await stand()).some((one) => one.change === change);)
    assert.ok(Date.now() < until, 'the change was not taken back');
}
