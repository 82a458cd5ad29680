// SPDX-License-Identifier: Apache-2.0
// A pretended house server for developing and testing the dashboard: everything in memory, nothing moves.
// Usage: node dev/mock-server.mjs [--port 8099] [--dist dist] [--step-ms 900] [--fresh]
//   --fresh   no account and no robot yet; the set-up token is "first"
// Accounts: anna (admin), ben (rider), vera (viewer); the password of each is "homeward".
// The browser tests steer it by POST /mock {"do": ...}; see `steer` below.
import { createReadStream, existsSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { WebSocketServer } from 'ws';
import { pictureOf } from './mock-house.mjs';
import { Refusal } from './mock-refusal.mjs';
import { House } from './mock-state.mjs';

export { kCamera } from './mock-state.mjs';

const kTypes = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.svg': 'image/svg+xml',
  '.woff2': 'font/woff2',
  '.woff': 'font/woff',
};
// The same policy as the real server sends, so that what it would block is noticed here.
const kPolicy =
  "default-src 'self'; img-src 'self' blob:; connect-src 'self'; style-src 'self'; script-src 'self'; object-src 'none'; base-uri 'none'; frame-ancestors 'none'";

export function startMock({ port = 8099, dist, step_ms = 900, fresh = false, waits = false } = {}) {
  const house = new House({ step_ms, fresh, waits });
  const root = resolve(dist ?? fileURLToPath(new URL('../dist', import.meta.url)));
  const events = new WebSocketServer({ noServer: true });
  house.tell = (message) => {
    if (house.silent) return;
    for (const client of events.clients) client.send(JSON.stringify(message));
  };
  const server = createServer((request, response) => void answer(house, root, request, response));
  server.on('upgrade', async (request, socket, head) => {
    await house.silent?.over;
    if (request.url !== '/api/v1/events' || !house.userOf(request) || house.unreachable)
      return void socket.destroy();
    events.handleUpgrade(request, socket, head, (client) => client.send(JSON.stringify(house.snapshot())));
  });
  house.dropClients = () => events.clients.forEach((client) => client.terminate());
  return new Promise((done) => {
    server.listen(port, '127.0.0.1', () =>
      done({
        house,
        url: `http://127.0.0.1:${server.address().port}`,
        close: () => (house.close(), house.dropClients(), server.close()),
      }),
    );
  });
}

async function answer(house, root, request, response) {
  const url = new URL(request.url, 'http://localhost');
  if (url.pathname === '/mock') {
    house.steer(JSON.parse((await bodyOf(request)).toString()));
    return void response.writeHead(204).end();
  }
  await house.silent?.over;
  if (house.unreachable) return void request.socket.destroy();
  if (!url.pathname.startsWith('/api/v1/')) return void serveFile(root, url.pathname, response);
  try {
    const raw = await bodyOf(request);
    const json = request.headers['content-type']?.startsWith('application/json') && raw.length > 0;
    const result = await house.call(
      request,
      url.pathname.slice('/api/v1'.length),
      json ? JSON.parse(raw.toString()) : raw,
      url.searchParams,
    );
    if (result.picture)
      return void response.writeHead(200, { 'Content-Type': 'image/svg+xml' }).end(pictureOf(result.picture));
    if (result.raw !== undefined) return void response.writeHead(200, result.headers).end(result.raw);
    const headers = { 'Content-Type': 'application/json', ...result.headers };
    response
      .writeHead(result.status ?? 200, headers)
      .end(result.body === undefined ? '' : JSON.stringify(result.body));
  } catch (thrown) {
    const { document } = thrown instanceof Refusal ? thrown : new Refusal('internal', String(thrown));
    response
      .writeHead(document.status, { 'Content-Type': 'application/problem+json' })
      .end(JSON.stringify(document));
  }
}

async function bodyOf(request) {
  const parts = [];
  for await (const part of request) parts.push(part);
  return Buffer.concat(parts);
}

function serveFile(root, pathname, response) {
  const wanted = join(root, normalize(pathname));
  const file =
    wanted.startsWith(root) && existsSync(wanted) && statSync(wanted).isFile()
      ? wanted
      : join(root, 'index.html');
  response.writeHead(200, {
    'Content-Type': kTypes[extname(file)] ?? 'application/octet-stream',
    'Content-Security-Policy': kPolicy,
  });
  createReadStream(file).pipe(response);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const { values } = parseArgs({
    options: {
      port: { type: 'string', default: '8099' },
      dist: { type: 'string' },
      'step-ms': { type: 'string', default: '900' },
      fresh: { type: 'boolean', default: false },
    },
  });
  const mock = await startMock({
    port: Number(values.port),
    dist: values.dist,
    step_ms: Number(values['step-ms']),
    fresh: values.fresh,
  });
  process.stdout.write(`${mock.url}\n`);
}
