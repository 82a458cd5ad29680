// SPDX-License-Identifier: Apache-2.0
import type { Graph, Hypothesis } from '../../api/types';
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
  const place_of = new Map(graph.places.flatMap((one) => one.members.map((image) => [image, one.id])));
  return graph.hypotheses
    .filter((one) => {
      const [a, b] = [place_of.get(one.prototype_a), place_of.get(one.prototype_b)];
      if (one.decision !== 'undecided' || one.by === 'person' || a === undefined || b === undefined)
        return false;
      return !around(graph, a, kBesideSteps).has(b);
    })
    .sort((a, b) => b.support - a.support);
}

/** The places that are so many ways from one at most, itself too. */
function around(graph: Graph, place: string, steps: number): ReadonlySet<string> {
  const found = new Set([place]);
  for (let step = 0; step < steps; ++step) {
    const before = new Set(found);
    for (const { from, to } of graph.edges) {
      if (before.has(from)) found.add(to);
      if (before.has(to)) found.add(from);
    }
  }
  return found;
}

/** Why it was left open. */
export function openBecause(one: Hypothesis): string {
  if (one.support > kEnoughSupport)
    return 'All that was seen speaks for one place, but joining them would bring together what the tour keeps apart.';
  const [least, most] = [percent(one.support), percent(one.plausibility)];
  return `Between ${least} and ${most} sure that they are one place: too little to decide.`;
}
