// SPDX-License-Identifier: Apache-2.0
import type { Masses } from '../../api/types';
import { massWords } from './doubt_words';

/** How much speaks for, how much against, and how much is not known: a bar of three parts, with the words below. */
export function MassBar({ title, masses }: { title: string; masses: Masses }) {
  const parts = [
    ['for', masses.true],
    ['unknown', masses.unknown],
    ['against', masses.false],
  ] as const;
  return (
    <figure class="stack tight">
      <figcaption class="small">
        <strong>{title}</strong>
        <br />
        <span class="mass-words">{massWords(masses)}</span>
      </figcaption>
      <div class="mass-bar" aria-hidden="true">
        {parts
          .filter(([, share]) => share > 0)
          .map(([name, share]) => (
            <span key={name} class={name} style={{ width: `${100 * share}%` }}>
              {share >= 0.12 && { for: 'for', unknown: '?', against: 'against' }[name]}
            </span>
          ))}
      </div>
    </figure>
  );
}
