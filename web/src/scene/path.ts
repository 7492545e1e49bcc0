/** Places in a scene, written as the core writes them: `light[0].position[1]`, `material.clay.diffuse`, `camera.screen.x`. */

import type { SceneSource } from './model';

type Key = string | number;
type Container = Record<Key, unknown>;

/** The keys on the way to a place. A material's name may hold anything, dots and brackets too, so the scene is asked for it. */
export function keysOf(scene: SceneSource, path: string): Key[] {
  const material = materialIn(scene, path);
  if (material !== null) {
    const rest = path.slice(`material.${material}`.length);
    return ['material', material, ...split(rest)];
  }
  return split(path);
}

/** The name of the material that a path leads to or into; null if it leads elsewhere. */
export function materialIn(scene: SceneSource, path: string): string | null {
  if (!path.startsWith('material.')) return null;
  const rest = path.slice('material.'.length);
  const names = Object.keys(scene.material ?? {}).filter((name) => rest === name || rest.startsWith(`${name}.`));
  return names.sort((a, b) => b.length - a.length)[0] ?? null;
}

function split(path: string): Key[] {
  return [...path.matchAll(/([^.[\]]+)|\[(\d+)\]/g)].map((part) => part[1] ?? Number(part[2]));
}

/** What is written at a place; undefined if nothing is. */
export function valueAt(scene: SceneSource, path: string): unknown {
  let value: unknown = scene;
  for (const key of keysOf(scene, path)) {
    if (!isContainer(value) || !Object.hasOwn(value, key)) return undefined;
    value = value[key];
  }
  return value;
}

/** The number at a place; undefined if there is none. */
export function numberAt(scene: SceneSource, path: string): number | undefined {
  const value = valueAt(scene, path);
  return typeof value === 'number' ? value : undefined;
}

/** Writes a value; tables on the way are made. `undefined` removes the key. */
export function setAt(draft: SceneSource, path: string, value: unknown): void {
  const keys = keysOf(draft, path);
  const last = keys.pop();
  if (last === undefined) throw new RangeError('a path of no keys');
  let container = draft as unknown as Container;
  for (const key of keys) {
    const inner = Object.hasOwn(container, key) ? container[key] : undefined;
    if (isContainer(inner)) {
      container = inner;
    } else {
      const made: Container = {};
      container[key] = made;
      container = made;
    }
  }
  if (value === undefined) delete container[last];
  else container[last] = value;
}

/** The list and the number of an item: `light[2].axis` is in item 2 of "light". null for what is in no list. */
export function itemOf(path: string): { list: string; index: number } | null {
  const match = /^(\w+)\[(\d+)\]/.exec(path);
  return match ? { list: match[1] as string, index: Number(match[2]) } : null;
}

function isContainer(value: unknown): value is Container {
  return typeof value === 'object' && value !== null;
}
