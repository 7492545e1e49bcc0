import { describe, expect, it } from 'vitest';
import type { SceneInfo, Vec3 } from '../engine/types';
import type { SceneSource } from '../scene/model';
import { handlesOf } from './handles';
import { fitOf, flat, moved, niceLength, viewOf } from './view';

function scene(): SceneSource {
  return {
    version: 1,
    length: 'm',
    camera: { eye: [0, 0, 0], forward: [0, 0, 1], screen: { distance: 5, x: [-4, 4], y: [-3, 3] } },
    sphere: [{ name: 'ball', center: [0, 0, 5], radius: 1 }],
    light: [
      { name: 'lamp', position: [5, 5, -10], intensity: 100, emission: 'lambertian', axis: [0, -1, 0] },
      { name: 'star', position: [0, 1e6, 0], intensity: 100 },
    ],
    probe: [{ name: 'P', at: [0, 0, 4] }],
  };
}

function info(forward: Vec3, right: Vec3, up: Vec3): SceneInfo {
  return {
    camera: { projection: 'perspective', eye: [0, 0, 0], right, up, forward, corners: null },
    shapes: [
      {
        name: 'ball',
        kind: 'sphere',
        path: 'sphere[0]',
        material: null,
        center: [0, 0, 5],
        bounds: { low: [-1, -1, 4], high: [1, 1, 6] },
        onScreen: null,
      },
    ],
    lights: [
      { name: 'lamp', kind: 'lambertian', on: true, position: [5, 5, -10], axis: [0, -1, 0], onScreen: null },
      { name: 'star', kind: 'isotropic', on: true, position: [0, 1e6, 0], axis: null, onScreen: null },
    ],
  } as unknown as SceneInfo;
}

const lab = info([0, 0, 1], [1, 0, 0], [0, 1, 0]);

describe('a view', () => {
  it('from above looks down what is up in the picture', () => {
    expect(flat(viewOf('top', scene(), lab), [1, 2, 3])).toEqual([1, 3]);
    expect(flat(viewOf('side', scene(), lab), [1, 2, 3])).toEqual([3, 2]);
    expect(flat(viewOf('front', scene(), lab), [1, 2, 3])).toEqual([1, 2]);
  });

  it('has z up where angles are counted from −z', () => {
    const course = { ...scene(), camera: { eye: [0, 0, 9] as Vec3, tilt: 0 } };
    const down = info([0, 0, -1], [1, 0, 0], [0, 1, 0]);
    expect(flat(viewOf('top', course, down), [1, 2, 3])).toEqual([1, 2]);
    expect(flat(viewOf('side', course, down), [1, 2, 3])).toEqual([1, 3]);
    expect(flat(viewOf('front', course, down), [1, 2, 3])).toEqual([2, 3]);
  });

  it('moves a point and keeps how deep it is', () => {
    const view = viewOf('side', scene(), lab);
    expect(moved(view, [7, 0, 0], [3, 2])).toEqual([7, 2, 3]);
    expect(flat(view, moved(view, [7, 0, 0], [-3, 2]))).toEqual([-3, 2]);
  });

  it('is not shrunk by a star', () => {
    const { width, height } = fitOf(viewOf('side', scene(), lab), scene(), lab);
    expect(width).toBe(16);
    expect(height).toBe(6);
  });

  it('has round lengths', () => {
    expect([7, 3, 1.5, 0.04, 800].map(niceLength)).toEqual([5, 2, 1, 0.02, 500]);
  });
});

describe('a handle', () => {
  it('moves what it stands for, and nothing else', () => {
    const view = viewOf('top', scene(), lab);
    const handles = handlesOf(scene(), lab, view);
    expect(handles.map(({ key }) => key)).toEqual([
      'sphere[0].center',
      'sphere[0].radius',
      'probe[0].at',
      'camera.eye',
      'light[0].axis',
      'light[0].position',
      'light[1].position',
    ]);
    const it = scene();
    const find = (key: string): (typeof handles)[number] => handles.find((handle) => handle.key === key)!;
    find('sphere[0].radius').move(it, [2.5, 0, 5]);
    expect(it.sphere?.[0]).toEqual({ name: 'ball', center: [0, 0, 5], radius: 2.5 });
    find('light[0].axis').move(it, [6, 5, -10]);
    expect(it.light?.[0]?.axis).toEqual([1, 0, 0]);
    find('camera.eye').move(it, [0, 0, -1]);
    expect(it.camera.eye).toEqual([0, 0, -1]);
  });
});
