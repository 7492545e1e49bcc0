/** Section lines: where they are on a map, what they are called, and which sections are theirs. */

import type { Frame, Section, SectionRequest, Vec2 } from '../engine/types';
import { text } from '../text/index.svelte';
import { place, quantity } from './format';

export type Straight = Extract<SectionRequest, { kind: 'row' | 'column' | 'horizontal' | 'vertical' }>;
export type Between = Extract<SectionRequest, { kind: 'between' }>;
type Map = Pick<Frame, 'window' | 'width' | 'height' | 'step'>;

/** The coordinate that a line along an axis keeps; null for other lines. */
export function placeOf(
  line: SectionRequest,
  { window, width, height, step }: Map,
): { axis: 'x' | 'y'; at: number } | null {
  const [columns, rows] = [width * step, height * step];
  const between = ([from, to]: Vec2, share: number) => from + (to - from) * share;
  switch (line.kind) {
    case 'horizontal':
      return { axis: 'y', at: line.y };
    case 'vertical':
      return { axis: 'x', at: line.x };
    case 'row':
      return { axis: 'y', at: between(window.y, 1 - (line.row + 0.5) / rows) };
    case 'column':
      return { axis: 'x', at: between(window.x, (line.column + 0.5) / columns) };
    default:
      return null;
  }
}

/** The same line through another place, kept on the map. */
export function moveLine(line: Straight, at: Vec2, { window, width, height, step }: Map): Straight {
  const [x, y] = kept(at, window);
  const share = ([from, to]: Vec2, coordinate: number) => (coordinate - from) / (to - from);
  const index = (fraction: number, count: number) => Math.min(count - 1, Math.max(0, Math.floor(fraction * count)));
  switch (line.kind) {
    case 'horizontal':
      return { ...line, y };
    case 'vertical':
      return { ...line, x };
    case 'row':
      return { ...line, row: index(1 - share(window.y, y), height * step) };
    case 'column':
      return { ...line, column: index(share(window.x, x), width * step) };
  }
}

export function moveEnd(line: Between, end: 'from' | 'to', at: Vec2, { window }: Pick<Map, 'window'>): Between {
  return { ...line, [end]: kept(at, window) };
}

function kept([x, y]: Vec2, window: Map['window']): Vec2 {
  const clamp = (coordinate: number, edges: Vec2) =>
    Math.min(Math.max(...edges), Math.max(Math.min(...edges), Number(coordinate.toPrecision(6))));
  return [clamp(x, window.x), clamp(y, window.y)];
}

export function lineName(line: SectionRequest, unit: string): string {
  const words = text.words.views.sections;
  switch (line.kind) {
    case 'row':
      return words.nameRow(line.row);
    case 'column':
      return words.nameColumn(line.column);
    case 'horizontal':
      return words.nameHorizontal(quantity(line.y, unit));
    case 'vertical':
      return words.nameVertical(quantity(line.x, unit));
    case 'between':
      return words.nameBetween(place(line.from), place(line.to));
    case 'through':
      return words.nameThrough(line.shape);
  }
}

/** The name of a section: that of its line, or, for one of two lines through a centre, what coordinate it keeps. */
export function sectionName(section: Section, line: SectionRequest | undefined, unit: string): string {
  const [from] = section.screen;
  if (line && line.kind !== 'through') return lineName(line, unit);
  if (!from || section.axis === 'distance') return section.name;
  const words = text.words.views.sections;
  return section.axis === 'x' ? words.nameHorizontal(quantity(from[1], unit)) : words.nameVertical(quantity(from[0], unit));
}

/** The line that each section is of: a line through a centre has two. */
export function ownersOf(lines: readonly SectionRequest[]): SectionRequest[] {
  return lines.flatMap<SectionRequest>((line) => (line.kind === 'through' ? [line, line] : [line]));
}
