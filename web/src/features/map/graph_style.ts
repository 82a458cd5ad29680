// SPDX-License-Identifier: Apache-2.0
import type { StylesheetJson } from 'cytoscape';
import type { Tone } from './difference_words';
import { kToneColours } from './line_look';

/** A colour of tokens.css as it is now, in the light or in the dark. */
export function token(name: string): string {
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
    ...toned((colour, tone) => ({
      'border-color': colour,
      'border-width': 2.5 * ring,
      ...(tone === 'removed' ? { 'border-style': 'dashed', opacity: 0.7 } : {}),
    })),
  ];
}

/** A rule for each way in which a place is other with a draft. */
function toned(style: (colour: string, tone: Tone) => object): StylesheetJson {
  return (Object.keys(kToneColours) as Tone[]).map((tone) => ({
    selector: `node.${tone}`,
    style: style(token(kToneColours[tone]), tone),
  })) as StylesheetJson;
}
