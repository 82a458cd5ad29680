// SPDX-License-Identifier: Apache-2.0
import type { StylesheetJson } from 'cytoscape';
import { kToneSigns, type Tone } from './difference_words';

/** A colour of tokens.css as it is now, in the light or in the dark. */
function token(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

const kNamePx = 14;

/** What names need to be read at so many screen pixels per unit of the drawing. */
export function nameStyle(diameter: number, zoom: number) {
  return {
    'font-size': Math.max(kNamePx / zoom, 0.3 * diameter),
    'text-margin-y': 3 / zoom,
    'text-outline-width': 2.5 / zoom,
  };
}

/** `diameter`: of a place, in units of the drawing. */
export function graphStyle(diameter: number): StylesheetJson {
  const ring = Math.max(Math.min(2, 0.12 * diameter), 0.05 * diameter);
  const line = Math.min(3, 0.4 * diameter);
  return [
    {
      selector: 'node',
      style: {
        width: diameter,
        height: diameter,
        'background-color': token('sunken'),
        'border-width': ring,
        'border-color': token('line-strong'),
        'font-family': 'Atkinson Hyperlegible, sans-serif',
        'font-weight': 'bold',
        color: token('ink'),
        'text-valign': 'bottom',
        'text-outline-color': token('surface'),
        'min-zoomed-font-size': 8,
      },
    },
    { selector: 'node[name]', style: { label: 'data(name)', 'z-index': 1 } },
    {
      selector: 'node.pictured',
      style: {
        'background-image': 'data(picture)',
        'background-fit': 'cover',
        'background-image-crossorigin': 'use-credentials',
      },
    },
    ...toned('node', ({ colour }, tone) => ({
      'border-color': colour,
      'border-width': 2.5 * ring,
      ...(tone === 'removed' ? { 'border-style': 'dashed', opacity: 0.7 } : {}),
    })),
    {
      selector: 'edge',
      style: {
        width: line,
        'line-color': token('line-strong'),
        'curve-style': 'haystack',
        'haystack-radius': 0,
      },
    },
    { selector: 'edge.weak', style: { 'line-style': 'dashed' } },
    { selector: 'edge.shortcut', style: { 'line-color': token('focus') } },
    {
      selector: 'edge.proposed',
      style: { 'line-style': 'dashed', 'line-color': token('focus'), width: 0.7 * line },
    },
    { selector: 'edge.way', style: { width: 2.4 * line, 'line-color': token('brand') } },
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
        'font-size': 8 * line,
      },
    },
    ...toned('edge', ({ colour, text, sign }, tone) => ({
      'line-color': colour,
      'line-style': tone === 'removed' ? 'dashed' : 'solid',
      width: 1.8 * line,
      label: sign,
      color: text,
      'font-size': 8 * line,
      'font-weight': 'bold',
      'text-outline-color': token('surface'),
      'text-outline-width': 1.2 * line,
    })),
  ];
}

interface ToneLook {
  colour: string;
  text: string;
  sign: string;
}

/** A rule for each way in which something is other with a draft. */
function toned(what: 'node' | 'edge', style: (look: ToneLook, tone: Tone) => object): StylesheetJson {
  const looks: Readonly<Record<Tone, readonly [string, string]>> = {
    added: ['brand', 'brand-text'],
    removed: ['danger', 'danger-text'],
    changed: ['amber', 'amber-text'],
  };
  return (Object.keys(looks) as Tone[]).map((tone) => ({
    selector: `${what}.${tone}`,
    style: style(
      { colour: token(looks[tone][0]), text: token(looks[tone][1]), sign: kToneSigns[tone].sign },
      tone,
    ),
  })) as StylesheetJson;
}
