// SPDX-License-Identifier: Apache-2.0
import { useMemo, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Pair } from '../../api/types';
import { useLoaded } from '../../lib/loaded';
import { pairMarks, pairWords, type PairMark } from './pair_marks';

interface Props {
  map: string;
  images: readonly [string, string];
  titles: readonly [string, string];
}

const kUsualRatio = 4; // of a strip all round, until the picture says its own

/** Two pictures below each other, turned so that the same things lie below each other, with what is in both. */
export function PairView({ map, images, titles }: Props) {
  const [ratio, setRatio] = useState(kUsualRatio);
  const [marked, setMarked] = useState(true);
  const { value: pair, problem } = useLoaded(() => calls.pair(map, ...images));
  const shift = pair?.shift ?? null;
  return (
    <div class="stack tight">
      <div class="pair-view">
        {images.map((image, i) => (
          <Half
            key={image}
            src={calls.imageThumbnailUrl(map, image)}
            alt={titles[i] ?? ''}
            shift={i === 1 ? shift : null}
            ratio={ratio}
            onRatio={i === 0 ? setRatio : null}
          />
        ))}
        {pair && marked && <Marks pair={pair} />}
      </div>
      {problem && (
        <p class="soft small">What both pictures have in common could not be loaded. {problem.message}</p>
      )}
      {pair && (
        <>
          <p class="soft small">{pairWords(pair)}</p>
          {pair.matches.length > 0 && (
            <div class="row small">
              <label class="check">
                <input type="checkbox" checked={marked} onChange={() => setMarked(!marked)} />
                Mark what is in both
              </label>
              <span class="row" aria-hidden="true">
                <span class="mark-key rare">rare</span>
                <span class="mark-key usual">usual</span>
                <span class="mark-key common">common</span>
              </span>
            </div>
          )}
        </>
      )}
    </div>
  );
}

interface HalfProps {
  src: string;
  alt: string;
  shift: number | null;
  ratio: number;
  onRatio: ((ratio: number) => void) | null;
}

/** A picture all round a place has no edge: moved to the left, it goes on at the right. */
function Half({ src, alt, shift, ratio, onRatio }: HalfProps) {
  const moved = shift === null ? 0 : ((shift % 1) + 1) % 1;
  return (
    <div class="half" style={{ aspectRatio: String(ratio) }}>
      <img
        src={src}
        alt={alt}
        style={{ left: `${-100 * moved}%` }}
        onLoad={({ currentTarget: { naturalWidth, naturalHeight } }) => {
          if (naturalHeight > 0) onRatio?.(naturalWidth / naturalHeight);
        }}
      />
      {moved > 0 && <img src={src} alt="" style={{ left: `${100 * (1 - moved)}%` }} />}
    </div>
  );
}

function Marks({ pair }: { pair: Pair }) {
  const marks = useMemo(() => pairMarks(pair), [pair]);
  return (
    <svg class="pair-marks" aria-hidden="true">
      {marks.map((mark, i) => (
        <OneMark key={i} mark={mark} />
      ))}
    </svg>
  );
}

function OneMark({ mark: { number, rarity, a, b } }: { mark: PairMark }) {
  const ends = [
    [`${100 * a.x}%`, `${50 * a.y}%`],
    [`${100 * b.x}%`, `${50 + 50 * b.y}%`],
  ] as const;
  const [[x1, y1], [x2, y2]] = ends;
  return (
    <g class={rarity}>
      {number !== null && <line x1={x1} y1={y1} x2={x2} y2={y2} />}
      {ends.map(([x, y], i) => (
        <circle key={i} cx={x} cy={y} r={number === null ? 4 : 10} />
      ))}
      {number !== null &&
        ends.map(([x, y], i) => (
          <text key={i} x={x} y={y} dy="0.35em">
            {number}
          </text>
        ))}
    </g>
  );
}
