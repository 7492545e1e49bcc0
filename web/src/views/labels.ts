/** Where the labels of isophotes stand. */

import type { Isophote, Vec2 } from '../engine/types';
import type { Projection, Size } from './scale';

export interface Label {
  level: number;
  at: Vec2;
}

/** Places tried on a line. */
const TRIES = 24;

/** One label for each level that has room for it: on its longest line, as far as can be from the labels before, in pixels. */
export function placeLabels(isophotes: readonly Isophote[], projection: Projection, box: Size, apart: number): Label[] {
  const labels: Label[] = [];
  for (const { level, lines } of isophotes) {
    const longest = lines.reduce<Vec2[]>((best, { points }) => (points.length > best.length ? points : best), []);
    let room = apart;
    let best: Vec2 | null = null;
    const step = Math.max(1, Math.floor(longest.length / TRIES));
    for (let index = 0; index < longest.length; index += step) {
      const at = projection.toBox(longest[index]!);
      const free = Math.min(toEdge(at, box) * 2, ...labels.map((label) => distance(label.at, at)));
      if (free > room) {
        room = free;
        best = at;
      }
    }
    if (best) labels.push({ level, at: best });
  }
  return labels;
}

function toEdge([across, down]: Vec2, { width, height }: Size): number {
  return Math.min(across, width - across, down, height - down);
}

function distance(a: Vec2, b: Vec2): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}
