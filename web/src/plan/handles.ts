/** What can be moved in a view, and how the scene changes with it. */

import type { SceneInfo, Vec3 } from '../engine/types';
import { itemsOf, PLACES, SHAPES, type Item, type ShapeList } from '../scene/edit';
import { extentOf } from '../scene/extent';
import { aimModeOf, directionOfLight, emissionOf } from '../scene/light';
import type { SceneSource } from '../scene/model';
import { setAt, valueAt } from '../scene/path';
import { add, anglesOf, dot, length, rounded, scale, subtract, unit } from '../scene/vector';
import { text } from '../text/index.svelte';
import { directionOf, type View } from './view';

export type HandleKind = 'eye' | 'lamp' | 'aim' | 'shape' | 'end' | 'radius' | 'probe';

export interface Handle {
  key: string;
  kind: HandleKind;
  /** The item that it belongs to. */
  item: string;
  name: string;
  /** What of it this is: the key of a place, or "axis", "radius". */
  part: string;
  at: Vec3;
  /** Where the line to it starts. */
  from: Vec3 | null;
  on: boolean;
  move: (draft: SceneSource, to: Vec3) => void;
}

/** What a handle is called. */
export function nameOfHandle({ kind, part, name }: Pick<Handle, 'kind' | 'part' | 'name'>): string {
  const words = text.words.fields.plan;
  if (kind === 'eye') return words.eye;
  if (kind === 'lamp') return words.light(name);
  if (kind === 'probe') return words.probe(name);
  if (kind === 'radius') return words.radiusOf(name);
  if (kind === 'aim') return name === '' ? words.target : part === 'axis' ? words.axisOf(name) : words.targetOf(name);
  if (kind === 'end') return (part === 'from' || part === 'base' ? words.startOf : words.endOf)(name);
  return name;
}

/** More of a kind would be no picture. */
export const MOST = 60;

export function handlesOf(scene: SceneSource, info: SceneInfo, view: View): Handle[] {
  const { radius } = extentOf(scene, info);
  return [...shapeHandles(scene, view), ...probeHandles(scene), ...eyeHandles(scene), ...lampHandles(scene, radius)];
}

/** What can be moved on the picture, in planes parallel to it: `right` is what runs to the right there. */
export function pictureHandlesOf(scene: SceneSource, right: Vec3): Handle[] {
  const solids = SHAPES.filter((list) => list !== 'plane').flatMap((list) =>
    itemsOf(scene, list)
      .slice(0, MOST)
      .flatMap((shape, index) => solidHandles(scene, list, `${list}[${index}]`, shape, right)),
  );
  const lamps = (scene.light ?? []).slice(0, MOST).flatMap(({ name, on }, index) => {
    const item = `light[${index}]`;
    return place(scene, item, name ?? item, 'lamp', 'position').map((handle) => ({ ...handle, on: on !== false }));
  });
  return [...solids, ...lamps];
}

/** The middle of a solid, and the rim of a sphere. */
function solidHandles(scene: SceneSource, list: ShapeList, item: string, shape: Item, right: Vec3): Handle[] {
  const places = PLACES.flatMap((key) => {
    const at = shape[key];
    return Array.isArray(at) && at.length === 3 ? [{ path: `${item}.${key}`, at: at as Vec3 }] : [];
  });
  if (places.length === 0) return [];
  const at = scale(places.map((one) => one.at).reduce(add), 1 / places.length);
  const move = (draft: SceneSource, to: Vec3): void => {
    const shift = subtract(to, at);
    for (const one of places) {
      setAt(draft, one.path, places.length === 1 ? to : add(one.at, shift).map((part) => rounded(part, 12) + 0));
    }
  };
  const name = shape.name ?? item;
  const middle: Handle = { key: item, kind: 'shape', item, name, part: 'center', at, from: null, on: true, move };
  return list === 'sphere' ? [middle, ...radiusHandle(scene, item, name, right)] : [middle];
}

/** How many items have no handles. */
export function hiddenOf(scene: SceneSource): number {
  const lists = [...SHAPES, 'light', 'probe'] as const;
  return lists.reduce((sum, list) => sum + Math.max(0, itemsOf(scene, list).length - MOST), 0);
}

