/** New items for a scene, of a size and at a place that suit it. */

import type { SceneInfo, Vec2, Vec3 } from '../engine/types';
import { append, namesBeside, uniqueName, type MadeShape } from './edit';
import { extentOf, type Extent } from './extent';
import type { AreaSource, GridSource, LightSource, ProbeSource, SceneSource } from './model';
import { add, length, rounded, scale, subtract, unit } from './vector';

/** Adds a shape beside those that there are, and says where it is. */
export function addShape(draft: SceneSource, info: SceneInfo | null, kind: MadeShape, name: string): string {
  const extent = extentOf(draft, info);
  const size = tidySize(info?.shapes.some(({ bounds }) => bounds) ? extent.radius / 2 : extent.radius / 3);
  const center = tidyPoint(beside(extent, info, size), size);
  const material = materialFor(draft);
  const common = { name: uniqueName(namesBeside(draft, kind), name), ...(material === null ? {} : { material }) };
  const towardsEye = roundedAxis(draft, info, center);
  const up = info?.camera.up ?? [0, 1, 0];
  const along = scale(up, size);
  const shapes: Record<MadeShape, object> = {
    sphere: { center, radius: size },
    ellipsoid: { center, radii: [size, tidySize(size * 0.7), tidySize(size * 0.5)] },
    box: { center, size: [size, size, size] },
    cylinder: {
      from: tidyPoint(subtract(center, along), size),
      to: tidyPoint(add(center, along), size),
      radius: tidySize(size / 2),
    },
    cone: {
      base: tidyPoint(subtract(center, along), size),
      apex: tidyPoint(add(center, along), size),
      radius: tidySize(size / 2),
    },
    plane: { point: below(extent, up, size), normal: mainAxis(up) },
    rectangle: { center, normal: towardsEye, up: mainAxis(up, towardsEye), width: 2 * size, height: 2 * size },
    disk: { center, normal: towardsEye, radius: size },
  };
  return append(draft, kind, { ...common, ...shapes[kind] });
}

/** Adds an isotropic lamp above and before the scene, as strong as the strongest that there is. */
export function addLight(draft: SceneSource, info: SceneInfo | null, name: string): string {
  const extent = extentOf(draft, info);
  const { right, up, forward } = info?.camera ?? {
    right: [1, 0, 0] as Vec3,
    up: [0, 1, 0] as Vec3,
    forward: [0, 0, -1] as Vec3,
  };
  const spread = (count: number): number => (count % 2 === 0 ? 1 : -1) * (2 + Math.floor(count / 2));
  const aside = scale(right, extent.radius * spread(draft.light?.length ?? 0));
  const away = add(scale(up, 2 * extent.radius), scale(forward, -3 * extent.radius));
  const light: LightSource = {
    name: uniqueName(namesBeside(draft, 'light'), name),
    position: tidyPoint(add(extent.center, add(aside, away)), extent.radius),
    intensity: intensityLike(draft),
  };
  return append(draft, 'light', light);
}

function intensityLike({ light }: SceneSource): number {
  const strongest = (light ?? []).reduce(
    (most, { intensity }) => (typeof intensity === 'number' ? Math.max(most, intensity) : most),
    0,
  );
  return strongest || 100;
}

/** Adds a probe; without a point, at the middle of the scene, whence the table of values leads it to a surface. */
export function addProbe(draft: SceneSource, info: SceneInfo | null, name: string, at?: Vec3): string {
  const probe: ProbeSource = {
    name: uniqueName(namesBeside(draft, 'probe'), name),
    at: at ?? info?.shapes[0]?.center ?? extentOf(draft, info).center,
  };
  return append(draft, 'probe', probe);
}

