// SPDX-License-Identifier: Apache-2.0
// What the browser tests share: a Chromium from the system, driven by the playwright-core of web/node_modules.
import { existsSync, mkdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const require = createRequire(new URL('../../web/package.json', import.meta.url));

export const kWide = { width: 1280, height: 800 };
export const kPhone = { width: 390, height: 844 };

// Without windows first: what draws them takes as much of the processor again as the pages.
const kChromiums = ['/usr/bin/chromium-headless-shell', '/usr/bin/chromium'];

/** Starts the system's Chromium; CHROMIUM names another one. */
export async function launch() {
  const places = process.env.CHROMIUM ? [process.env.CHROMIUM] : kChromiums;
  const executablePath = places.find((path) => existsSync(path));
  if (!executablePath) throw new Error(`there is no Chromium at ${places.join(' or ')}; set CHROMIUM`);
  const { chromium } = require('playwright-core');
  const asRoot = process.getuid?.() === 0;
  return chromium.launch({
    executablePath,
    args: asRoot ? ['--no-sandbox'] : [],
  });
}

/** A page that fails the test on an exception or a blocked resource instead of hiding it in the console. */
export async function openPage(browser, { size = kWide, scheme = 'light', base, touch = false } = {}) {
  const context = await browser.newContext({
    baseURL: base,
    viewport: size,
    colorScheme: scheme,
    hasTouch: touch,
    reducedMotion: 'reduce',
    serviceWorkers: 'block',
  });
  const page = await context.newPage();
  page.complaints = [];
  page.on('pageerror', (error) => page.complaints.push(String(error)));
  page.on('console', (message) => {
    if (message.type() === 'error' && /Content Security Policy/.test(message.text()))
      page.complaints.push(message.text());
  });
  return page;
}

export async function signIn(page, name, password) {
  await page.goto('/');
  await page.getByLabel('Your name').fill(name);
  await page.getByLabel('Password').fill(password);
  await page.getByRole('button', { name: 'Sign in' }).click();
  await page.getByRole('navigation', { name: 'Pages' }).waitFor();
}

/** Findings of axe-core on the page as it is, whatever their impact, one line each. */
export async function findings(page) {
  // Evaluated through the debugger, so that the page's own content policy stays in force for the page.
  await page.evaluate(readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8'));
  const { violations } = await page.evaluate(() =>
    globalThis.axe.run(document, {
      runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'],
    }),
  );
  return violations.flatMap((one) =>
    one.nodes.map(
      (node) =>
        `${one.id} (${one.impact}): ${node.html.slice(0, 140)} (${node.failureSummary?.replace(/\s+/g, ' ')})`,
    ),
  );
}

/** Whether the page can be scrolled sideways, which no width of screen should need. */
export function sticksOut(page) {
  return page.evaluate(() => document.documentElement.scrollWidth > document.documentElement.clientWidth + 1);
}

export async function shoot(page, dir, name) {
  mkdirSync(dir, { recursive: true });
  await page.screenshot({ path: join(dir, `${name}.png`) });
}

/** Runs the named checks one after the other; prints a line each and sets the exit status. */
export async function runChecks(checks) {
  let failed = 0;
  for (const [name, check] of checks) {
    const begun = performance.now();
    try {
      await check();
      process.stdout.write(`ok    ${name} (${Math.round(performance.now() - begun)} ms)\n`);
    } catch (thrown) {
      failed += 1;
      process.stdout.write(
        `FAIL  ${name}\n      ${thrown instanceof Error ? thrown.message.replace(/\n/g, '\n      ') : thrown}\n`,
      );
    }
  }
  process.stdout.write(
    failed === 0 ? `all ${checks.length} passed\n` : `${failed} of ${checks.length} failed\n`,
  );
  process.exitCode = failed === 0 ? 0 : 1;
}
