// SPDX-License-Identifier: Apache-2.0
import * as calls from '../../api/calls';
import type { Graph } from '../../api/types';
import { Section } from '../../components/section';
import { follow } from '../../lib/router';
import { placeTitle, titlesApart } from '../../lib/whereabouts';
import { mapAddress, pathOf } from './map_address';
import type { Cell } from './matrix_view';
import { pictureTitle, placeOf, verdictOf, verdictWords, type Pictures, type Verdict } from './matrix_words';
import { PairView } from './pair_view';
import { SmallMap } from './small_map';

const kPills: Readonly<Record<Verdict, { words: string; tone: string } | null>> = {
  same: null,
  one: { words: 'One place', tone: 'good' },
  open: { words: 'Left open', tone: 'warn' },
  apart: { words: 'Kept apart', tone: 'bad' },
  none: null,
};

interface Props {
  graph: Graph;
  pictures: Pictures;
  cursor: Cell | null; // what was chosen
  hovered: Cell | null; // what the mouse is over, shown meanwhile
  alike: string | null; // how alike those of the cursor are, where it is known
}

/** The two pictures of a cell beside each other, where they are, and how the map has them. */
export function CellCard({ graph, pictures, cursor, hovered, alike }: Props) {
  const cell = hovered ?? cursor;
  if (!cell)
    return (
      <section class="card stack" aria-label="The two pictures">
        <h2>The two pictures</h2>
        <p class="soft">Press a dot of the matrix, or go to two pictures by number or place.</p>
        <SmallMap graph={graph} marks={[]} />
      </section>
    );
  const sides = [
    { letter: 'A', picture: cell.column, where: 'along the top' },
    { letter: 'B', picture: cell.row, where: 'down the side' },
  ].map((one) => ({ ...one, place: placeOf(one.picture, pictures, graph) }));
  const [place_a, place_b] = [sides[0]?.place ?? null, sides[1]?.place ?? null];
  const titles =
    place_a !== null && place_b !== null
      ? titlesApart(graph, place_a, place_b)
      : [place_a, place_b].map((one) => (one === null ? null : placeTitle(graph, one)));
  const pill = kPills[verdictOf(cell, pictures, graph)];
  return (
    <section class="card stack" aria-label="The two pictures">
      <h2>The two pictures</h2>
      <div class="cell-pictures">
        {sides.map(({ letter, picture, where, place }, i) => (
          <figure key={letter} class="stack tight">
            <img
              class="picture"
              src={calls.imageThumbnailUrl(graph.map, pictures.images[picture] ?? '')}
              alt={titles[i] ?? 'A picture at no place of the map'}
            />
            <figcaption class="stack tight">
              <span class="lettered">
                <span class="letter">{letter}</span>
                <strong>
                  <PlaceLink graph={graph} place={place} title={titles[i] ?? null} />
                </strong>
              </span>
              <span class="soft small">
                {pictureTitle(picture, pictures)}, {where}
              </span>
            </figcaption>
          </figure>
        ))}
      </div>
      <p>
        {pill && <span class={`pill ${pill.tone}`}>{pill.words}</span>} {verdictWords(cell, pictures, graph)}
        {!hovered && alike !== null && ` ${alike}`}
      </p>
      <SmallMap
        graph={graph}
        marks={sides.flatMap(({ letter, place }) => (place === null ? [] : [{ letter, place }]))}
      />
      {cursor && cursor.column !== cursor.row && (
        <Evidence key={`${cursor.column} ${cursor.row}`} graph={graph} pictures={pictures} cell={cursor} />
      )}
    </section>
  );
}

function PlaceLink({ graph, place, title }: { graph: Graph; place: string | null; title: string | null }) {
  if (place === null) return <span>At no place</span>;
  const href = pathOf({ ...mapAddress.value, map: graph.map, page: 'drawing', of: [], place });
  return (
    <a href={href} onClick={follow}>
      {title}
    </a>
  );
}

/** What both have in common, and what else may be wrong there. */
function Evidence({ graph, pictures, cell }: { graph: Graph; pictures: Pictures; cell: Cell }) {
  const [a, b] = [pictures.images[cell.column] ?? '', pictures.images[cell.row] ?? ''];
  const place = placeOf(cell.column, pictures, graph);
  const titles = [pictureTitle(cell.column, pictures), pictureTitle(cell.row, pictures)] as const;
  return (
    <div>
      <Section title="What is in both pictures" heading={false}>
        <PairView map={graph.map} images={[a, b]} titles={titles} />
        {place !== null && (
          <p>
            <a
              href={pathOf({ ...mapAddress.value, map: graph.map, page: 'evidence', of: [], place })}
              onClick={follow}
            >
              What may be wrong at the place of A
            </a>
          </p>
        )}
      </Section>
    </div>
  );
}
