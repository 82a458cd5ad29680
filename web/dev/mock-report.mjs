// SPDX-License-Identifier: Apache-2.0
// The acceptance report of the mock server's map: a page without scripts, as the real server answers it.
import { Refusal } from './mock-refusal.mjs';

// The page stands in a frame of the dashboard, and brings its own look and drawings.
const kHeaders = {
  'Content-Type': 'text/html; charset=utf-8',
  'Content-Security-Policy':
    "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'; frame-ancestors 'self'",
};

const kStyle = `:root { color-scheme: light } * { box-sizing: border-box }
body { margin: 0 auto; padding: 2rem 1.2rem; max-width: 60rem; font: 1rem/1.55 system-ui, sans-serif; color: #1d2429; background: #fff }
h1 { margin: 0; font-size: 2rem } h2 { margin: 2.5rem 0 0.4rem; padding-top: 0.8rem; border-top: 1px solid #d9dee3 }
dl { display: grid; grid-template-columns: repeat(auto-fit, minmax(9rem, 1fr)); gap: 0.7rem } dl div { padding: 0.7rem; background: #f5f7f9 }
dt { color: #56616b } dd { margin: 0; font-size: 1.6rem; font-weight: 600 } @media print { body { padding: 0 } }`;

function report(house, { args: [id] }) {
  const map = house.find('maps', id);
  if (!house.built)
    throw new Refusal('not_found', 'The map was not built here; a build keeps its report.', `maps/${id}`);
  const { places, edges, hypotheses } = house.taught;
  const facts = [
    ['Places', places.length],
    ['Pictures', places.flatMap((one) => one.members).length],
    ['Ways', edges.length / 2],
    ['Left open', hypotheses.filter((one) => one.decision === 'undecided').length],
  ];
  const list = places.map(
    (one) => `<li>${one.name}: ${one.members.length} pictures, ${one.features} things</li>`,
  );
  const html = `<!doctype html><html lang="en"><head><meta charset="utf-8"><title>${map.name}</title><style>${kStyle}</style></head>
<body><main><h1>${map.name}</h1><p>How this map was built.</p>
<dl>${facts.map(([name, value]) => `<div><dt>${name}</dt><dd>${value}</dd></div>`).join('')}</dl>
<h2>Weak places</h2><p>The way into the bathroom is hard to drive.</p><h2>All places</h2><ul>${list.join('')}</ul></main></body></html>`;
  return { raw: html, headers: kHeaders };
}

export const kReportRoutes = [[/^GET maps\/([^/]+)\/report$/, 'viewer', report]];
