/** The table of control points as text. */

import type { Language, Probed } from '../engine/types';
import { format } from '../text/index.svelte';

export const COLUMNS = ['brightness', 'irradiance', 'diffuse', 'specular', 'cosThetaO'] as const;
export type Column = (typeof COLUMNS)[number];

/** Rows of cells between tabs, which spreadsheets take; numbers in the language's notation, with an ASCII minus. */
export function probesAsText(
  heads: string[],
  probed: readonly Probed[],
  columns: readonly Column[],
  language: Language,
): string {
  const number = (value: number) => format(value, 12, language).replace('−', '-').replace('−', '-');
  const rows = probed.map(({ reading, error }) =>
    reading ? [reading.name, ...reading.point.map(number), ...columns.map((column) => number(reading[column]))] : [error],
  );
  return [heads, ...rows].map((cells) => cells.join('\t')).join('\n');
}
