/** What a person typed where a number is wanted: the number, or what is wrong with it. */

import { isIn, type Range } from '../scene/ranges';
import { parseNumber, text } from '../text/index.svelte';

/** Any finite number. */
export const ANY: Range = { min: -Number.MAX_VALUE, max: Number.MAX_VALUE };

export type Entry = { value: number; fault: null } | { value: null; fault: string };

export function readEntry(typed: string, range: Range): Entry {
  const value = parseNumber(typed);
  if (value === null) return { value, fault: text.words.fields.notNumber };
  return isIn(range, value) ? { value, fault: null } : { value: null, fault: allowed(range) };
}

function allowed({ min, max, above, whole, course }: Range): string {
  const words = text.words.fields;
  if (Math.abs(max) >= 1e100 && Math.abs(min) >= 1e100) return words.allowed(words.anyNumber);
  const between = (above ? words.aboveTo : words.fromTo)(text.number(min), text.number(max));
  return (whole ? words.notWhole : course ? words.allowedByCourse : words.allowed)(between);
}
