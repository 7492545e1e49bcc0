/** Handles on a map: a pointer drags them, arrow keys move them. */

import type { Vec2 } from '../engine/types';
import type { Session } from '../session.svelte';
import { ARROWS } from './gestures';
import type { Projection } from './scale';

/** Pixels that a pointer may move during a click. */
const CLICK = 4;

/** Follows a pointer that was pressed on a handle. `move` is told where the handle is to be, `at` where it is drawn. */
export function drag(
  event: PointerEvent,
  session: Session,
  { projection, at = null }: { projection: () => Projection; at?: Vec2 | null },
  move: (place: Vec2, event: PointerEvent) => void,
): void {
  if (event.button !== 0) return;
  event.stopPropagation();
  const handle = event.currentTarget as SVGElement;
  const plot = handle.ownerSVGElement!;
  handle.setPointerCapture(event.pointerId);
  const inBox = ({ clientX, clientY }: PointerEvent): Vec2 => {
    const { left, top } = plot.getBoundingClientRect();
    return [clientX - left, clientY - top];
  };
  const start = inBox(event);
  const off: Vec2 = at ? [at[0] - start[0], at[1] - start[1]] : [0, 0];
  let isMoved = false;
  const follow = (now: PointerEvent) => {
    if (now.pointerId !== event.pointerId) return;
    const [across, down] = inBox(now);
    if (!isMoved && Math.hypot(across - start[0], down - start[1]) < CLICK) return;
    isMoved = true;
    session.dragging = true;
    move(projection().fromBox([across + off[0], down + off[1]]), now);
  };
  const stop = () => {
    session.dragging = false;
    handle.removeEventListener('pointermove', follow);
    session.store.endStep();
  };
  handle.addEventListener('pointermove', follow);
  handle.addEventListener('lostpointercapture', stop, { once: true });
}

/** Where an arrow key leads, to the right and up, with Shift ten times as far; null for other keys. The event goes no further. */
export function arrowOf(event: KeyboardEvent): Vec2 | null {
  const arrow = ARROWS[event.key];
  if (!arrow || event.ctrlKey || event.metaKey || event.altKey) return null;
  event.preventDefault();
  event.stopPropagation();
  const pace = event.shiftKey ? 10 : 1;
  return [arrow[0] * pace, arrow[1] * pace];
}
