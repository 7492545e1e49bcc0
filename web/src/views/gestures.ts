/** Wheel, drags, pinches and keys change the view of a map. Places are pixels of the map's box. */

import type { Vec2 } from '../engine/types';
import { pan, type Size, type View, WHOLE, zoomAbout } from './scale';

/** Pixels that a pointer may move during a click. */
const CLICK = 4;
const KEY_ZOOM = 1.5;
const KEY_PAN = 0.1;

export class Gestures {
  #down = new Map<number, Vec2>();
  #start: Vec2 | null = null;
  #moved = false;

  /** Whether the last pointer that went up had been dragged. */
  get wasDrag(): boolean {
    return this.#moved;
  }

  get isDown(): boolean {
    return this.#down.size > 0;
  }

  press(pointer: number, at: Vec2): void {
    if (this.#down.size === 0) {
      this.#moved = false;
      this.#start = at;
    }
    this.#down.set(pointer, at);
    if (this.#down.size > 1) this.#moved = true;
  }

  move(pointer: number, at: Vec2, view: View, box: Size): View {
    const before = this.#down.get(pointer);
    if (!before) return view;
    const other = [...this.#down].find(([id]) => id !== pointer)?.[1];
    this.#down.set(pointer, at);
    if (this.#start && Math.hypot(at[0] - this.#start[0], at[1] - this.#start[1]) > CLICK) this.#moved = true;
    if (!this.#moved) return view;
    if (!other) return pan(view, fraction([at[0] - before[0], at[1] - before[1]], box));
    const spread = (point: Vec2) => Math.max(10, Math.hypot(point[0] - other[0], point[1] - other[1]));
    const middle = fraction([(at[0] + other[0]) / 2, (at[1] + other[1]) / 2], box);
    const moved = pan(view, fraction([(at[0] - before[0]) / 2, (at[1] - before[1]) / 2], box));
    return zoomAbout(moved, spread(at) / spread(before), middle);
  }

  release(pointer: number): void {
    this.#down.delete(pointer);
  }
}

/** The view after a turn of the wheel. */
export function wheeled(view: View, { deltaY, deltaMode }: WheelEvent, at: Vec2, box: Size): View {
  const pixels = deltaMode === 0 ? deltaY : deltaY * 30;
  return zoomAbout(view, Math.exp(-0.002 * Math.max(-300, Math.min(300, pixels))), fraction(at, box));
}

/** The view after a key; null for keys that do not change it. */
export function keyed(view: View, { key, shiftKey }: KeyboardEvent, about: Vec2): View | null {
  if (key === '+' || key === '=') return zoomAbout(view, KEY_ZOOM, about);
  if (key === '-' || key === '−' || key === '_') return zoomAbout(view, 1 / KEY_ZOOM, about);
  if (key === '0') return WHOLE;
  const arrow = ARROWS[key];
  return arrow && shiftKey ? pan(view, [-arrow[0] * KEY_PAN, arrow[1] * KEY_PAN]) : null;
}

/** To the right and up. */
export const ARROWS: Record<string, Vec2> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

export function fraction([across, down]: Vec2, { width, height }: Size): Vec2 {
  return [across / width, down / height];
}
