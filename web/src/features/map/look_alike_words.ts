// SPDX-License-Identifier: Apache-2.0
import type { Graph, Hypothesis } from '../../api/types';
import { indexOf } from '../../lib/graph_index';
import { percent } from '../../lib/words';

// Places beside each other share most of what they show: that they look like one is no question.
const kBesideSteps = 2;
// From here on the evidence of pictures and way is enough to join two places (mapping/hypotheses.hpp, accept_support).
const kEnoughSupport = 0.8;

/**
 * Pairs that the evidence left open and that somebody who knows the house can tell: two places, some way apart, that may
 * be one. What was decided, or lies side by side on the way, is left out; the likeliest stand first.
 */
export function openPairs(graph: Graph): Hypothesis[] {
  const { place_of_image } = indexOf(graph);
  return graph.hypotheses
    .filter((one) => {
      const a = place_of_image.get(one.prototype_a)?.id;
      const b = place_of_image.get(one.prototype_b)?.id;
      if (one.decision !== 'undecided' || one.by === 'person' || a === undefined || b === undefined)
        return false;
      return !around(graph, a, kBesideSteps).has(b);
    })
    .sort((a, b) => b.support - a.support);
}

/** The places that are so many ways from one at most, itself too. */
function around(graph: Graph, place: string, steps: number): ReadonlySet<string> {
  const { neighbours } = indexOf(graph);
  const found = new Set([place]);
  for (let step = 0; step < steps; ++step)
    for (const one of [...found]) for (const other of neighbours.get(one) ?? []) found.add(other);
  return found;
}

/** Why it was left open. */
export function openBecause(one: Hypothesis): string {
  if (one.support > kEnoughSupport)
    return 'All that was seen speaks for one place, but joining them would bring together what the tour keeps apart.';
  const [least, most] = [percent(one.support), percent(one.plausibility)];
  return `Between ${least} and ${most} sure that they are one place: too little to decide.`;
}
