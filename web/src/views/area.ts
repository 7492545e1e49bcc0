/** Where areas of interest are: their outlines, and the five points of a circle. */

import type { SceneInfo, Vec2, Vec3 } from '../engine/types';
import type { AreaSource, SceneSource } from '../scene/model';
import { add, scale, subtract, unit } from '../scene/vector';

/** Points of an outline. */
const POINTS = 64;

/** Fractions of a radius, or of half a width and half a height: to the right and up. */
type Offsets = readonly Vec2[];

const CIRCLE: Offsets = Array.from({ length: POINTS }, (_, index) => {
  const angle = (2 * Math.PI * index) / POINTS;
  return [Math.cos(angle), Math.sin(angle)];
});

/** Corners, and points between them: a rectangle on a surface is no rectangle on the screen of a fisheye. */
const RECTANGLE: Offsets = Array.from({ length: POINTS }, (_, index) => {
  const side = Math.floor((4 * index) / POINTS);
  const along = (8 * index) / POINTS - 2 * side - 1;
  const corners: Vec2[] = [
    [along, -1],
    [1, along],
    [-along, 1],
    [-1, -along],
  ];
  return corners[side]!;
});

/** The centre, and the crossings with the axes through it. */
export const FIVE = ['center', 'right', 'top', 'left', 'bottom'] as const;
const FIVE_OFFSETS: Offsets = [
  [0, 0],
  [1, 0],
  [0, 1],
  [-1, 0],
  [0, -1],
];

/** Points in space of an area on a surface, or on the screen of any other. */
export type Places = { kind: 'space'; points: Vec3[] } | { kind: 'screen'; points: Vec2[] };

export function outlineOf(area: AreaSource, scene: SceneSource, info: SceneInfo): Places | null {
  return places(area, area.radius === undefined ? RECTANGLE : CIRCLE, scene, info);
}

/** The five points, in the order of `FIVE`; null for what is no circle. */
export function fivePoints(area: AreaSource, scene: SceneSource, info: SceneInfo): Places | null {
  return area.radius === undefined ? null : places(area, FIVE_OFFSETS, scene, info);
}

function places(area: AreaSource, offsets: Offsets, scene: SceneSource, info: SceneInfo): Places | null {
  const [across, up] = area.radius === undefined ? halves(area.size) : [area.radius, area.radius];
  if (area.at) {
    const [x, y] = area.at;
    return { kind: 'screen', points: offsets.map(([right, above]) => [x + right * across, y + above * up]) };
  }
  const normal = area.on === undefined ? null : normalOf(area.on, scene);
  if (!area.center || !normal) return null;
  const [right, above] = axesOn(normal, area.up ?? [0, 1, 0], info);
  const { center } = area;
  const at = ([a, b]: Vec2): Vec3 => add(add(center, scale(right, a * across)), scale(above, b * up));
  return { kind: 'space', points: offsets.map(at) };
}

function halves(size: Vec2 = [0, 0]): Vec2 {
  return [size[0] / 2, size[1] / 2];
}

/** The normal of a flat shape. */
export function normalOf(name: string, scene: SceneSource): Vec3 | null {
  for (const list of ['plane', 'rectangle', 'disk'] as const) {
    const shape = (scene[list] ?? []).find((candidate, index) => (candidate.name ?? `${list}[${index}]`) === name);
    if (shape) return shape.normal;
  }
  return null;
}

/** Unit vectors in a surface: to the right and up as the eye's picture has them. */
function axesOn(normal: Vec3, up: Vec3, { camera }: SceneInfo): [Vec3, Vec3] {
  const n = unit(normal) ?? [0, 0, 1];
  const aside = (vector: Vec3) => subtract(vector, scale(n, dot(vector, n)));
  const isUsable = Math.hypot(...aside(unit(up) ?? n)) > 1e-6;
  const above = unit(aside(isUsable ? up : [0, 0, 1])) ?? unit(aside([1, 0, 0])) ?? [0, 1, 0];
  const right = cross(above, n);
  return [facing(right, camera.right), facing(above, camera.up)];
}

function facing(vector: Vec3, along: Vec3): Vec3 {
  return dot(vector, along) < 0 ? scale(vector, -1) : vector;
}

function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function cross(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}
