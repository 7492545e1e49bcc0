/** Changes to the lists and names of a scene. All of them change a draft, such as `SceneStore.edit` hands out. */

import type { Vec3 } from '../engine/types';
import type { SceneSource } from './model';
import { itemOf, materialIn, valueAt } from './path';
import { add } from './vector';

/** The shapes that the page can make; meshes and lists of spheres come from files. */
export const MADE_SHAPES = ['sphere', 'ellipsoid', 'box', 'cylinder', 'cone', 'plane', 'rectangle', 'disk'] as const;
export const SHAPES = [...MADE_SHAPES, 'mesh', 'spheres'] as const;
export const LISTS = [...SHAPES, 'light', 'probe', 'area', 'grid'] as const;

export type MadeShape = (typeof MADE_SHAPES)[number];
export type ShapeList = (typeof SHAPES)[number];
export type List = (typeof LISTS)[number];

/** What a list holds: tables that may have a name. */
export interface Item {
  name?: string;
  [key: string]: unknown;
}

export function isList(name: string): name is List {
  return (LISTS as readonly string[]).includes(name);
}

/** The items of a list; a scene that has none is given none. */
export function itemsOf(scene: SceneSource, list: List): readonly Item[] {
  return (scene[list] ?? []) as unknown as Item[];
}

function listOf(draft: SceneSource, list: List): Item[] {
  const lists = draft as unknown as Record<List, Item[] | undefined>;
  return (lists[list] ??= []);
}

/** The name that the core knows an item by. */
export function nameOf(scene: SceneSource, path: string): string {
  const name = valueAt(scene, `${path}.name`);
  return typeof name === 'string' ? name : path;
}

/** The names that an item of this list must not have: of all shapes for a shape, of the list otherwise. */
export function namesBeside(scene: SceneSource, list: List): string[] {
  const lists: readonly List[] = (SHAPES as readonly string[]).includes(list) ? SHAPES : [list];
  return lists.flatMap((each) => itemsOf(scene, each).map((item, index) => item.name ?? `${each}[${index}]`));
}

/** A name that is not taken: "lamp", or "lamp 2". */
export function uniqueName(names: readonly string[], wish: string): string {
  const taken = new Set(names);
  if (!taken.has(wish)) return wish;
  const [, stem = wish, number] = /^(.*?)\s*(\d+)$/.exec(wish) ?? [];
  let next = number === undefined ? 2 : Number(number) + 1;
  while (taken.has(`${stem} ${next}`)) next += 1;
  return `${stem} ${next}`;
}

/** Adds an item at the end of its list and says where it is. */
export function append(draft: SceneSource, list: List, item: object): string {
  const items = listOf(draft, list);
  items.push(item as Item);
  return `${list}[${items.length - 1}]`;
}

/** Puts a copy with a name of its own after an item, moved by a vector, and says where it is. */
export function duplicate(draft: SceneSource, path: string, shift: Vec3 = [0, 0, 0]): string | null {
  const place = itemOf(path);
  if (!place || !isList(place.list)) return null;
  const { list, index } = place;
  const items = listOf(draft, list);
  const original = items[index];
  if (!original) return null;
  const copy = structuredClone(original);
  copy.name = uniqueName(namesBeside(draft, list), original.name ?? list);
  move(copy, shift);
  keepingReferences(draft, () => items.splice(index + 1, 0, copy));
  return `${list}[${index + 1}]`;
}

/** The keys whose points are where an item is. A lamp's target is not: it stays what the lamp is aimed at. */
export const PLACES = ['center', 'position', 'point', 'from', 'to', 'base', 'apex', 'at', 'corner'] as const;

export function move(item: Item, shift: Vec3): void {
  for (const key of PLACES) {
    const place = item[key];
    if (Array.isArray(place) && place.length === 3) item[key] = add(place as Vec3, shift);
  }
}

/** Removes an item, and the areas on it. */
export function remove(draft: SceneSource, path: string): void {
  const place = itemOf(path);
  if (!place || !isList(place.list)) return;
  const { list, index } = place;
  keepingReferences(draft, () => listOf(draft, list).splice(index, 1));
  if (itemsOf(draft, list).length === 0) delete draft[list];
}

/** Gives an item or a material another name, which whatever refers to it follows. An empty one takes the name of an item away. */
export function rename(draft: SceneSource, path: string, name: string): void {
  const material = materialIn(draft, path);
  if (material !== null) {
    renameMaterial(draft, material, name);
    return;
  }
  const item = valueAt(draft, path) as Item | undefined;
  if (!item) return;
  keepingReferences(draft, () => {
    if (name === '') delete item.name;
    else item.name = name;
  });
}

/** Whether an item or a material may have this name. */
export function isNameFree(scene: SceneSource, path: string, name: string): boolean {
  const material = materialIn(scene, path);
  if (material !== null) return name !== '' && (name === material || !Object.hasOwn(scene.material ?? {}, name));
  const place = itemOf(path);
  if (!place || !isList(place.list)) return false;
  return name === '' || name === nameOf(scene, path) || !namesBeside(scene, place.list).includes(name);
}

/** Changes lists or names of shapes, and lets the areas that are on a shape follow its name, which depends on its place if it has
 * none of its own. Areas on a shape that is gone go too. */
function keepingReferences(draft: SceneSource, change: () => void): void {
  const before = new Map(shapesByName(draft));
  change();
  if (!draft.area) return;
  const after = new Map([...shapesByName(draft)].map(([name, shape]) => [shape, name]));
  draft.area = draft.area.filter((area) => {
    const shape = area.on === undefined ? undefined : before.get(area.on);
    if (!shape) return true;
    const name = after.get(shape);
    if (name !== undefined) area.on = name;
    return name !== undefined;
  });
  if (draft.area.length === 0) delete draft.area;
}

function* shapesByName(scene: SceneSource): Generator<[string, Item]> {
  for (const list of SHAPES) {
    for (const [index, item] of itemsOf(scene, list).entries()) yield [item.name ?? `${list}[${index}]`, item];
  }
}

/** Adds a material and says where it is. */
export function addMaterial(draft: SceneSource, wish: string, like?: string): string {
  const materials = (draft.material ??= {});
  const name = uniqueName(Object.keys(materials), wish);
  materials[name] = like !== undefined && materials[like] ? structuredClone(materials[like]) : { diffuse: 0.7 };
  return `material.${name}`;
}

export function removeMaterial(draft: SceneSource, name: string): void {
  delete draft.material?.[name];
  if (draft.material && Object.keys(draft.material).length === 0) delete draft.material;
}

/** The names of the shapes that are of a material. */
export function usersOf(scene: SceneSource, material: string): string[] {
  return [...shapesByName(scene)].filter(([, shape]) => shape.material === material).map(([name]) => name);
}

function renameMaterial(draft: SceneSource, from: string, to: string): void {
  if (from === to || !draft.material) return;
  // The order stays: that of the file.
  draft.material = Object.fromEntries(Object.entries(draft.material).map(([name, it]) => [name === from ? to : name, it]));
  for (const [, shape] of shapesByName(draft)) {
    if (shape.material === from) shape.material = to;
  }
}

/** Switches a light on or off. */
export function switchLight(draft: SceneSource, index: number, on: boolean): void {
  const light = draft.light?.[index];
  if (!light) return;
  if (on) delete light.on;
  else light.on = false;
}
