// SPDX-License-Identifier: Apache-2.0
import type { Mark } from './plan_drawing';

const kWords: readonly (readonly [Mark['kind'], string])[] = [
  ['chair', 'The chair, where it believes to be'],
  ['goal', 'Where it goes'],
  ['pinned', 'A place that a person put there'],
  ['place', 'A place where the map has it'],
];

/** What the signs of a plan mean. */
export function PlanLegend() {
  return (
    <ul class="floor-plan-legend" aria-label="Signs of the floor plan">
      {kWords.map(([kind, words]) => (
        <li key={kind}>
          <span class={`floor-plan-sign ${kind}`} aria-hidden="true" />
          {words}
        </li>
      ))}
    </ul>
  );
}
