// SPDX-License-Identifier: Apache-2.0
import { useMemo, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Graph } from '../../api/types';
import { Notice } from '../../components/notice';
import { Section } from '../../components/section';
import { useLoaded } from '../../lib/loaded';
import { indexOf } from '../../lib/graph_index';
import { placeTitle } from '../../lib/whereabouts';
import { count, dateText } from '../../lib/words';
import { coverageOf } from './coverage';

const kShown = 20; // at first, and with each press

interface Props {
  graph: Graph;
  onChoose: (place: string) => void;
}

/** How well the tours have seen the house: by tour, where only one was, what is not joined, and what is hard to drive. */
export function CoverageCard({ graph, onChoose }: Props) {
  const { tours, seen_once, apart, weak } = useMemo(() => coverageOf(graph), [graph]);
  const weak_pairs = weak.map(({ id, from, to }) => ({ key: id, places: [from, to] }));
  const alone = seen_once.map((id) => ({ key: id, places: [id] }));
  return (
    <section class="card stack" aria-label="How well the house is seen">
      <h2>How well the house is seen</h2>
      {apart.map((part) => (
        <Notice key={part.join(' ')} tone="warn" still>
          No open way leads to {part.length === 1 ? '' : `${count(part.length, 'place')} around `}
          {placeTitle(graph, part[0] ?? '')}.
        </Notice>
      ))}
      <div>
        <Section title={`Ways that are hard to drive: ${weak.length}`} heading={false}>
          <p class="soft small">
            The chair may lose such a way. Driving the stretch once more on a tour often helps.
          </p>
          <Spots graph={graph} spots={weak_pairs} onChoose={onChoose} />
        </Section>
        {seen_once.length > 0 && (
          <Section title={`Places that one tour alone has seen: ${seen_once.length}`} heading={false}>
            <Spots graph={graph} spots={alone} onChoose={onChoose} />
          </Section>
        )}
        <Section title={`Tours in this map: ${tours.length}`} heading={false}>
          <Tours tours={tours} />
        </Section>
      </div>
    </section>
  );
}

function Tours({ tours }: { tours: ReturnType<typeof coverageOf>['tours'] }) {
  const known = useLoaded(calls.tours).value?.tours ?? [];
  return (
    <ul class="list">
      {tours.map(({ tour, pictures, places }) => {
        const brought = known.find((one) => one.id === tour);
        return (
          <li key={tour}>
            <strong>{brought?.name ?? tour}</strong>
            <span class="soft">
              {brought && `brought ${dateText(brought.created_us)}, `}
              {count(pictures, 'picture')} at {count(places, 'place')}
            </span>
          </li>
        );
      })}
    </ul>
  );
}

interface SpotsProps extends Props {
  spots: readonly { key: string; places: readonly string[] }[];
}

function Spots({ graph, spots, onChoose }: SpotsProps) {
  const [most, setMost] = useState(kShown);
  const { places } = indexOf(graph);
  return (
    <>
      {spots.length === 0 && <p class="soft">None.</p>}
      <ul class="list">
        {spots.slice(0, most).map(({ key, places: ends }) => (
          <li key={key}>
            <button type="button" class="place-row compact" onClick={() => onChoose(ends[0] ?? '')}>
              {ends.map((id) => (
                <img
                  key={id}
                  src={calls.imageThumbnailUrl(graph.map, places.get(id)?.prototype ?? '')}
                  alt=""
                  loading="lazy"
                />
              ))}
              <span>{ends.map((id) => placeTitle(graph, id)).join(' – ')}</span>
            </button>
          </li>
        ))}
      </ul>
      {spots.length > most && (
        <button type="button" class="button small" onClick={() => setMost(most + kShown)}>
          Show more
        </button>
      )}
    </>
  );
}
