// SPDX-License-Identifier: Apache-2.0
import { useMemo, useState } from 'preact/hooks';
import type { PlanLines, PlanPose } from '../../api/types';
import { boundsOf, dotPath, pressedAt, viewBoxOf, wallPath, wayPath, type Spot } from './plan_geometry';
import { arrowOf } from './plan_pose';

/** Something at a spot of the plan. */
export interface Mark extends Spot {
  key: string;
  kind: 'place' | 'pinned' | 'chosen' | 'chair' | 'goal';
  label: string; // drawn beside it; empty: nothing
}

interface Props {
  lines: PlanLines;
  marks: readonly Mark[];
  way?: readonly Spot[]; // that the chair drives
  pose?: PlanPose | null; // where the plan has the chair
  words: string; // the same for those who do not see it
  small?: boolean;
  onPress?: (spot: Spot) => void;
}

const kZooms = [1, 1.5, 2, 3, 4, 6];
const kRadii = { place: 4, pinned: 6, chosen: 9, chair: 11, goal: 9 } as const;
const kText_px = 14;
const kSmall_px = 340; // high at most

const isDot = ({ kind, label }: Mark) => kind === 'place' && label === '';

/** A plan from above with what is on it. Signs and words keep their size however large the building is. */
export function PlanDrawing({ lines, marks, way = [], pose = null, words, small = false, onPress }: Props) {
  const [zoom, setZoom] = useState(0);
  const walls = useMemo(() => wallPath(lines), [lines]);
  // Once for each set of places, so that nothing moves while the chair does.
  const spots = marks.filter((one) => one.kind !== 'chair');
  const extent = spots.map((one) => `${one.x_m} ${one.y_m}`).join();
  // eslint-disable-next-line react-hooks/exhaustive-deps
  const bounds = useMemo(() => boundsOf(lines, spots), [lines, extent]);
  // Thousands of places may have nothing to say but where they are: all of these are one stroke.
  const dots = dotPath(marks.filter(isDot));
  const arrow = pose && arrowOf(pose);
  const width_m = bounds.right_m - bounds.left_m;
  const height_m = bounds.top_m - bounds.bottom_m;
  const press = (event: MouseEvent & { currentTarget: Element }) => {
    const box = event.currentTarget.getBoundingClientRect();
    onPress?.(
      pressedAt(bounds, (event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height),
    );
  };
  const width = small
    ? `min(100%, ${Math.round((kSmall_px * width_m) / height_m)}px)`
    : `${100 * (kZooms[zoom] ?? 1)}%`;
  return (
    <div class="stack tight">
      {/* Scrolled by keys as well. */}
      <div
        class={small ? 'floor-plan small' : 'floor-plan'}
        role={small ? undefined : 'group'}
        aria-label={small ? undefined : 'The plan; arrow keys move it once it is enlarged'}
        tabIndex={small ? undefined : 0}
      >
        <div
          class={onPress ? 'floor-plan-paper pressed' : 'floor-plan-paper'}
          style={{ width, aspectRatio: `${width_m} / ${height_m}` }}
          data-testid="floor-plan"
          onClick={onPress ? press : undefined}
        >
          <svg
            viewBox={viewBoxOf(bounds)}
            preserveAspectRatio="none"
            role="img"
            aria-label={words}
            class="floor-plan-walls"
          >
            <path class="walls" d={walls} />
            {pose && <path class="cloud" d={dotPath(pose.particles)} />}
            {way.length > 1 && <path class="way" d={wayPath(way)} />}
            <path class="dots" d={dots} />
          </svg>
          {marks
            .filter((one) => !isDot(one))
            .map((one) => (
              <MarkSign key={one.key} mark={one} at={shares(one)} />
            ))}
          {arrow && <Arrow theta_rad={arrow.theta_rad} at={shares(arrow)} />}
        </div>
      </div>
      {!small && (
        <div class="row" role="group" aria-label="Size of the plan">
          <button
            type="button"
            class="button"
            aria-label="Enlarge"
            disabled={zoom === kZooms.length - 1}
            onClick={() => setZoom(zoom + 1)}
          >
            +
          </button>
          <button
            type="button"
            class="button"
            aria-label="Make smaller"
            disabled={zoom === 0}
            onClick={() => setZoom(zoom - 1)}
          >
            −
          </button>
        </div>
      )}
    </div>
  );

  function shares({ x_m, y_m }: Spot) {
    return { x: (x_m - bounds.left_m) / width_m, y: (bounds.top_m - y_m) / height_m };
  }
}

/** Where the plan has the chair, and how it faces. */
function Arrow({ theta_rad, at }: { theta_rad: number; at: { x: number; y: number } }) {
  return (
    <svg
      class="floor-plan-mark arrow"
      style={{ left: `${100 * at.x}%`, top: `${100 * at.y}%` }}
      width="1"
      height="1"
      aria-hidden="true"
      data-kind="arrow"
    >
      <path d="M15 0L-9 9L-4 0L-9 -9Z" transform={`rotate(${Math.round((-180 * theta_rad) / Math.PI)})`} />
    </svg>
  );
}

/** A sign with its words, to the left of it where it is at the right edge. For the eyes alone: `words` tells the rest. */
function MarkSign({ mark, at }: { mark: Mark; at: { x: number; y: number } }) {
  const radius = kRadii[mark.kind];
  const left = at.x > 0.75;
  const beside = radius + 4;
  return (
    <svg
      class={`floor-plan-mark ${mark.kind}`}
      style={{ left: `${100 * at.x}%`, top: `${100 * at.y}%` }}
      width="1"
      height="1"
      aria-hidden="true"
      data-kind={mark.kind}
    >
      {mark.kind === 'goal' ? (
        <path d={`M0 ${-radius}L${radius} 0L0 ${radius}L${-radius} 0Z`} />
      ) : (
        <circle r={radius} />
      )}
      {mark.label !== '' && (
        <text
          x={left ? -beside : beside}
          dy="0.35em"
          text-anchor={left ? 'end' : 'start'}
          style={{ fontSize: `${kText_px}px` }}
        >
          {mark.label}
        </text>
      )}
    </svg>
  );
}
