/** How the camera is written: its framing, its aim, and pixels that stay square. */

import type { Vec2, Vec3 } from '../engine/types';
import type { CameraSource } from './model';
import { anglesOf, directionOf, length, rounded, subtract, unit } from './vector';

export type Projection = NonNullable<CameraSource['projection']>;
export const PROJECTIONS: readonly Projection[] = [
  'perspective',
  'orthographic',
  'fisheye-equidistant',
  'fisheye-equal-area',
  'panorama',
];

export type Framing = 'screen' | 'field_of_view' | 'intrinsics';
export type ViewMode = 'down' | 'target' | 'forward' | 'angles' | 'pose';

export function projectionOf(camera: CameraSource): Projection {
  return camera.projection ?? 'perspective';
}

export function resolutionOf(camera: CameraSource): Vec2 {
  return camera.resolution ?? [800, 600];
}

/** How the picture of a perspective camera is framed. */
export function framingOf(camera: CameraSource): Framing {
  if (camera.intrinsics !== undefined) return 'intrinsics';
  return camera.field_of_view === undefined ? 'screen' : 'field_of_view';
}

/** The key that holds the edges of the picture in lengths, and these edges; null for a camera that has none. */
export function windowOf(camera: CameraSource): { key: 'screen' | 'window'; x: Vec2; y: Vec2 } | null {
  const key = projectionOf(camera) === 'orthographic' ? 'window' : 'screen';
  const edges = camera[key];
  return edges?.x && edges.y ? { key, x: edges.x, y: edges.y } : null;
}

export function sizeOf([low, high]: Vec2): number {
  return rounded(high - low, 14);
}

export function middleOf([low, high]: Vec2): number {
  return rounded((low + high) / 2, 14) + 0;
}

function spread(middle: number, size: number): Vec2 {
  return [rounded(middle - size / 2, 15) + 0, rounded(middle + size / 2, 15) + 0];
}

/** Changes W (axis 0) or H (axis 1) about the middle of the window; with `square`, the resolution follows, and where no whole
 * number of pixels fits, the other side does too. */
export function setWindowSize(camera: CameraSource, axis: 0 | 1, size: number, square: boolean): void {
  const window = windowOf(camera);
  if (!window) return;
  const edges: [Vec2, Vec2] = [window.x, window.y];
  edges[axis] = spread(middleOf(edges[axis]), size);
  if (square) {
    const sides: Vec2 = [sizeOf(edges[0]), sizeOf(edges[1])];
    camera.resolution = fitted(resolutionOf(camera), sides);
    const other = axis === 0 ? 1 : 0;
    edges[other] = squared(edges[other], camera.resolution, other, size);
  }
  writeEdges(camera, window.key, edges);
}

/** Changes the columns (axis 0) or the rows (axis 1); with `square`, the other number follows the window, and the height or the
 * width of the window is adjusted where that is no whole number. */
export function setPixels(camera: CameraSource, axis: 0 | 1, pixels: number, square: boolean): void {
  const resolution: Vec2 = [...resolutionOf(camera)];
  const before: Vec2 = [...resolution];
  resolution[axis] = pixels;
  const other = axis === 0 ? 1 : 0;
  const window = windowOf(camera);
  if (!window || !square) {
    // A field of view has square pixels in any case: the picture then keeps its proportions.
    if (square) resolution[other] = whole((pixels * before[other]) / before[axis]);
    camera.resolution = resolution;
    return;
  }
  const edges: [Vec2, Vec2] = [window.x, window.y];
  const sides: Vec2 = [sizeOf(edges[0]), sizeOf(edges[1])];
  resolution[other] = whole((pixels * sides[other]) / sides[axis]);
  camera.resolution = resolution;
  edges[other] = squared(edges[other], resolution, other, sides[axis]);
  writeEdges(camera, window.key, edges);
}

/** The step of a number of pixels that keeps both numbers whole: 4 of 800 × 600. */
export function pixelStep(camera: CameraSource, axis: 0 | 1): number {
  const [columns, rows] = resolutionOf(camera);
  const exact = resolutionOf(camera)[axis] / divisor(columns, rows);
  return exact > 50 ? 1 : exact * Math.ceil(10 / exact);
}

function divisor(a: number, b: number): number {
  return b === 0 ? a : divisor(b, a % b);
}

export function hasSquarePixels(camera: CameraSource): boolean {
  const window = windowOf(camera);
  if (!window) return true;
  const [columns, rows] = resolutionOf(camera);
  return Math.abs(sizeOf(window.x) / columns / (sizeOf(window.y) / rows) - 1) <= SQUARE;
}

/** By how much the sides of a pixel may differ: a little less than where the core warns. */
const SQUARE = 5e-10;
/** How far the number of columns may go for the sake of a whole number of rows. */
const LEEWAY = 0.1;

/** A resolution near this one with the proportions of the window: exactly, if there is one. */
function fitted([columns]: Vec2, [width, height]: Vec2): Vec2 {
  const rowsOf = (count: number): number => (count * height) / width;
  for (let off = 0; off <= columns * LEEWAY; off += 1) {
    for (const count of off === 0 ? [columns] : [columns + off, columns - off]) {
      const rows = rowsOf(count);
      if (Math.round(rows) >= 1 && Math.abs(Math.round(rows) / rows - 1) <= SQUARE) return [count, Math.round(rows)];
    }
  }
  return [columns, whole(rowsOf(columns))];
}