function place(scene: SceneSource, item: string, name: string, kind: HandleKind, part: string): Handle[] {
  const path = `${item}.${part}`;
  const at = valueAt(scene, path);
  if (!Array.isArray(at) || at.length !== 3) return [];
  const move = (draft: SceneSource, to: Vec3): void => setAt(draft, path, to);
  return [{ key: path, kind, item, name, part, at: at as Vec3, from: null, on: true, move }];
}

function shapeHandles(scene: SceneSource, view: View): Handle[] {
  return SHAPES.flatMap((list) =>
    itemsOf(scene, list)
      .slice(0, MOST)
      .flatMap((shape, index) => {
        const item = `${list}[${index}]`;
        const name = shape.name ?? item;
        const isEnd = list === 'cylinder' || list === 'cone';
        const places = PLACES.flatMap((part) => place(scene, item, name, isEnd ? 'end' : 'shape', part));
        return list === 'sphere' ? [...places, ...radiusHandle(scene, item, name, directionOf(view.right))] : places;
      }),
  );
}

/** The rim of a sphere, at its right. */
function radiusHandle(scene: SceneSource, item: string, name: string, right: Vec3): Handle[] {
  const center = valueAt(scene, `${item}.center`) as Vec3 | undefined;
  const radius = valueAt(scene, `${item}.radius`);
  if (!Array.isArray(center) || typeof radius !== 'number') return [];
  const at = add(center, scale(right, radius));
  const move = (draft: SceneSource, to: Vec3): void => {
    const size = rounded(Math.abs(dot(subtract(to, center), right)), 12);
    if (size > 0) setAt(draft, `${item}.radius`, size);
  };
  return [{ key: `${item}.radius`, kind: 'radius', item, name, part: 'radius', at, from: null, on: true, move }];
}

function probeHandles(scene: SceneSource): Handle[] {
  return (scene.probe ?? [])
    .slice(0, MOST)
    .flatMap(({ name }, index) => place(scene, `probe[${index}]`, name ?? `probe[${index}]`, 'probe', 'at'));
}

function eyeHandles(scene: SceneSource): Handle[] {
  const eye = place(scene, 'camera', '', 'eye', 'eye');
  const target = place(scene, 'camera', '', 'aim', 'target');
  return [...target.map((handle) => ({ ...handle, from: scene.camera.eye ?? null })), ...eye];
}

function lampHandles(scene: SceneSource, radius: number): Handle[] {
  return (scene.light ?? []).slice(0, MOST).flatMap((light, index) => {
    const item = `light[${index}]`;
    const name = light.name ?? item;
    const on = light.on !== false;
    const { position } = light;
    const lamp = place(scene, item, name, 'lamp', 'position');
    if (!position || emissionOf(light) === 'isotropic') return lamp.map((handle) => ({ ...handle, on }));
    const target = place(scene, item, name, 'aim', 'target');
    const tip = add(position, scale(unit(directionOfLight(light)) ?? [0, 0, -1], radius));
    const axis: Handle = {
      key: `${item}.axis`,
      kind: 'aim',
      item,
      name,
      part: 'axis',
      at: tip,
      from: position,
      on,
      move: turn(item),
    };
    const aim = target.length > 0 ? target : [axis];
    return [...aim, ...lamp].map((handle) => ({ ...handle, on, from: handle.kind === 'aim' ? position : null }));
  });
}

/** Turns the axis of a lamp to where its tip was moved, written as it was. */
function turn(item: string): Handle['move'] {
  const index = Number(/\d+/.exec(item)?.[0]);
  return (draft, to) => {
    const light = draft.light?.[index];
    if (!light?.position) return;
    const direction = subtract(to, light.position);
    if (length(direction) === 0) return;
    if (aimModeOf(light) === 'vector') {
      light.axis = (unit(direction) ?? direction).map((part) => rounded(part, 4)) as Vec3;
      return;
    }
    const { tilt, azimuth } = anglesOf(direction);
    light.tilt = Number(tilt.toFixed(1));
    light.azimuth = Number((azimuth ?? light.azimuth ?? 0).toFixed(1));
  };
}
