/** How large a scene is, for the sizes of what is added to it and the steps of its fields. */

import type { SceneInfo, Vec3 } from '../engine/types';
import type { SceneSource } from './model';
import { decade, length, subtract } from './vector';

export interface Extent {
  center: Vec3;
  /** Half the diagonal of the bounded shapes; of a scene without any, a guess from its lamps and its eye. */
  radius: number;
}

export function extentOf(scene: SceneSource, info: SceneInfo | null): Extent {
  const corners = (info?.shapes ?? []).flatMap(({ bounds }) => (bounds ? [bounds.low, bounds.high] : []));
  if (corners.length > 0) return around(corners);
  const eye = info?.camera.eye ?? scene.camera.eye;
  const lamps = (scene.light ?? []).flatMap(({ position }) => (position ? [position] : []));
  const points = (info?.shapes ?? []).map(({ center }) => center);
  const all = [...points, ...lamps, ...(eye ? [eye] : [])];
  if (all.length < 2) return { center: points[0] ?? [0, 0, 0], radius: { mm: 1000, cm: 100, m: 1 }[scene.length] };
  const { center, radius } = around(all);
  return { center: points[0] ?? center, radius: radius / 3 };
}

function around(points: readonly Vec3[]): Extent {
  const [low, high]: [Vec3, Vec3] = [
    [Infinity, Infinity, Infinity],
    [-Infinity, -Infinity, -Infinity],
  ];
  for (const point of points) {
    for (const axis of [0, 1, 2] as const) {
      low[axis] = Math.min(low[axis], point[axis]);
      high[axis] = Math.max(high[axis], point[axis]);
    }
  }
  const center = low.map((edge, axis) => (edge + high[axis]!) / 2) as Vec3;
  return { center, radius: length(subtract(high, low)) / 2 || 1 };
}

/** The step of a length's field: a power of ten, about a hundredth of the scene. */
export function lengthStep({ radius }: Extent): number {
  return decade(Math.max(radius, Number.MIN_VALUE * 1e10) / 5) / 10;
}
