/** How far one step of a field goes. */

import { decade, rounded } from '../scene/vector';

/** The step of a number that says nothing about its own: the second digit of what it is. */
export function stepOf(value: number): number {
  return value === 0 ? 0.1 : decade(Math.abs(value)) / 10;
}

/** A value some steps away, on a multiple of the step. */
export function stepped(value: number, step: number, count: number): number {
  return rounded(Math.round(value / step + count) * step, 12) + 0;
}

/** How much faster or slower the keys that are held make a step. */
export function pace(event: { shiftKey: boolean; altKey: boolean }): number {
  return event.shiftKey ? 10 : event.altKey ? 0.1 : 1;
}
