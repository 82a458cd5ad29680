// SPDX-License-Identifier: Apache-2.0
type Sign = 'chair' | 'goal' | 'pinned' | 'place' | 'arrow' | 'cloud';

const kChair: readonly (readonly [Sign, string])[] = [['chair', 'The chair, where it believes to be']];
const kSeen: readonly (readonly [Sign, string])[] = [
  ['arrow', 'Where the walls of the plan have it'],
  ['cloud', 'Where it may be by these walls'],
];
const kMap: readonly (readonly [Sign, string])[] = [
  ['goal', 'Where it goes'],
  ['pinned', 'A place that a person put there'],
  ['place', 'A place where the map has it'],
];

/** What the signs of a plan mean. `seen`: those of where the plan has the chair are on it; `brief`: nothing of the map. */
export function PlanLegend({ seen, brief = false }: { seen: boolean; brief?: boolean }) {
  const signs = [...kChair, ...(seen ? kSeen : []), ...(brief ? [] : kMap)];
  return (
    <ul class={brief ? 'floor-plan-legend small' : 'floor-plan-legend'} aria-label="Signs of the floor plan">
      {signs.map(([kind, words]) => (
        <li key={kind}>
          <span class={`floor-plan-sign ${kind}`} aria-hidden="true" />
          {words}
        </li>
      ))}
    </ul>
  );
}
