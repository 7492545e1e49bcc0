/** The outlines of the areas of interest on the screen. The core says where points of a surface appear. */

import type { Vec2 } from '../engine/types';
import type { Session } from '../session.svelte';
import { outlineOf } from './area';

export interface Outline {
  name: string;
  points: Vec2[];
}

export class Outlines {
  #now = $state.raw<Outline[]>([]);

  constructor(session: Session) {
    $effect(() => {
      const { good: scene, info, engine } = session;
      let isWanted = true;
      if (!scene || !info || !scene.area?.length) {
        this.#now = [];
        return;
      }
      const outlines = scene.area.map(async (area, index): Promise<Outline> => {
        const name = area.name ?? `area[${index}]`;
        const places = outlineOf(area, scene, info);
        if (!places || places.kind === 'screen') return { name, points: places?.points ?? [] };
        const probed = await engine.probe(
          scene,
          places.points.map((at) => ({ name, at, snap: true })),
        );
        return { name, points: probed.flatMap(({ reading }) => (reading?.screen ? [reading.screen] : [])) };
      });
      Promise.all(outlines)
        .then((now) => {
          if (isWanted) this.#now = now;
        })
        .catch(() => {
          // A scene that has become another one meanwhile: its own outlines come.
        });
      return () => {
        isWanted = false;
      };
    });
  }

  get now(): Outline[] {
    return this.#now;
  }
}
