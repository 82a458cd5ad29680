// SPDX-License-Identifier: Apache-2.0
import { useEffect, useRef } from 'preact/hooks';
import type { Doubt, Edit, Graph } from '../../api/types';
import { Section } from '../../components/section';
import { indexOf } from '../../lib/graph_index';
import { follow } from '../../lib/router';
import { placeTitle, titlesApart } from '../../lib/whereabouts';
import { percent } from '../../lib/words';
import { reasonSentence } from '../../words/reasons';
import { kDoubtKinds, questionOf, setAside, setAsideWords, standWords, worthWords } from './doubt_words';
import { effectsWords } from './edit_words';
import type { Editor } from './editor';
import { mapAddress, pathOf } from './map_address';
import { MassBar } from './mass_bar';
import { PairView } from './pair_view';

interface Props {
  editor: Editor;
  doubt: Doubt;
  answered: boolean; // in the draft that is open
  begun: boolean; // the reader has asked for this one: it comes into view
  onAnswer: (edits: Edit[]) => void;
}

/** One doubt: two pictures, how the map stands, what speaks for and against, and the answer with what it would do. */
export function DoubtCard({ editor, doubt, answered, begun, onAnswer }: Props) {
  const { graph, mayEdit, busy } = editor;
  const question = questionOf(doubt);
  const heading = useRef<HTMLHeadingElement>(null);
  useEffect(() => {
    if (begun) heading.current?.focus();
  }, [begun]);
  const titles = titlesApart(graph, doubt.place_a, doubt.place_b);
  const { masses_before, masses_after } = doubt;
  const left_open = setAsideWords(doubt);
  const unsure = left_open === null ? [setAside(doubt)] : []; // it is known already
  return (
    <section class="card stack doubt" aria-label={question.text}>
      <div class="row apart">
        <h2 tabIndex={-1} ref={heading}>
          {question.text}
        </h2>
        <span class="pill">{kDoubtKinds[doubt.kind]}</span>
      </div>
      <PairView map={graph.map} images={[doubt.image_a, doubt.image_b]} titles={titles} />
      <p class="row">
        <PlaceLink graph={graph} place={doubt.place_a} title={titles[0]} />
        {doubt.place_a !== doubt.place_b && (
          <>
            <span aria-hidden="true">–</span>
            <PlaceLink graph={graph} place={doubt.place_b} title={titles[1]} />
          </>
        )}
      </p>
      <p>
        <strong>{standWords(doubt)}</strong> {worthWords(doubt)}
      </p>
      {left_open !== null && (
        <p>
          <span class="pill warn">{left_open}</span>
        </p>
      )}
      {doubt.reasons.map((reason, i) => (
        <p key={i} class="soft">
          {reasonSentence(reason)}
        </p>
      ))}
      {masses_before && masses_after && (
        <div class="masses">
          <MassBar title="By the pictures alone" masses={masses_before} />
          <MassBar title="With its surroundings" masses={masses_after} />
        </div>
      )}
      {doubt.neighbours.length > 0 && <Neighbours graph={graph} doubt={doubt} />}
      {answered && (
        <p>
          <span class="pill good">Answered in this draft</span>
        </p>
      )}
      {mayEdit && (
        <div class="answers">
          {(
            [
              [question.yes, doubt.if_yes],
              [question.no, doubt.if_no],
            ] as const
          ).map(([words, edits]) => (
            <div key={words} class="stack tight">
              <button type="button" class="button main" disabled={busy} onClick={() => onAnswer(edits)}>
                {words}
              </button>
              <span class="soft small">{effectsWords(edits, graph)}</span>
            </div>
          ))}
          <div class="stack tight">
            <button type="button" class="button" disabled={busy} onClick={() => onAnswer(unsure)}>
              {unsure.length > 0 ? 'Not sure' : 'Still not sure'}
            </button>
            <span class="soft small">{effectsWords(unsure, graph)}</span>
          </div>
        </div>
      )}
    </section>
  );
}

function PlaceLink({ graph, place, title }: { graph: Graph; place: string; title: string }) {
  if (!indexOf(graph).places.has(place)) return <span>{title}</span>;
  const href = pathOf({ ...mapAddress.value, map: graph.map, page: 'drawing', place });
  return (
    <a href={href} onClick={follow}>
      {title}
    </a>
  );
}

function Neighbours({ graph, doubt }: { graph: Graph; doubt: Doubt }) {
  const of = (yes: boolean) => doubt.neighbours.filter((one) => one.for === yes);
  return (
    <Section
      title={`What lies around: ${of(true).length} for it, ${of(false).length} against it`}
      heading={false}
    >
      <ul class="list">
        {[...of(true), ...of(false)].map((one) => (
          <li key={`${one.place_a} ${one.place_b}`}>
            <span class="row">
              <span class={`pill ${one.for ? 'good' : 'bad'}`}>{one.for ? '+ for it' : '− against it'}</span>
              <PlaceLink graph={graph} place={one.place_a} title={placeTitle(graph, one.place_a)} />
              <span aria-hidden="true">–</span>
              <PlaceLink graph={graph} place={one.place_b} title={placeTitle(graph, one.place_b)} />
            </span>
            <span class="soft small">counted {percent(one.weight)}</span>
          </li>
        ))}
      </ul>
    </Section>
  );
}
