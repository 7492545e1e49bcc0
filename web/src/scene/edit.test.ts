import { describe, expect, it } from 'vitest';
import * as edit from './edit';
import type { SceneSource } from './model';
import { keysOf, setAt, valueAt } from './path';
import { randomScene, SEEDS } from './random-scene';

function scene(): SceneSource {
  return {
    version: 1,
    length: 'm',
    camera: { eye: [0, 0, 0], forward: [0, 0, 1], screen: { distance: 5, x: [-4, 4], y: [-3, 3] } },
    material: { clay: { diffuse: 0.7 }, 'clay.glazed': { diffuse: 0.5 } },
    sphere: [{ name: 'ball', center: [0, 0, 5], radius: 1, material: 'clay' }],
    plane: [
      { point: [0, 0, 0], normal: [0, 1, 0], material: 'clay' },
      { point: [0, 1, 0], normal: [0, 1, 0], material: 'clay.glazed' },
    ],
    light: [{ name: 'lamp', position: [5, 5, -10], intensity: 100 }],
    area: [
      { name: 'A', on: 'plane[0]', center: [0, 0, 0], radius: 1 },
      { name: 'B', on: 'plane[1]', center: [0, 1, 0], radius: 1 },
      { name: 'C', at: [0, 0], radius: 1 },
    ],
  };
}

describe('a path', () => {
  it('leads to numbers, tables and materials with dots in their names', () => {
    const it = scene();
    expect(valueAt(it, 'light[0].position[1]')).toBe(5);
    expect(valueAt(it, 'camera.screen.x[0]')).toBe(-4);
    expect(keysOf(it, 'material.clay.glazed.diffuse')).toEqual(['material', 'clay.glazed', 'diffuse']);
    expect(valueAt(it, 'material.clay.glazed.diffuse')).toBe(0.5);
    expect(valueAt(it, 'material.clay.diffuse')).toBe(0.7);
    expect(valueAt(it, 'light[3].position')).toBeUndefined();
    expect(valueAt(it, 'title.length')).toBeUndefined();
    expect(valueAt(it, '__proto__.x')).toBeUndefined();
  });

  it('is written to, also where its tables are missing', () => {
    const it = scene();
    setAt(it, 'light[0].position[1]', 6);
    setAt(it, 'ambient.radiance', 2);
    expect(it.light?.[0]?.position).toEqual([5, 6, -10]);
    expect(it.ambient).toEqual({ radiance: 2 });
    setAt(it, 'ambient', undefined);
    expect('ambient' in it).toBe(false);
  });

  it('finds again what it wrote, in any scene', () => {
    for (const seed of SEEDS) {
      const it = randomScene(seed);
      for (const name of Object.keys(it.material ?? {})) {
        setAt(it, `material.${name}.shininess`, seed);
        expect(it.material?.[name]?.shininess).toBe(seed);
      }
    }
  });
});

describe('the lists', () => {
  it('get names of their own', () => {
    expect(edit.uniqueName([], 'lamp')).toBe('lamp');
    expect(edit.uniqueName(['lamp'], 'lamp')).toBe('lamp 2');
    expect(edit.uniqueName(['lamp', 'lamp 2'], 'lamp 2')).toBe('lamp 3');
    expect(edit.uniqueName(['P1', 'P2'], 'P1')).toBe('P 2');
    const it = scene();
    expect(edit.duplicate(it, 'light[0]', [1, 0, 0])).toBe('light[1]');
    expect(it.light?.[1]).toEqual({ name: 'lamp 2', position: [6, 5, -10], intensity: 100 });
    expect(edit.isNameFree(it, 'light[1]', 'lamp')).toBe(false);
    expect(edit.isNameFree(it, 'light[1]', 'lamp 2')).toBe(true);
    expect(edit.isNameFree(it, 'plane[0]', 'ball')).toBe(false);
  });

  it('are as before after a duplicate is removed', () => {
    for (const seed of SEEDS) {
      const before = randomScene(seed);
      const it = structuredClone(before);
      for (const list of edit.LISTS.filter((name) => name !== 'area')) {
        if (edit.itemsOf(it, list).length === 0) continue;
        const copy = edit.duplicate(it, `${list}[0]`);
        expect(new Set(edit.namesBeside(it, list)).size).toBe(edit.namesBeside(it, list).length);
        edit.remove(it, copy as string);
      }
      expect(it).toEqual(before);
    }
  });

  it('take areas along when a shape is renamed, moved up or removed', () => {
    const it = scene();
    edit.rename(it, 'plane[0]', 'floor');
    expect(it.area?.map(({ on }) => on)).toEqual(['floor', 'plane[1]', undefined]);
    edit.rename(it, 'plane[0]', '');
    expect(it.area?.[0]?.on).toBe('plane[0]');
    edit.remove(it, 'plane[0]');
    expect(it.area?.map(({ name, on }) => [name, on])).toEqual([
      ['B', 'plane[0]'],
      ['C', undefined],
    ]);
    edit.remove(it, 'plane[0]');
    expect(it.area?.map(({ name }) => name)).toEqual(['C']);
    expect(it.plane).toBeUndefined();
  });

  it('are renamed and renamed back without a trace', () => {
    for (const seed of SEEDS) {
      const before = randomScene(seed);
      const it = structuredClone(before);
      const paths = [
        ...Object.keys(it.material ?? {}).map((name) => [`material.${name}`, name] as const),
        ...(it.rectangle ?? []).map((shape, index) => [`rectangle[${index}]`, shape.name ?? ''] as const),
      ];
      for (const [path, name] of paths) {
        edit.rename(it, path, 'a name that nothing has');
        edit.rename(it, path.startsWith('material') ? 'material.a name that nothing has' : path, name);
      }
      expect(it).toEqual(before);
      expect(Object.keys(it.material ?? {})).toEqual(Object.keys(before.material ?? {}));
    }
  });
});

describe('materials', () => {
  it('are followed by their shapes', () => {
    const it = scene();
    edit.rename(it, 'material.clay', 'chalk');
    expect(Object.keys(it.material ?? {})).toEqual(['chalk', 'clay.glazed']);
    expect(edit.usersOf(it, 'chalk')).toEqual(['ball', 'plane[0]']);
    expect(edit.addMaterial(it, 'chalk', 'chalk')).toBe('material.chalk 2');
    edit.removeMaterial(it, 'chalk 2');
    expect(Object.keys(it.material ?? {})).toEqual(['chalk', 'clay.glazed']);
  });
});

describe('a switch', () => {
  it('writes only what is not the default', () => {
    const it = scene();
    edit.switchLight(it, 0, false);
    expect(it.light?.[0]?.on).toBe(false);
    edit.switchLight(it, 0, true);
    expect(it).toEqual(scene());
  });
});
