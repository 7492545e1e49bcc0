/** The plane of the picture: places on the screen, and points in planes parallel to it. */

import type { SceneInfo, Vec2, Vec3 } from '../engine/types';
import { add, dot, rounded, scale, subtract } from '../scene/vector';

export class ScreenPlane {
  readonly #camera: SceneInfo['camera'];
  readonly #window: SceneInfo['window'];
  readonly #corner: Vec3;
  /** Along the lower and the left edge of the picture, and how far before the eye that is. */
  readonly #across: Vec3;
  readonly #along: Vec3;
  readonly #ahead: number;

  private constructor({ camera, window }: SceneInfo, [corner, right, , top]: [Vec3, Vec3, Vec3, Vec3]) {
    this.#camera = camera;
    this.#window = window;
    this.#corner = corner;
    this.#across = subtract(right, corner);
    this.#along = subtract(top, corner);
    this.#ahead = dot(subtract(corner, camera.eye), camera.forward);
  }

  /** The plane of a perspective or of parallel rays; null for a fisheye or a panorama, which has none. */
  static of(info: SceneInfo): ScreenPlane | null {
    return info.camera.corners && new ScreenPlane(info, info.camera.corners);
  }

  get #isPerspective(): boolean {
    return this.#camera.projection === 'perspective';
  }

  /** Where a point appears; null behind the eye. */
  project(point: Vec3): Vec2 | null {
    const { eye, forward } = this.#camera;
    let seen = point;
    if (this.#isPerspective) {
      const ray = subtract(point, eye);
      const depth = dot(ray, forward);
      if (depth <= 0) return null;
      seen = add(eye, scale(ray, this.#ahead / depth));
    }
    const from = subtract(seen, this.#corner);
    const share = (side: Vec3): number => dot(from, side) / dot(side, side);
    const { x, y } = this.#window;
    return [x[0] + share(this.#across) * (x[1] - x[0]), y[0] + share(this.#along) * (y[1] - y[0])];
  }

  /** The point that appears at a place, in the plane through another point. */
  at([screenX, screenY]: Vec2, through: Vec3): Vec3 {
    const { x, y } = this.#window;
    const across = scale(this.#across, (screenX - x[0]) / (x[1] - x[0]));
    const along = scale(this.#along, (screenY - y[0]) / (y[1] - y[0]));
    const seen = add(this.#corner, add(across, along));
    const { eye, forward } = this.#camera;
    if (!this.#isPerspective) return add(seen, scale(forward, dot(subtract(through, seen), forward)));
    return add(eye, scale(subtract(seen, eye), dot(subtract(through, eye), forward) / this.#ahead));
  }

  /** A point of the plane through `from`, with short numbers: multiples of the step where the plane lies along the axes, of a
   * hundredth of it elsewhere, so that the point stays in its plane. Coordinates that are the same all over the plane stay. */
  tidy(point: Vec3, from: Vec3, step: number): Vec3 {
    const { right, up } = this.#camera;
    const axes = [0, 1, 2].filter((axis) => Math.abs(right[axis]!) > 1e-9 || Math.abs(up[axis]!) > 1e-9);
    const size = axes.length > 2 ? step / 100 : step;
    return point.map((part, axis) => {
      if (!axes.includes(axis)) return from[axis]!;
      return size > 0 ? rounded(Math.round(part / size) * size, 12) + 0 : rounded(part, 6) + 0;
    }) as Vec3;
  }

  /** A point moved to the right and up in its plane. */
  moved(point: Vec3, [right, up]: Vec2): Vec3 {
    const to = add(point, add(scale(this.#camera.right, right), scale(this.#camera.up, up)));
    return to.map((part) => rounded(part, 12) + 0) as Vec3;
  }
}
