import { expect, it } from 'vitest';
import { SceneStore, sharing } from './store.svelte';
import type { SceneSource } from './model';

it('an edit shares what it leaves alone with the scene before', () => {
  const scene: SceneSource = {
    version: 1,
    length: 'm',
    camera: { eye: [0, 0, 0] },
    light: [
      { position: [1, 2, 3], intensity: 1 },
      { position: [4, 5, 6], intensity: 2 },
    ],
  };
  const store = new SceneStore(scene);
  store.edit((draft) => (draft.light![1]!.intensity = 3));
  expect(store.scene.light![1]).toEqual({ position: [4, 5, 6], intensity: 3 });
  expect(store.scene.light![0]).toBe(scene.light![0]);
  expect(store.scene.light![1]!.position).toBe(scene.light![1]!.position);
  expect(store.scene.camera).toBe(scene.camera);
  expect(scene.light![1]!.intensity).toBe(2);
});

it('equal parts at other places are not taken for the same', () => {
  const before = { list: [{ a: 1 }, { a: 2 }], one: [1] as unknown };
  const now = sharing({ list: [{ a: 2 }], one: { 0: 1 } }, before);
  expect(now).toEqual({ list: [{ a: 2 }], one: { 0: 1 } });
});
