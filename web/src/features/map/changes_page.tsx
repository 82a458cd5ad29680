// SPDX-License-Identifier: Apache-2.0
import { useMemo } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Difference, Graph, MapInfo } from '../../api/types';
import { Choice } from '../../components/field';
import { Loading } from '../../components/loading';
import { Notice } from '../../components/notice';
import { indexOf } from '../../lib/graph_index';
import { useLoaded } from '../../lib/loaded';
import { follow } from '../../lib/router';
import { alignedWith } from './aligned';
import { changesOf, type Change } from './changes';
import { DifferenceList, ToneLegend } from './difference_list';
import { marksOf } from './difference_marks';
import { titleIn } from './difference_words';
import { useEditor } from './editor';
import { GraphView } from './graph_view';
import { LinkedDrawings } from './linked_drawings';
import { mapAddress, pathOf, show } from './map_address';
import { MapHistory } from './map_history';
import { numbersOf, standing, statesOf, stateTitle, type TwoStates } from './states';

interface Props {
  map: MapInfo;
  graph: Graph; // of the map itself
  mayEdit: boolean;
}

/** How the map came about: two of its states beside each other, what is other between them, and all changes. */
export function ChangesPage({ map, graph, mayEdit }: Props) {
  const editor = useEditor(map, graph, null, mayEdit, () => undefined);
  const history = useLoaded(() => calls.history(map.id), graph.revision);
  return (
    <>
      <p class="soft">How the map became what it is, from the build to the latest change by a person.</p>
      <Loading of={history} what="The changes">
        {({ edits }) => {
          const stand = standing(changesOf(edits));
          if (stand.length === 0)
            return <Notice still>The map is as it was built: no change of anybody stands.</Notice>;
          return (
            <Compared map={map} graph={graph} stand={stand} states={statesOf(mapAddress.value.of, stand)} />
          );
        }}
      </Loading>
      <MapHistory editor={editor} />
    </>
  );
}

interface ComparedProps {
  map: MapInfo;
  graph: Graph;
  stand: readonly Change[];
  states: TwoStates;
}

function Compared({ map, graph, stand, states }: ComparedProps) {
  const newest = stand.at(-1)?.number ?? 0;
  const option = (number: number | null) => ({
    value: number === null ? '' : String(number),
    label: stateTitle(number, stand, graph),
  });
  const numbers = stand.map((one) => one.number).filter((one) => one !== newest);
  const go = (of: TwoStates) => show(map.id, { of: numbersOf(of), place: null });
  return (
    <>
      <div class="form-columns">
        <Choice
          label="Compare"
          value={String(states.from)}
          options={[0, ...numbers].map(option)}
          onChange={(value) => {
            const from = Number(value);
            go({ from, to: states.to !== null && states.to > from ? states.to : null });
          }}
        />
        <Choice
          label="With"
          value={states.to === null ? '' : String(states.to)}
          options={[...numbers.filter((one) => one > states.from), null].map(option)}
          onChange={(value) => go({ ...states, to: value === '' ? null : Number(value) })}
        />
      </div>
      <TwoGraphs
        key={`${states.from} ${states.to ?? ''} ${graph.revision}`}
        map={map}
        graph={graph}
        stand={stand}
        states={states}
      />
    </>
  );
}

function TwoGraphs({ map, graph, stand, states: { from, to } }: ComparedProps) {
  const loaded = useLoaded(
    () =>
      Promise.all([
        calls.formerGraph(map.id, from),
        to === null ? null : calls.formerGraph(map.id, to),
        calls.formerDifference(map.id, from, to),
      ]),
    graph.revision,
  );
  const titles = [stateTitle(from, stand, graph), stateTitle(to, stand, graph)] as const;
  return (
    <Loading of={loaded} what="The two states">
      {([before, later, difference]) => (
        <SideBySide
          now={graph}
          before={before}
          after={later ?? graph}
          difference={difference}
          titles={titles}
        />
      )}
    </Loading>
  );
}

interface SideProps {
  now: Graph;
  before: Graph;
  after: Graph;
  difference: Difference;
  titles: readonly [string, string];
}

const kNothing: readonly string[] = [];

function SideBySide({ now, before, after, difference, titles }: SideProps) {
  const place = mapAddress.value.place;
  const linked = useMemo(() => new LinkedDrawings(), []);
  const drawn = useMemo(() => {
    const aligned = alignedWith(before, after);
    const marks = marksOf(difference, aligned, after);
    // Each drawing shows its own state: what is gone stands in the earlier one alone, what is new in the later one.
    return [
      { graph: aligned, marks },
      { graph: after, marks: { ...marks, before: after } },
    ] as const;
  }, [before, after, difference]);
  const choose = (id: string) => show(now.map, { place: id });
  return (
    <>
      <ToneLegend />
      <div class="two-states">
        {drawn.map(({ graph, marks }, i) => (
          <figure key={i} class="stack tight">
            <figcaption>
              <strong>{i === 0 ? 'Before' : 'After'}</strong>
              <br />
              <span class="soft small">{titles[i]}</span>
            </figcaption>
            <GraphView
              graph={graph}
              belief={null}
              way={kNothing}
              chosen={place}
              marks={marks}
              linked={linked}
              onChoose={choose}
            />
          </figure>
        ))}
      </div>
      {place !== null && <ChosenPlace place={place} now={now} title={titleIn(after, before)(place)} />}
      <DifferenceList
        difference={difference}
        before={before}
        after={after}
        against={`From “${titles[0]}” to “${titles[1]}”.`}
        nothing="Nothing: both states are the same."
        chosen={place}
        onChoose={choose}
      />
    </>
  );
}

function ChosenPlace({ place, now, title }: { place: string; now: Graph; title: string }) {
  const there = indexOf(now).places.has(place);
  return (
    <p class="row" role="status">
      <span>
        Ringed in the drawings: <strong>{title}</strong>
      </span>
      {there ? (
        <a
          href={pathOf({ ...mapAddress.value, map: now.map, page: 'drawing', of: [], place })}
          onClick={follow}
        >
          Open it in the map as it is
        </a>
      ) : (
        <span class="soft">It is no place of the map any more.</span>
      )}
    </p>
  );
}
