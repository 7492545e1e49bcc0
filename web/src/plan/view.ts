/** A view of the scene along one of its axes: which way things lie in it, and how it fits. */

import type { SceneInfo, Vec2, Vec3 } from '../engine/types';
import { extentOf } from '../scene/extent';
import type { SceneSource } from '../scene/model';
import { length, subtract } from '../scene/vector';

export type Side = 'top' | 'side' | 'front';

/** An axis of the scene, 0 to 2, and which way it runs. */
export interface Along {
  axis: number;
  sign: 1 | -1;
}

/** What runs to the right and what runs up. */
export interface View {
  right: Along;
  up: Along;
}

export interface Box {
  center: Vec2;
  width: number;
  height: number;
}

/** The axes of a view. What is up is what is up in the picture; z where lamps or the observer are aimed by their angle from −z. In
 * the view from above the observer looks up the page, in that from the side to the right. */
export function viewOf(side: Side, scene: SceneSource, info: SceneInfo): View {
  const { right, up, forward } = info.camera;
  const tilts = scene.camera.tilt !== undefined || (scene.light ?? []).some(({ tilt }) => tilt !== undefined);
  const vertical: Along = tilts ? { axis: 2, sign: 1 } : nearest(up, []);
  const ahead = nearest(forward, []);
  if (ahead.axis === vertical.axis) {
    const across = nearest(right, [vertical.axis]);
    const deep = nearest(up, [vertical.axis, across.axis]);
    return {
      top: { right: across, up: deep },
      side: { right: across, up: vertical },
      front: { right: deep, up: vertical },
    }[side];
  }
  const across = nearest(right, [vertical.axis, ahead.axis]);
  return {
    top: { right: across, up: ahead },
    side: { right: ahead, up: vertical },
    front: { right: across, up: vertical },
  }[side];
}

/** The axis nearest to a direction, of those that are not taken. */
function nearest(direction: Vec3, taken: readonly number[]): Along {
  const sizes = direction.map((part, axis) => (taken.includes(axis) ? -1 : Math.abs(part)));
  const axis = sizes.indexOf(Math.max(...sizes));
  return { axis, sign: (direction[axis] ?? 0) < 0 ? -1 : 1 };
}

/** The unit vector along an axis. */
export function directionOf({ axis, sign }: Along): Vec3 {
  const direction: Vec3 = [0, 0, 0];
  direction[axis] = sign;
  return direction;
}

/** A point in the view: to the right, and up. */
export function flat({ right, up }: View, point: Vec3): Vec2 {
  return [right.sign * (point[right.axis] ?? 0), up.sign * (point[up.axis] ?? 0)];
}

/** A point moved within the view; what is along the view stays. */
export function moved({ right, up }: View, point: Vec3, to: Vec2): Vec3 {
  const result: Vec3 = [...point];
  result[right.axis] = right.sign * to[0] + 0;
  result[up.axis] = up.sign * to[1] + 0;
  return result;
}

/** Things farther from the middle than this, in radii of the shapes, do not shrink the rest. */
const FAR = 14;

/** What is to be seen: the shapes, and whatever else is not too far from them. */
export function fitOf(view: View, scene: SceneSource, info: SceneInfo): Box {
  const { center, radius } = extentOf(scene, info);
  const others = [
    info.camera.eye,
    ...(info.camera.corners ?? []),
    ...info.lights.flatMap(({ position }) => (position ? [position] : [])),
    ...info.shapes.map((shape) => shape.center),
    ...(scene.probe ?? []).map(({ at }) => at),
  ].filter((point) => length(subtract(point, center)) <= FAR * radius);
  const bounds = info.shapes.flatMap((shape) => (shape.bounds ? [shape.bounds.low, shape.bounds.high] : []));
  const points = [center, ...bounds, ...others].map((point) => flat(view, point));
  const [x, y] = [0, 1].map((axis) => {
    const parts = points.map((point) => point[axis] ?? 0);
    return [parts.reduce((a, b) => Math.min(a, b)), parts.reduce((a, b) => Math.max(a, b))] as Vec2;
  }) as [Vec2, Vec2];
  const least = radius / 2;
  return {
    center: [(x[0] + x[1]) / 2, (y[0] + y[1]) / 2],
    width: Math.max(x[1] - x[0], least),
    height: Math.max(y[1] - y[0], least),
  };
}

/** A length of 1, 2 or 5 times a power of ten, at most this one. */
export function niceLength(most: number): number {
  const power = 10 ** Math.floor(Math.log10(most));
  return ([5, 2, 1].find((digit) => digit * power <= most) ?? 1) * power;
}
