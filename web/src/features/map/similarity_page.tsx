// SPDX-License-Identifier: Apache-2.0
import { useEffect, useMemo, useRef, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Graph, MapInfo, Similarity } from '../../api/types';
import { TextField } from '../../components/field';
import { Loading } from '../../components/loading';
import { Notice } from '../../components/notice';
import { useLoaded } from '../../lib/loaded';
import { follow, navigate } from '../../lib/router';
import { count } from '../../lib/words';
import { useAlike } from './alike';
import { CellCard } from './cell_card';
import { mapAddress, pathOf } from './map_address';
import { Matrix } from './matrix';
import type { Cell } from './matrix_view';
import { cellOf, cellWords, meantPicture, tourRuns, type Pictures } from './matrix_words';

const kMostEdges = 60; // between tours
const kSettledMs = 400; // the cursor has come to rest

interface Props {
  map: MapInfo;
  graph: Graph; // of the map itself
}

/** How alike all pictures of a map are to each other, as a matrix, with the two pictures of any of its cells. */
export function SimilarityPage({ map, graph }: Props) {
  const loaded = useLoaded(() => calls.similarity(map.id), graph.revision);
  if (loaded.problem?.status === 404)
    return (
      <Notice still>
        How alike the pictures are is not known: this map was not built on this server. Build it here from its
        tours, under{' '}
        <a href="/tours" onClick={follow}>
          Tours
        </a>
        .
      </Notice>
    );
  return (
    <Loading of={loaded} what="How alike the pictures are">
      {(similarity) =>
        similarity.images.length === 0 ? (
          <Notice still>The map has no pictures.</Notice>
        ) : (
          <Shown graph={graph} similarity={similarity} />
        )
      }
    </Loading>
  );
}

function usePictures(images: readonly string[]): Pictures {
  const tours = useLoaded(calls.tours).value?.tours;
  return useMemo(() => {
    const names = new Map((tours ?? []).map((one) => [one.id, one.name]));
    return { images, runs: tourRuns(images), tourName: (tour) => names.get(tour) ?? tour };
  }, [images, tours]);
}

/** The cell that was chosen; the address follows once it has come to rest, and leads back to it. */
function useCursor(map: string, size: number): [Cell | null, (cell: Cell) => void] {
  const said = mapAddress.value.of.join('/');
  const [cursor, setCursor] = useState(() => cellOf(mapAddress.peek().of, size));
  const written = useRef(said);
  useEffect(() => {
    if (said === written.current) return;
    written.current = said;
    setCursor(cellOf(mapAddress.peek().of, size));
  }, [said, size]);
  useEffect(() => {
    if (!cursor) return;
    const timer = setTimeout(() => {
      const of = [cursor.column + 1, cursor.row + 1];
      if (mapAddress.peek().page !== 'similarity' || of.join('/') === written.current) return;
      written.current = of.join('/');
      navigate(pathOf({ ...mapAddress.peek(), map, of }), true);
    }, kSettledMs);
    return () => clearTimeout(timer);
  }, [cursor, map]);
  return [cursor, setCursor];
}

function Shown({ graph, similarity }: { graph: Graph; similarity: Similarity }) {
  const { images, tile_px, levels } = similarity;
  const pictures = usePictures(images);
  const [cursor, setCursor] = useCursor(graph.map, images.length);
  const [hovered, setHovered] = useState<Cell | null>(null);
  const [asked, setAsked] = useState(0);
  const alike = useAlike(graph.map, images, cursor, kSettledMs);
  const sheet = useMemo(() => ({ count: images.length, tile_px, levels }), [images, tile_px, levels]);
  const edges = useMemo(() => pictures.runs.slice(1, kMostEdges).map((one) => one.start), [pictures]);
  const later = useMemo(() => {
    const compared = new Set(images);
    return graph.places.flatMap((one) => one.members).filter((one) => !compared.has(one)).length;
  }, [graph, images]);
  return (
    <>
      {later > 0 && (
        <Notice still>
          {count(later, 'picture')} of tours that were added since the build {later === 1 ? 'is' : 'are'} not
          in it: build the map again to compare all.
        </Notice>
      )}
      <p class="soft">
        Each of {count(images.length, 'picture')} against every other, in the order of the tours. Dark spots
        away from the diagonal are places that were passed again, or that look alike.
      </p>
      <div class="map-layout">
        <section class="card stack" aria-label="Matrix">
          <Matrix
            map={graph.map}
            images={images}
            sheet={sheet}
            revision={graph.revision}
            edges={edges}
            cursor={cursor}
            hovered={hovered}
            asked={asked}
            onChoose={setCursor}
            onHover={setHovered}
          />
          <Legend />
        </section>
        <div class="map-side">
          <CellCard graph={graph} pictures={pictures} cursor={cursor} hovered={hovered} alike={alike} />
          <GoTo
            graph={graph}
            pictures={pictures}
            onGo={(cell) => {
              setCursor(cell);
              setAsked((before) => before + 1);
            }}
          />
        </div>
      </div>
      <Spoken words={cursor ? [cellWords(cursor, pictures, graph), alike ?? ''].join(' ').trim() : ''} />
    </>
  );
}

/** What the cursor is at, for those who do not see it, once it has come to rest. */
function Spoken({ words }: { words: string }) {
  const [said, setSaid] = useState('');
  useEffect(() => {
    const timer = setTimeout(() => setSaid(words), kSettledMs);
    return () => clearTimeout(timer);
  }, [words]);
  return (
    <p class="hidden-text" role="status" data-testid="cell-words">
      {said}
    </p>
  );
}

function Legend() {
  return (
    <ul class="matrix-legend small" aria-label="Colours">
      <li>
        <span class="swatch alike" aria-hidden="true" />
        Above the diagonal, from nothing in common (white) to alike (dark blue)
      </li>
      <li>
        <span class="swatch one" aria-hidden="true" />
        Below it, one place (green)
      </li>
      <li>
        <span class="swatch open" aria-hidden="true" />
        Left open (orange)
      </li>
      <li>
        <span class="swatch apart" aria-hidden="true" />
        Kept apart (red)
      </li>
    </ul>
  );
}

/** Two pictures by their numbers or places. */
function GoTo({ graph, pictures, onGo }: { graph: Graph; pictures: Pictures; onGo: (cell: Cell) => void }) {
  const [a, setA] = useState('');
  const [b, setB] = useState('');
  const [unknown, setUnknown] = useState<string | null>(null);
  const hint = `A number from 1 to ${pictures.images.length}, or a place.`;
  const go = () => {
    const [column, row] = [meantPicture(a, pictures, graph), meantPicture(b, pictures, graph)];
    setUnknown(column === null ? a : row === null ? b : null);
    if (column !== null && row !== null) onGo({ column, row });
  };
  return (
    <form
      class="card stack"
      aria-label="Go to two pictures"
      onSubmit={(event) => {
        event.preventDefault();
        go();
      }}
    >
      <h2>Go to two pictures</h2>
      <TextField label="A, along the top" hint={hint} value={a} onInput={setA} />
      <TextField label="B, down the side" hint={hint} value={b} onInput={setB} />
      {unknown !== null && <Notice tone="bad">The map has no picture or place “{unknown.trim()}”.</Notice>}
      <div>
        <button type="submit" class="button main">
          Show both
        </button>
      </div>
    </form>
  );
}
