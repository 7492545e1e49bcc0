/** The scene that the page shows, and its history. Scenes are never changed in place: every edit makes another one. */

import type { SceneSource } from './model';

/** Steps that can be undone. */
const DEPTH = 200;

/** What one press of "undo" takes back: edits with the same name that follow each other, such as those of a drag. */
interface Step {
  before: SceneSource;
  name: string | null;
}

export class SceneStore {
  #scene = $state.raw<SceneSource>() as SceneSource;
  #undone = $state.raw<SceneSource[]>([]);
  #steps = $state.raw<Step[]>([]);

  constructor(scene: SceneSource) {
    this.#scene = scene;
  }

  get scene(): SceneSource {
    return this.#scene;
  }

  get canUndo(): boolean {
    return this.#steps.length > 0;
  }

  get canRedo(): boolean {
    return this.#undone.length > 0;
  }

  /** Replaces the scene. Edits that follow each other with the same `name` are one step of undo, until `endStep`. */
  set(scene: SceneSource, name: string | null = null): void {
    if (scene === this.#scene) return;
    const continues = name !== null && this.#steps.at(-1)?.name === name;
    if (!continues) {
      this.#steps = [...this.#steps.slice(1 - DEPTH), { before: this.#scene, name }];
    }
    this.#undone = [];
    this.#scene = scene;
  }

  /** Changes a copy of the scene. */
  edit(change: (draft: SceneSource) => void, name: string | null = null): void {
    const draft = structuredClone(this.#scene);
    change(draft);
    // Another scene even where nothing changed: every edit can be undone.
    this.set({ ...sharing(draft, this.#scene) }, name);
  }

  /** The next edit is a step of its own, whatever it is called: at the end of a drag, say. */
  endStep(): void {
    const last = this.#steps.at(-1);
    if (last?.name != null) {
      this.#steps = [...this.#steps.slice(0, -1), { ...last, name: null }];
    }
  }

  undo(): void {
    const last = this.#steps.at(-1);
    if (!last) return;
    this.#undone = [...this.#undone, this.#scene];
    this.#steps = this.#steps.slice(0, -1);
    this.#scene = last.before;
  }

  redo(): void {
    const next = this.#undone.at(-1);
    if (!next) return;
    this.#steps = [...this.#steps, { before: this.#scene, name: null }];
    this.#undone = this.#undone.slice(0, -1);
    this.#scene = next;
  }
}

/** A value with the parts of an earlier one that are equal to its own: a history of large scenes then holds what changed only. */
export function sharing<T>(now: T, before: unknown): T {
  if (typeof now !== 'object' || now === null || typeof before !== 'object' || before === null) return now;
  if (Array.isArray(now) !== Array.isArray(before)) return now;
  const [own, earlier] = [now as Record<string, unknown>, before as Record<string, unknown>];
  const keys = Object.keys(own);
  let isSame = keys.length === Object.keys(earlier).length;
  for (const key of keys) {
    own[key] = sharing(own[key], earlier[key]);
    if (own[key] !== earlier[key]) isSame = false;
  }
  return isSame ? (before as T) : now;
}
