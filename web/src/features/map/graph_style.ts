// SPDX-License-Identifier: Apache-2.0
import type { StylesheetJson } from 'cytoscape';

/** A colour of tokens.css as it is now, in the light or in the dark. */
function token(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

const kNamePx = 14;

/** `zoom`: screen pixels per unit of the drawing when all of it is shown; names stay readable at that. */
export function graphStyle(diameter: number, zoom: number): StylesheetJson {
  const ring = Math.max(2, 0.05 * diameter);
  return [
    {
      selector: 'node',
      style: {
        width: diameter,
        height: diameter,
        'background-color': token('sunken'),
        'background-image': 'data(picture)',
        'background-fit': 'cover',
        'background-image-crossorigin': 'use-credentials',
        'border-width': ring,
        'border-color': token('line-strong'),
        'font-family': 'Atkinson Hyperlegible, sans-serif',
        'font-size': Math.max(kNamePx / zoom, 0.3 * diameter),
        'font-weight': 'bold',
        color: token('ink'),
        'text-valign': 'bottom',
        'text-margin-y': 5,
        'text-outline-color': token('surface'),
        'text-outline-width': 2.5 / zoom,
        'min-zoomed-font-size': 8,
      },
    },
    { selector: 'node[name]', style: { label: 'data(name)' } },
    {
      selector: 'node[belief > 0.02]',
      style: {
        'border-color': token('amber'),
        'border-width': `mapData(belief, 0, 1, ${ring}, ${4 * ring})`,
        'underlay-color': token('amber'),
        'underlay-opacity': 'mapData(belief, 0, 1, 0.1, 0.6)' as unknown as number,
        'underlay-padding': 2.5 * ring,
        'underlay-shape': 'ellipse',
      },
    },
    { selector: 'node.chosen', style: { 'border-color': token('focus'), 'border-width': 2.5 * ring } },
    { selector: 'edge', style: { width: 3, 'line-color': token('line-strong'), 'curve-style': 'straight' } },
    { selector: 'edge.weak', style: { 'line-style': 'dashed' } },
    { selector: 'edge.shortcut', style: { 'line-color': token('focus') } },
    { selector: 'edge.proposed', style: { 'line-style': 'dashed', 'line-color': token('focus'), width: 2 } },
    { selector: 'edge.way', style: { width: 7, 'line-color': token('brand') } },
    {
      selector: 'edge.closed-one_way',
      style: { 'line-color': token('danger'), 'line-style': 'dotted' },
    },
    {
      selector: 'edge.closed-both',
      style: {
        'line-color': token('danger'),
        'line-style': 'dotted',
        label: '✕',
        color: token('danger-text'),
        'font-size': 24,
      },
    },
  ];
}
