// SPDX-License-Identifier: Apache-2.0
import * as calls from '../../api/calls';
import type { Graph, Place } from '../../api/types';
import { Section } from '../../components/section';
import { useLoaded } from '../../lib/loaded';
import { appearancesOf, appearanceWords } from './appearance_words';

/** By which appearances a place is recognised: from where, of when, and in which light each is. */
export function RecognisedBy({ graph, place }: { graph: Graph; place: Place }) {
  const appearances = appearancesOf(place);
  if (appearances.length === 0) return null;
  return (
    <Section title={`Recognised by: ${appearances.length}`} heading={false}>
      <Appearances graph={graph} place={place} />
    </Section>
  );
}

function Appearances({ graph, place }: { graph: Graph; place: Place }) {
  const tours = useLoaded(calls.tours).value?.tours ?? [];
  return (
    <>
      <p class="soft small">
        What the chair compares with what it sees. Looks that it learnt later, by night for example, help
        where the light is other.
      </p>
      <ul class="choices">
        {appearancesOf(place).map((one, i) => (
          <li key={i} class="choice">
            {one.image !== null && (
              <img src={calls.imageThumbnailUrl(graph.map, one.image)} alt="" loading="lazy" />
            )}
            <span class="small">{appearanceWords(one, tours)}</span>
          </li>
        ))}
      </ul>
    </>
  );
}
