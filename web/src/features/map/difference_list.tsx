// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import type { Difference, Graph } from '../../api/types';
import { count } from '../../lib/words';
import { differenceLines, kToneSigns, type Tone } from './difference_words';

const kShown = 12; // at first, and with each press

interface Props {
  difference: Difference;
  before: Graph;
  after: Graph;
  against?: string;
  nothing?: string;
  chosen?: string | null; // the place whose differences are marked
  onChoose: (place: string) => void;
}

/** All that is other with a draft, or in a later state, in words; each with a sign, so that nobody needs the colours. */
export function DifferenceList({
  difference,
  before,
  after,
  against = 'Against the map as the chair uses it.',
  nothing = 'Nothing yet: the draft is as the map is.',
  chosen = null,
  onChoose,
}: Props) {
  const [most, setMost] = useState(kShown);
  const lines = differenceLines(difference, before, after);
  return (
    <section class="card stack" aria-label="What is other">
      <h2>What is other</h2>
      {lines.length === 0 ? (
        <p class="soft">{nothing}</p>
      ) : (
        <p class="soft">
          {against} {count(lines.length, 'difference')}.
        </p>
      )}
      <ul class="list">
        {lines.slice(0, most).map(({ tone, words, place }) => (
          <li key={words}>
            <span class="difference">
              <ToneMark tone={tone} />
              {words}
            </span>
            {place !== null && (
              <button
                type="button"
                class="button small"
                aria-label={`Show on the map: ${words}`}
                aria-pressed={chosen === null ? undefined : chosen === place}
                onClick={() => onChoose(place)}
              >
                Show
              </button>
            )}
          </li>
        ))}
      </ul>
      {lines.length > most && (
        <button type="button" class="button" onClick={() => setMost(most + kShown)}>
          Show more of {count(lines.length, 'difference')}
        </button>
      )}
    </section>
  );
}

export function ToneMark({ tone }: { tone: Tone }) {
  const { sign, word, pill } = kToneSigns[tone];
  return (
    <span class={`pill tone ${pill}`}>
      <span aria-hidden="true">{sign}</span> {word}
    </span>
  );
}

/** What the signs in the drawing mean. */
export function ToneLegend() {
  return (
    <p class="row small" data-testid="legend">
      In the drawing:
      <ToneMark tone="added" />
      <ToneMark tone="removed" />
      <ToneMark tone="changed" />
    </p>
  );
}
