/** What the core says of the place under the pointer, soon after it stopped there. */

import type { ProbeReading, Vec2 } from '../engine/types';
import type { Session } from '../session.svelte';

/** In ms. */
const PAUSE = 60;

export class ExactReading {
  #now = $state.raw<{ at: Vec2; reading: ProbeReading | null } | null>(null);
  readonly #session: Session;

  constructor(session: Session) {
    this.#session = session;
    $effect(() => {
      const { pointer: screen, good: scene, engine } = session;
      if (!screen || !scene) return;
      let isWanted = true;
      const timer = setTimeout(() => {
        engine.probe(scene, [{ name: '', screen }]).then(
          ([probed]) => {
            if (isWanted) this.#now = { at: screen, reading: probed?.reading ?? null };
          },
          () => {
            // The pixel's value stays.
          },
        );
      }, PAUSE);
      return () => {
        isWanted = false;
        clearTimeout(timer);
      };
    });
  }

  /** The reading at the pointer; null until it is there, and where no surface is. */
  get now(): ProbeReading | null {
    return this.#now?.at === this.#session.pointer ? this.#now.reading : null;
  }
}

/** The value of a channel in a reading; null for those that readings do not hold. */
export function valueIn(reading: ProbeReading, channel: string): number | null {
  switch (channel) {
    case 'brightness':
      return reading.brightness;
    case 'irradiance':
      return reading.irradiance;
    case 'diffuse':
      return reading.diffuse;
    case 'specular':
      return reading.specular;
    case 'ambient':
      return reading.ambient;
    case 'cos_theta_o':
      return reading.cosThetaO;
    default: {
      const name = channel.startsWith('light.') ? channel.slice('light.'.length) : null;
      return reading.lights.find((light) => light.name === name)?.irradiance ?? null;
    }
  }
}
