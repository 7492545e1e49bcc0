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
  const intensities = (light ?? []).flatMap(({ intensity }) => (typeof intensity === 'number' ? [intensity] : []));
  return Math.max(...intensities, 0) || 100;
}

/** Adds a probe; without a point, at the middle of the scene, whence the table of values leads it to a surface. */
export function addProbe(draft: SceneSource, info: SceneInfo | null, name: string, at?: Vec3): string {
  const probe: ProbeSource = {
    name: uniqueName(namesBeside(draft, 'probe'), name),
    at: at ?? info?.shapes[0]?.center ?? extentOf(draft, info).center,
  };
  return append(draft, 'probe', probe);
}

/** Adds a circle of interest: on a flat shape if there is one, else about the middle of the screen. */
export function addArea(draft: SceneSource, info: SceneInfo | null, name: string): string {
  const flat = info?.shapes.find(({ kind }) => kind === 'plane' || kind === 'rectangle' || kind === 'disk');
  const area: AreaSource = { name: uniqueName(namesBeside(draft, 'area'), name) };
  if (flat) {
    area.on = flat.name;
    area.center = flat.center;
    area.radius = tidySize(flat.bounds ? smallestSide(flat.bounds) / 4 : extentOf(draft, info).radius / 4);
  } else {
    const window: { x: Vec2; y: Vec2 } = info?.window ?? { x: [-1, 1], y: [-1, 1] };
    const seen = info?.shapes.find(({ onScreen }) => onScreen)?.onScreen;
    area.at = seen ?? [(window.x[0] + window.x[1]) / 2, (window.y[0] + window.y[1]) / 2];
    area.radius = tidySize(Math.min(window.x[1] - window.x[0], window.y[1] - window.y[0]) / 20);
  }
  return append(draft, 'area', area);
}

function smallestSide({ low, high }: { low: Vec3; high: Vec3 }): number {
  return Math.min(...subtract(high, low).filter((side) => side > 0));
}

/** Adds a level grid of points under the shapes, or through the middle of a scene without any. */
export function addGrid(draft: SceneSource, info: SceneInfo | null, name: string): string {
  const extent = extentOf(draft, info);
  const side = tidySize(3 * extent.radius);
  const up = info?.camera.up ?? [0, 1, 0];
  const normal = mainAxis(up);
  const u: Vec3 = normal[0] === 0 ? [side, 0, 0] : [0, side, 0];
  const v = cross(normal, scale(u, 1 / side)).map((part) => part * side + 0) as Vec3;
  const grid: GridSource = {
    name: uniqueName(namesBeside(draft, 'grid'), name),
    center: below(extent, up, extent.radius),
    u,
    v,
    points: [30, 30],
  };
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

function cross([ax, ay, az]: Vec3, [bx, by, bz]: Vec3): Vec3 {
  return [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
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