/** Adds a circle of interest: in the middle of a flat shape if there is one, else of the screen. */
export function addArea(draft: SceneSource, info: SceneInfo | null, name: string): string {
  const flat = info?.shapes.find(({ kind }) => kind === 'plane' || kind === 'rectangle' || kind === 'disk');
  const { x, y }: { x: Vec2; y: Vec2 } = info?.window ?? { x: [-1, 1], y: [-1, 1] };
  const radius = rounded(Math.min(Math.abs(x[1] - x[0]), Math.abs(y[1] - y[0])) / 8, 1);
  const place = flat ? { on: flat.name, center: flat.center } : { at: [(x[0] + x[1]) / 2, (y[0] + y[1]) / 2] as Vec2 };
  const area: AreaSource = { name: uniqueName(namesBeside(draft, 'area'), name), ...place, radius };
  return append(draft, 'area', area);
}

/** Edges whose u × v points along the positive axis that a grid is across: that side is lit. */
const EDGES: readonly [Vec3, Vec3][] = [
  [
    [0, 1, 0],
    [0, 0, 1],
  ],
  [
    [0, 0, 1],
    [1, 0, 0],
  ],
  [
    [1, 0, 0],
    [0, 1, 0],
  ],
];

/** Points along each edge of a new grid. */
const POINTS = 200;

/** Adds a grid across an axis (0 for x), below the shapes along it, and four times as wide as they are. */
export function addGrid(draft: SceneSource, info: SceneInfo | null, name: string, axis = 1): string {
  const { center, radius } = extentOf(draft, info);
  const side = rounded(4 * radius, 2);
  const [u, v] = EDGES[axis]!.map((direction) => scale(direction, side)) as [Vec3, Vec3];
  const middle = center.map((part, index) => rounded(index === axis ? part - radius : part, 4)) as Vec3;
  const names = namesBeside(draft, 'grid');
  const grid: GridSource = { name: uniqueName(names, name), center: middle, u, v, points: [POINTS, POINTS] };
  return append(draft, 'grid', grid);
}

/** The material of a new shape: the first that there is; one is made where the convention needs one. */
function materialFor(draft: SceneSource): string | null {
  const [first] = Object.keys(draft.material ?? {});
  if (first !== undefined) return first;
  if (draft.convention === 'irradiance') return null;
  draft.material = { clay: { diffuse: 0.7 } };
  return 'clay';
}

/** To the right of what there is. */
function beside({ center, radius }: Extent, info: SceneInfo | null, size: number): Vec3 {
  if (!info || info.shapes.every(({ bounds }) => !bounds)) return center;
  return add(center, scale(info.camera.right, radius + size));
}

function below({ center, radius }: Extent, up: Vec3, size: number): Vec3 {
  return tidyPoint(subtract(center, scale(mainAxis(up), radius)), size);
}

/** The axis nearest to a direction, other than that of `but`. */
function mainAxis(direction: Vec3, but?: Vec3): Vec3 {
  const taken = but ? but.findIndex((part) => part !== 0) : -1;
  const sizes = direction.map((part, axis) => (axis === taken ? -1 : Math.abs(part)));
  const main = sizes.indexOf(Math.max(...sizes));
  const axis: Vec3 = [0, 0, 0];
  axis[main] = (direction[main] ?? 0) < 0 ? -1 : 1;
  return axis;
}

/** The axis that leads best from a point to the eye. */
function roundedAxis(draft: SceneSource, info: SceneInfo | null, center: Vec3): Vec3 {
  const eye = info?.camera.eye ?? draft.camera.eye ?? [0, 0, 1];
  return mainAxis(unit(subtract(eye, center)) ?? [0, 0, 1]);
}

/** A size with two significant digits. */
function tidySize(size: number): number {
  return rounded(size > 0 ? size : 1, 2);
}

/** A point rounded to hundredths of a size. */
function tidyPoint(point: Vec3, size: number): Vec3 {
  const step = 10 ** Math.floor(Math.log10(size > 0 ? size : length(point) || 1)) / 100;
  return point.map((part) => rounded(Math.round(part / step) * step, 12) + 0) as Vec3;
}