/** The edges of one side of a window with square pixels, by the size of its other side; as they are where they fit. */
function squared(edges: Vec2, resolution: Vec2, axis: 0 | 1, otherSize: number): Vec2 {
  const size = (otherSize * resolution[axis]) / resolution[axis === 0 ? 1 : 0];
  return Math.abs(sizeOf(edges) / size - 1) <= SQUARE ? edges : spread(middleOf(edges), size);
}

function whole(count: number): number {
  return Math.max(1, Math.round(count));
}

/** Moves the middle of the window. */
export function setWindowMiddle(camera: CameraSource, axis: 0 | 1, middle: number): void {
  const window = windowOf(camera);
  if (!window) return;
  const edges: [Vec2, Vec2] = [window.x, window.y];
  edges[axis] = spread(middle, sizeOf(edges[axis]));
  writeEdges(camera, window.key, edges);
}

function writeEdges(camera: CameraSource, key: 'screen' | 'window', [x, y]: [Vec2, Vec2]): void {
  if (key === 'window') camera.window = { x, y };
  else camera.screen = { distance: camera.screen?.distance ?? 1, x, y };
}

/** Frames the same picture another way, as far as it can: a field of view is always centred. `distance` is that of a new screen. */
export function setFraming(camera: CameraSource, framing: 'screen' | 'field_of_view', distance: number): void {
  const before = framingOf(camera);
  if (before === framing) return;
  const [columns, rows] = resolutionOf(camera);
  if (framing === 'field_of_view') {
    const window = camera.screen;
    camera.field_of_view = window
      ? rounded((2 * Math.atan(sizeOf(window.x) / 2 / window.distance) * 180) / Math.PI, 12)
      : FIELD_OF_VIEW;
    delete camera.screen;
  } else {
    const field = Math.min(camera.field_of_view ?? FIELD_OF_VIEW, 170);
    const width = rounded(2 * distance * Math.tan((field * Math.PI) / 360), 12);
    camera.screen = { distance, x: spread(0, width), y: spread(0, (width * rows) / columns) };
    delete camera.field_of_view;
  }
  delete camera.intrinsics;
}

const FIELD_OF_VIEW = 40;

/** Changes the projection: drops the keys of the others and writes those that it needs. `distance` is how far away the things seen
 * are, `radius` how large. */
export function setProjection(camera: CameraSource, projection: Projection, distance: number, radius: number): void {
  if (projection === projectionOf(camera)) return;
  const [columns, rows] = resolutionOf(camera);
  const isRound = (name: Projection): boolean => name.startsWith('fisheye');
  const keepsField = isRound(projection) && isRound(projectionOf(camera));
  if (!keepsField) delete camera.field_of_view;
  for (const key of ['screen', 'window', 'intrinsics', 'longitude', 'latitude']) delete camera[key];
  if (projection === 'perspective') delete camera.projection;
  else camera.projection = projection;
  const half = rounded(1.25 * radius, 2);
  const high = columns < rows ? (half * rows) / columns : half;
  const wide = (high * columns) / rows;
  if (projection === 'perspective') camera.screen = { distance, x: [-wide, wide], y: [-high, high] };
  else if (projection === 'orthographic') camera.window = { x: [-wide, wide], y: [-high, high] };
  else if (isRound(projection)) camera.field_of_view ??= 180;
}

export function viewModeOf(camera: CameraSource): ViewMode {
  if (camera.pose !== undefined) return 'pose';
  if (camera.target) return 'target';
  if (camera.tilt !== undefined) return camera.tilt === 0 && camera.azimuth === undefined ? 'down' : 'angles';
  return 'forward';
}

/** The direction of view as it is written; −z if it is not. */
export function viewOf(camera: CameraSource): Vec3 {
  if (camera.target && camera.eye) return unit(subtract(camera.target, camera.eye)) ?? [0, 0, -1];
  if (camera.tilt !== undefined) return directionOf(camera.tilt, camera.azimuth ?? 90);
  return camera.forward ?? [0, 0, -1];
}

/** Writes the direction of view another way. `at` is what a target is put at. */
export function setView(camera: CameraSource, mode: Exclude<ViewMode, 'pose'>, at: Vec3): void {
  const view = viewOf(camera);
  for (const key of ['forward', 'target', 'tilt', 'azimuth']) delete camera[key];
  if (mode === 'target') {
    camera.target = at;
  } else if (mode === 'forward') {
    camera.forward = view.map((part) => rounded(part, 6)) as Vec3;
  } else if (mode === 'angles') {
    const { tilt, azimuth } = anglesOf(view);
    camera.tilt = tilt;
    camera.azimuth = azimuth ?? 90;
  } else {
    camera.tilt = 0;
  }
  const up = camera.up;
  if (up && isAlong(up, viewOf(camera))) delete camera.up;
}

function isAlong(a: Vec3, b: Vec3): boolean {
  const [u, v] = [unit(a), unit(b)];
  if (!u || !v) return false;
  return Math.abs(u[0] * v[0] + u[1] * v[1] + u[2] * v[2]) > 1 - 1e-9;
}

/** How far the eye is from a point. */
export function distanceFrom(camera: CameraSource, point: Vec3): number {
  return rounded(length(subtract(point, camera.eye ?? [0, 0, 0])), 3);
}
