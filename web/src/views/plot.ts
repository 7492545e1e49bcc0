/** Curves of a plot: how they look, where they run, what they say. */

import { text } from '../text/index.svelte';
import { quantity } from './format';
import type { Series } from './Plot.svelte';

type Curve = Pick<Series, 'positions' | 'values'>;

/** The colours of Okabe and Ito that stand out on light and dark alike, each with dashes of its own. */
export const LOOKS: readonly { color: string; dashes: string }[] = [
  { color: '#0072b2', dashes: 'none' },
  { color: '#d55e00', dashes: '7 3' },
  { color: '#009e73', dashes: '2 3' },
  { color: '#cc79a7', dashes: '9 3 2 3' },
  { color: '#e69f00', dashes: '12 4' },
  { color: '#56b4e9', dashes: '4 2 1 2' },
];

/** The path of a curve, with gaps where there is no value. */
export function pathOf({ positions, values }: Curve, toX: (x: number) => number, toY: (y: number) => number): string {
  let isDrawing = false;
  let path = '';
  for (const [index, position] of positions.entries()) {
    const value = values[index] ?? null;
    if (value !== null) path += `${isDrawing ? 'L' : 'M'}${toX(position).toFixed(2)} ${toY(value).toFixed(2)}`;
    isDrawing = value !== null;
  }
  return path;
}

/** The index of the position nearest to a place; −1 if there are none. */
export function nearest(positions: readonly number[], place: number): number {
  let best = -1;
  for (const [index, position] of positions.entries()) {
    if (best < 0 || Math.abs(position - place) < Math.abs(positions[best]! - place)) best = index;
  }
  return best;
}

/** Where the cursor is after a key: null for nowhere, undefined for keys that do not move it. */
export function cursorAfter(
  { key, shiftKey }: Pick<KeyboardEvent, 'key' | 'shiftKey'>,
  cursor: number | null,
  { low, high }: { low: number; high: number },
): number | null | undefined {
  const step = ((high - low) / 200) * (shiftKey ? 10 : 1);
  const from = cursor ?? (low + high) / 2;
  switch (key) {
    case 'ArrowLeft':
      return Math.max(low, from - step);
    case 'ArrowRight':
      return Math.min(high, from + step);
    case 'Home':
      return low;
    case 'End':
      return high;
    case 'Escape':
      return null;
    default:
      return undefined;
  }
}

/** A curve in words: its extremes, and where it begins and ends. */
export function summaryOf({ name, unit, positions, values }: Series, xUnit: string): string {
  const words = text.words.views.sections;
  const seen = positions.flatMap((at, index) => {
    const value = values[index] ?? null;
    return value === null ? [] : [{ at, value }];
  });
  const [first, last] = [seen[0], seen.at(-1)];
  if (!first || !last) return words.unseen(name);
  const max = seen.reduce((best, each) => (each.value > best.value ? each : best));
  const min = seen.reduce((best, each) => (each.value < best.value ? each : best));
  const at = (position: number) => quantity(position, xUnit, 4);
  return words.summary(
    name,
    quantity(min.value, unit),
    at(min.at),
    quantity(max.value, unit),
    at(max.at),
    at(first.at),
    at(last.at),
  );
}
