/** The last scene, kept by the browser. */

import type { SceneSource } from './model';

/** Why the browser keeps nothing: its storage is full, or it allows none. The scene on the page is not concerned. */
export type StorageFault = 'full' | 'forbidden';

const KEY = 'isophote.scene';
const DELAY = 400;

export class SceneKeeper {
  #storage: Storage | null;
  #report: (fault: StorageFault | null) => void;
  #timer: ReturnType<typeof setTimeout> | null = null;
  #waiting: SceneSource | null = null;
  #fault: StorageFault | null = null;

  /** `report` is told when keeping begins to fail, and when it works again. */
  constructor(report: (fault: StorageFault | null) => void, storage: Storage | null = browserStorage()) {
    this.#report = report;
    this.#storage = storage;
  }

  /** The JSON of the scene kept last, for the core to read; null if there is none. */
  last(): string | null {
    try {
      return this.#storage?.getItem(KEY) ?? null;
    } catch {
      return null;
    }
  }

  /** Keeps a scene a little later, unless another one follows. */
  keep(scene: SceneSource): void {
    this.#waiting = scene;
    this.#timer ??= setTimeout(() => this.flush(), DELAY);
  }

  /** Keeps at once what is waiting: before the page goes away. */
  flush(): void {
    if (this.#timer !== null) clearTimeout(this.#timer);
    this.#timer = null;
    const scene = this.#waiting;
    if (!scene) return;
    this.#waiting = null;
    this.#note(this.#write(JSON.stringify(scene)));
  }

  forget(): void {
    this.#waiting = null;
    try {
      this.#storage?.removeItem(KEY);
    } catch {
      // What cannot be removed cannot have been kept.
    }
  }

  #write(json: string): StorageFault | null {
    if (!this.#storage) return 'forbidden';
    try {
      this.#storage.setItem(KEY, json);
      return null;
    } catch (error) {
      return error instanceof DOMException && error.name === 'QuotaExceededError' ? 'full' : 'forbidden';
    }
  }

  #note(fault: StorageFault | null): void {
    if (fault === this.#fault) return;
    this.#fault = fault;
    this.#report(fault);
  }
}

/** The browser's storage; null where it is forbidden, which merely asking for it may already be. */
function browserStorage(): Storage | null {
  try {
    return globalThis.localStorage;
  } catch {
    return null;
  }
}
