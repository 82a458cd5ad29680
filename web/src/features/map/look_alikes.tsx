// SPDX-License-Identifier: Apache-2.0
import * as calls from '../../api/calls';
import type { Graph, Hypothesis } from '../../api/types';
import { percent } from '../../lib/words';

const kShown = 12;

const kSaid: Readonly<Record<Hypothesis['decision'], string>> = {
  accepted: 'One place',
  rejected: 'Two places',
  undecided: 'Undecided',
};

/** Pairs of places that look alike, as two pictures side by side, and what was decided about them. */
export function LookAlikes({ graph }: { graph: Graph }) {
  if (graph.hypotheses.length === 0) return null;
  // Those that were nearest to the other decision are the ones worth a look.
  const doubt = (one: Hypothesis) => Math.abs((one.support + one.plausibility) / 2 - 0.5);
  const shown = [...graph.hypotheses].sort((a, b) => doubt(a) - doubt(b)).slice(0, kShown);
  return (
    <section class="card stack" aria-label="Places that look alike">
      <h2>Places that look alike</h2>
      <p class="soft">Pairs of pictures that might show one place, the most doubtful first.</p>
      <ul class="pairs">
        {shown.map((one) => (
          <li key={`${one.prototype_a}|${one.prototype_b}`}>
            <div class="pair">
              <img
                class="picture whole"
                src={calls.imageThumbnailUrl(graph.map, one.prototype_a)}
                alt="First place"
                loading="lazy"
              />
              <img
                class="picture whole"
                src={calls.imageThumbnailUrl(graph.map, one.prototype_b)}
                alt="Second place"
                loading="lazy"
              />
            </div>
            <p class="row small">
              <span class="pill">{kSaid[one.decision]}</span>
              <span class="soft">
                {percent(one.support)} to {percent(one.plausibility)} likely one place
                {one.by === 'person' ? ', decided by a person' : ''}
              </span>
            </p>
          </li>
        ))}
      </ul>
    </section>
  );
}
