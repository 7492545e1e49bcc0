/** Moves what a handle belongs to, and takes the probes on its surface along: left behind, they would be on no surface. */

import type { Vec3 } from '../engine/types';
import { valueAt } from '../scene/path';
import type { SceneSource } from '../scene/model';
import { add, length, rounded, scale, subtract } from '../scene/vector';
import type { Handle } from './handles';

/** What moves the handle and its probes; it starts from the scene as it is now. `shapes` are the names of those that the probes are on. */
export function carrying(
  scene: SceneSource,
  shapes: readonly (string | undefined)[],
  handle: Handle,
): (draft: SceneSource, to: Vec3) => void {
  const { kind, name, at: from } = handle;
  const center = kind === 'radius' ? (valueAt(scene, `${handle.item}.center`) as Vec3) : null;
  const isCarrying = kind === 'shape' || center !== null;
  const probes = (scene.probe ?? []).flatMap(({ at }, index) =>
    isCarrying && shapes[index] === name ? [{ at, index }] : [],
  );
  return (draft, to) => {
    handle.move(draft, to);
    const radius = center && (valueAt(draft, `${handle.item}.radius`) as number);
    for (const { at, index } of probes) {
      const probe = draft.probe?.[index];
      if (!probe) continue;
      const moved =
        center === null
          ? add(at, subtract(to, from))
          : add(center, scale(subtract(at, center), radius! / length(subtract(from, center))));
      probe.at = moved.map((part) => rounded(part, 12) + 0) as Vec3;
    }
  };
}
