// SPDX-License-Identifier: Apache-2.0

interface Point {
  x: number;
  y: number;
}

/** What hands ask for, at points from the upper left corner of what they work on. */
export interface Hands {
  move: (dx: number, dy: number) => void;
  zoom: (factor: number, at: Point) => void;
  press: (at: Point) => void;
  hover: (at: Point | null) => void;
}

const kStill_px = 5; // a press may move as far
const kLine_px = 16; // of a wheel that counts lines
const kHoverMs = 60; // between two tellings

/** Mouse, touch and wheel: one finger or the mouse moves, two fingers and the wheel enlarge, a press chooses. Returns its end. */
export function watchHands(box: HTMLElement, hands: () => Hands): () => void {
  const fingers = new Map<number, Point>();
  let begun: Point | null = null; // of a press, until it moves too far
  let hovered: Point | null = null;
  let timer: ReturnType<typeof setTimeout> | undefined;

  const pointOf = (event: MouseEvent): Point => {
    const { left, top } = box.getBoundingClientRect();
    return { x: event.clientX - left, y: event.clientY - top };
  };
  const hover = (at: Point | null) => {
    hovered = at;
    timer ??= setTimeout(() => {
      timer = undefined;
      hands().hover(hovered);
    }, kHoverMs);
  };
  const down = (event: PointerEvent) => {
    if (event.button !== 0) return;
    box.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, pointOf(event));
    begun = fingers.size === 1 ? pointOf(event) : null;
  };
  const move = (event: PointerEvent) => {
    const at = pointOf(event);
    const before = fingers.get(event.pointerId);
    if (!before) {
      if (event.pointerType === 'mouse') hover(at);
      return;
    }
    if (begun && Math.hypot(at.x - begun.x, at.y - begun.y) <= kStill_px) return;
    begun = null;
    const [other] = [...fingers].filter(([id]) => id !== event.pointerId).map(([, one]) => one);
    fingers.set(event.pointerId, at);
    if (!other) {
      hands().move(at.x - before.x, at.y - before.y);
      return;
    }
    const apart = (one: Point) => Math.max(1, Math.hypot(one.x - other.x, one.y - other.y));
    hands().zoom(apart(at) / apart(before), { x: (at.x + other.x) / 2, y: (at.y + other.y) / 2 });
    hands().move((at.x - before.x) / 2, (at.y - before.y) / 2);
  };
  const up = (event: PointerEvent) => {
    if (!fingers.delete(event.pointerId)) return;
    if (begun && event.type === 'pointerup') hands().press(begun);
    begun = null;
  };
  const leave = () => hover(null);
  const wheel = (event: WheelEvent) => {
    event.preventDefault();
    const length = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? kLine_px : 1);
    // A pinch on a touchpad comes as a wheel with Ctrl, in smaller steps.
    const at = pointOf(event);
    hands().zoom(Math.exp(-length * (event.ctrlKey ? 0.01 : 0.002)), at);
    hover(at); // something else lies under the mouse now
  };
  box.addEventListener('pointerdown', down);
  box.addEventListener('pointermove', move);
  box.addEventListener('pointerup', up);
  box.addEventListener('pointercancel', up);
  box.addEventListener('pointerleave', leave);
  box.addEventListener('wheel', wheel, { passive: false });
  return () => {
    clearTimeout(timer);
    box.removeEventListener('pointerdown', down);
    box.removeEventListener('pointermove', move);
    box.removeEventListener('pointerup', up);
    box.removeEventListener('pointercancel', up);
    box.removeEventListener('pointerleave', leave);
    box.removeEventListener('wheel', wheel);
  };
}
