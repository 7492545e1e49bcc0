/** How far one step of a field goes. */

import type { Range } from '../scene/ranges';
import { decade, rounded } from '../scene/vector';

interface Modifiers {
  shiftKey: boolean;
  altKey: boolean;
}

/** The step of a number that says nothing about its own: the second digit of what it is. */
export function stepOf(value: number): number {
  return value === 0 ? 0.1 : decade(Math.abs(value)) / 10;
}

/** The step of a number with the keys that are held; a whole one for whole numbers. */
export function sizedStep(step: number | undefined, value: number, { whole }: Range, held: Modifiers): number {
  const size = (step ?? stepOf(value)) * pace(held);
  return whole ? Math.max(1, Math.round(size)) : size;
}

/** A value some steps away, on a multiple of the step. */
export function stepped(value: number, step: number, count: number): number {
  return rounded(Math.round(value / step + count) * step, 12) + 0;
}

/** How much faster or slower the keys that are held make a step. */
export function pace({ shiftKey, altKey }: Modifiers): number {
  return shiftKey ? 10 : altKey ? 0.1 : 1;
}
