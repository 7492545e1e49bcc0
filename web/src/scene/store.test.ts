import { describe, expect, it } from 'vitest';
import { append, duplicate, remove } from './edit';
import { setAt } from './path';
import { randomNumbers, randomScene, SEEDS } from './random-scene';
import { SceneStore } from './store.svelte';

describe('the history', () => {
  it('goes back to the first scene and forward to the last one, whatever the edits', () => {
    for (const seed of SEEDS.slice(0, 60)) {
      const random = randomNumbers(seed);
      const first = randomScene(seed);
      const kept = structuredClone(first);
      const store = new SceneStore(first);
      const seen = [structuredClone(first)];
      for (let step = 0; step < 20; step += 1) {
        store.edit((draft) => {
          const choice = random();
          if (choice < 0.3) append(draft, 'light', { position: [random(), 0, 0], intensity: 1 });
          else if (choice < 0.5) duplicate(draft, 'light[0]');
          else if (choice < 0.7) remove(draft, `light[${Math.floor(random() * 3)}]`);
          else setAt(draft, 'camera.eye[1]', random());
        });
        seen.push(structuredClone(store.scene));
      }
      for (let step = 19; step >= 0; step -= 1) {
        store.undo();
        expect(store.scene).toEqual(seen[step]);
      }
      expect(store.canUndo).toBe(false);
      expect(store.scene).toEqual(kept);
      for (let step = 1; step <= 20; step += 1) {
        store.redo();
        expect(store.scene).toEqual(seen[step]);
      }
      expect(store.canRedo).toBe(false);
    }
  });

  it('takes the edits of a drag back together, and two drags one after the other', () => {
    const store = new SceneStore(randomScene(1));
    const drag = (value: number): void => store.edit((draft) => setAt(draft, 'camera.eye[0]', value), 'camera.eye');
    const before = store.scene;
    [1, 2, 3].forEach(drag);
    store.endStep();
    const between = store.scene;
    [4, 5].forEach(drag);
    store.endStep();
    store.undo();
    expect(store.scene).toBe(between);
    store.undo();
    expect(store.scene).toBe(before);
    store.redo();
    store.redo();
    expect(store.scene.camera.eye?.[0]).toBe(5);
  });

  it('forgets what was undone when something else is done', () => {
    const store = new SceneStore(randomScene(2));
    store.edit((draft) => setAt(draft, 'title', 'one'));
    store.undo();
    store.edit((draft) => setAt(draft, 'title', 'two'));
    expect(store.canRedo).toBe(false);
    store.redo();
    expect(store.scene.title).toBe('two');
  });

  it('keeps two hundred steps', () => {
    const store = new SceneStore(randomScene(2));
    for (let step = 0; step < 500; step += 1) store.edit((draft) => setAt(draft, 'title', String(step)));
    let undone = 0;
    while (store.canUndo) {
      store.undo();
      undone += 1;
    }
    expect(undone).toBe(200);
  });
});
