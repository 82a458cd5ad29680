// SPDX-License-Identifier: Apache-2.0
import { useEffect, useId, useLayoutEffect, useRef, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import { count as counted } from '../../lib/words';
import { watchHands, type Hands } from '../../lib/hands';
import {
  cellAt,
  centred,
  keyStep,
  levelOf,
  moved,
  showing,
  tilesInView,
  wholeView,
  within,
  zoomed,
  type Cell,
  type MatrixView,
  type Sheet,
  type Size,
} from './matrix_view';
import { PictureStrip } from './picture_strip';

const kZoom = 1.6; // by a button or a key
const kCloseUp_px = 14; // a picture, where somebody asks for a cell by its numbers
const kFar = 10; // as far with Shift
const kCoarser = 2; // levels: shown until the finer tiles have come

interface Props {
  map: string;
  images: readonly string[];
  sheet: Sheet;
  revision: number; // of the map
  edges: readonly number[]; // where tours begin
  cursor: Cell | null;
  hovered: Cell | null;
  asked: number; // grows with each time that the cursor is to come into the middle
  onChoose: (cell: Cell) => void;
  onHover: (cell: Cell | null) => void;
}

/** The matrix: it moves and grows under hands and keys, and only what is in view is asked for. */
export function Matrix(props: Props) {
  const { map, images, sheet, revision, cursor, hovered, asked, onChoose, onHover } = props;
  const { count, levels } = sheet;
  const box = useRef<HTMLDivElement>(null);
  const help = useId();
  const [size, setSize] = useState<Size>({ width: 0, height: 0 });
  const [view, setView] = useState<MatrixView>({ x: 0, y: 0, scale: 1 });
  const ready = size.width > 0;
  const middle = { x: size.width / 2, y: size.height / 2 };
  const grow = (factor: number, at = middle) => setView((before) => zoomed(before, factor, at, count, size));
  const hands: Hands = {
    move: (dx, dy) => setView((before) => moved(before, dx, dy, count, size)),
    zoom: grow,
    press: (at) => {
      const cell = cellAt(view, at, count);
      if (cell) onChoose(cell);
    },
    hover: (at) => onHover(at && cellAt(view, at, count)),
  };
  const latest = useRef(hands);
  latest.current = hands;
  useLayoutEffect(() => {
    const element = box.current;
    if (!element) return;
    const end = watchHands(element, () => latest.current);
    const sizes = new ResizeObserver(() =>
      setSize({ width: element.clientWidth, height: element.clientHeight }),
    );
    sizes.observe(element);
    return () => {
      end();
      sizes.disconnect();
    };
  }, []);
  const shownAt = useRef(0); // the width that the view was made for
  useEffect(() => {
    if (!ready) return;
    setView((before) => (shownAt.current === 0 ? wholeView(count, size) : within(before, count, size)));
    shownAt.current = size.width;
  }, [ready, count, size]);
  useEffect(() => {
    if (ready && cursor) setView((before) => showing(before, cursor, count, size));
  }, [ready, cursor, count, size]);
  useEffect(() => {
    if (ready && cursor && asked > 0) setView((before) => centred(before, cursor, kCloseUp_px, count, size));
    // Asked for once; where the cursor goes afterwards, it is followed no more than it has to be.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [ready, asked]);

  const keys = (event: KeyboardEvent) => {
    if (!ready || event.ctrlKey || event.altKey || event.metaKey) return;
    const step = keyStep(view.scale) * (event.shiftKey ? kFar : 1);
    const ways: Readonly<Record<string, readonly [number, number]>> = {
      ArrowLeft: [-step, 0],
      ArrowRight: [step, 0],
      ArrowUp: [0, -step],
      ArrowDown: [0, step],
    };
    const way = ways[event.key];
    const at = cursor
      ? { x: (cursor.column + 0.5 - view.x) * view.scale, y: (cursor.row + 0.5 - view.y) * view.scale }
      : middle;
    if (way) {
      const from = cursor ?? cellAt(view, middle, count) ?? { column: 0, row: 0 };
      const inside = (one: number) => Math.max(0, Math.min(count - 1, one));
      onChoose({ column: inside(from.column + way[0]), row: inside(from.row + way[1]) });
    } else if (event.key === '+' || event.key === '=') grow(kZoom, at);
    else if (event.key === '-') grow(1 / kZoom, at);
    else if (event.key === '0') setView(wholeView(count, size));
    else return;
    event.preventDefault();
  };

  const level = levelOf(view.scale, levels);
  return (
    <div class="stack">
      <div class="matrix">
        <PictureStrip
          map={map}
          images={images}
          from={view.x}
          scale={view.scale}
          length_px={size.width}
          mark={cursor?.column ?? null}
          letter="A"
        />
        <PictureStrip
          map={map}
          images={images}
          from={view.y}
          scale={view.scale}
          length_px={size.height}
          mark={cursor?.row ?? null}
          letter="B"
          upright
        />
        <div
          class="matrix-box"
          ref={box}
          tabIndex={0}
          role="application"
          aria-label="How alike all pictures are"
          aria-describedby={help}
          data-testid="matrix"
          data-level={level}
          onKeyDown={keys}
        >
          {ready && (
            <Tiles map={map} sheet={sheet} revision={revision} view={view} size={size} level={level} />
          )}
          {props.edges.map((at) => (
            <TourEdge key={at} at={at} view={view} size={size} />
          ))}
          {hovered && <Cross cell={hovered} view={view} slight />}
          {cursor && <Cross cell={cursor} view={view} />}
        </div>
      </div>
      <div class="row apart">
        <span class="soft small" data-testid="matrix-scale">
          {level === 0
            ? 'Each dot is a pair of pictures.'
            : `At this size a dot stands for ${counted(2 ** level, 'picture')} each way.`}
        </span>
        <div class="graph-tools beside" role="group" aria-label="Size of the matrix">
          <button type="button" aria-label="Larger" onClick={() => grow(kZoom)}>
            +
          </button>
          <button type="button" aria-label="Smaller" onClick={() => grow(1 / kZoom)}>
            −
          </button>
          <button type="button" aria-label="Show all" onClick={() => setView(wholeView(count, size))}>
            ⤢
          </button>
        </div>
      </div>
      <p class="soft small" id={help}>
        Drag it to move it; turn the wheel or use two fingers to enlarge it; press a dot to choose its two
        pictures. By keyboard, arrow keys go to other pictures, with Shift ten times as far; + and − enlarge
        and shrink it, 0 shows all.
      </p>
    </div>
  );
}

interface TilesProps {
  map: string;
  sheet: Sheet;
  revision: number;
  view: MatrixView;
  size: Size;
  level: number;
}

function Tiles({ map, sheet, revision, view, size, level }: TilesProps) {
  const edge = (from: number, at: number, length_px: number) =>
    Math.max(0, Math.min(length_px, Math.round((at - from) * view.scale)));
  const [left, right] = [edge(view.x, 0, size.width), edge(view.x, sheet.count, size.width)];
  const [top, bottom] = [edge(view.y, 0, size.height), edge(view.y, sheet.count, size.height)];
  const coarse = Math.min(sheet.levels - 1, level + kCoarser);
  const tiles = [
    ...(coarse > level ? tilesInView(view, sheet, size, coarse) : []),
    ...tilesInView(view, sheet, size, level),
  ];
  const px = (n: number) => `${n}px`;
  return (
    <div
      class="matrix-sheet"
      style={{ left: px(left), top: px(top), width: px(right - left), height: px(bottom - top) }}
    >
      {tiles.map((one) => (
        <img
          key={`${one.level}/${one.column}/${one.row}`}
          src={calls.similarityTileUrl(map, one.level, one.column, one.row, revision)}
          alt=""
          draggable={false}
          style={{
            left: px(one.left - left),
            top: px(one.top - top),
            width: px(one.width),
            height: px(one.height),
          }}
        />
      ))}
    </div>
  );
}

/** Where another tour begins. */
function TourEdge({ at, view, size }: { at: number; view: MatrixView; size: Size }) {
  const [x, y] = [Math.round((at - view.x) * view.scale), Math.round((at - view.y) * view.scale)];
  return (
    <>
      {x > 0 && x < size.width && <span class="tour-edge" style={{ left: `${x}px` }} />}
      {y > 0 && y < size.height && <span class="tour-edge level" style={{ top: `${y}px` }} />}
    </>
  );
}

function Cross({ cell, view, slight = false }: { cell: Cell; view: MatrixView; slight?: boolean }) {
  const length = Math.max(1, Math.round(view.scale));
  const left = Math.round((cell.column - view.x) * view.scale);
  const top = Math.round((cell.row - view.y) * view.scale);
  const [across, down] = [
    { left: `${left}px`, width: `${length}px` },
    { top: `${top}px`, height: `${length}px` },
  ];
  const kind = slight ? 'cross slight' : 'cross';
  return (
    <>
      <span class={`${kind} upright`} style={across} />
      <span class={`${kind} level`} style={down} />
      {!slight && <span class="cross cell" style={{ ...across, ...down }} />}
    </>
  );
}
