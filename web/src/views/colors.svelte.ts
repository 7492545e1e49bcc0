/** The colours of the colour maps, asked of the core once each. */

import type { Colormap, Engine } from '../engine/types';
import { palette } from './paint';

const known = new WeakMap<Engine, Map<Colormap, Promise<Uint32Array>>>();

export function colorsOf(engine: Engine, name: Colormap): Promise<Uint32Array> {
  const ofEngine = known.get(engine) ?? new Map<Colormap, Promise<Uint32Array>>();
  known.set(engine, ofEngine);
  const colors = ofEngine.get(name) ?? engine.colormap(name).then(palette);
  ofEngine.set(name, colors);
  return colors;
}

/** Colours that follow a choice; null until the first ones are there. */
export class Colors {
  #now = $state.raw<Uint32Array | null>(null);

  constructor(engine: Engine, name: () => Colormap) {
    $effect(() => {
      let isWanted = true;
      void colorsOf(engine, name()).then((colors) => {
        if (isWanted) this.#now = colors;
      });
      return () => {
        isWanted = false;
      };
    });
  }

  get now(): Uint32Array | null {
    return this.#now;
  }
}
