import { describe, expect, it } from 'vitest';
import type { SceneInfo } from '../engine/types';
import type { SceneSource } from '../scene/model';
import { fivePoints, outlineOf } from './area';

const SCENE: SceneSource = {
  version: 1,
  length: 'mm',
  camera: {},
  plane: [{ name: 'floor', point: [0, 0, 0], normal: [0, 0, 1] }],
};
const INFO = { camera: { right: [1, 0, 0], up: [0, 1, 0] } } as unknown as SceneInfo;

describe('areas', () => {
  it('have the five points of the course’s circle', () => {
    const places = fivePoints({ on: 'floor', center: [10, 0, 0], radius: 300 }, SCENE, INFO);
    expect(places?.points.map((point) => point.map((part) => part + 0))).toEqual([
      [10, 0, 0],
      [310, 0, 0],
      [10, 300, 0],
      [-290, 0, 0],
      [10, -300, 0],
    ]);
  });

  it('have outlines on the screen', () => {
    const places = outlineOf({ at: [1, 2], size: [4, 2] }, SCENE, INFO);
    const across = places?.points.map(([x]) => x) ?? [];
    expect([Math.min(...across), Math.max(...across)]).toEqual([-1, 3]);
  });

  it('have no five points where they are rectangles, and no outline on an unknown shape', () => {
    expect(fivePoints({ at: [0, 0], size: [1, 1] }, SCENE, INFO)).toBeNull();
    expect(outlineOf({ on: 'wall', center: [0, 0, 0], radius: 1 }, SCENE, INFO)).toBeNull();
  });
});
