import { describe, expect, it } from 'vitest';
import type { SceneInfo, Vec2, Vec3 } from '../engine/types';
import type { SceneSource } from '../scene/model';
import { add, dot, scale, subtract } from '../scene/vector';
import { carrying } from './carry';
import { pictureHandlesOf } from './handles';
import { ScreenPlane } from './screen';

interface Camera {
  eye: Vec3;
  right: Vec3;
  up: Vec3;
  forward: Vec3;
  /** 0 for parallel rays. */
  distance: number;
}
const WINDOW: { x: Vec2; y: Vec2 } = { x: [-4, 4], y: [-3, 3] };

function screenOf({ eye, right, up, forward, distance }: Camera, window = WINDOW): ScreenPlane {
  const corner = (x: number, y: number) => add(add(eye, scale(forward, distance)), add(scale(right, x), scale(up, y)));
  const [[left, end], [bottom, top]] = [window.x, window.y];
  const projection = distance > 0 ? 'perspective' : 'orthographic';
  const corners = [corner(left, bottom), corner(end, bottom), corner(end, top), corner(left, top)];
  return ScreenPlane.of({ camera: { projection, eye, right, up, forward, corners }, window } as unknown as SceneInfo)!;
}

const LAB: Camera = { eye: [0, 0, 0], right: [1, 0, 0], up: [0, 1, 0], forward: [0, 0, 1], distance: 5 };
const [third, half, sixth] = [1 / Math.sqrt(3), 1 / Math.sqrt(2), 1 / Math.sqrt(6)];
/** From (1, 1, 1) towards the origin. */
const OBLIQUE: Camera = {
  eye: [10, 10, 10],
  right: [half, -half, 0],
  up: [-sixth, -sixth, 2 * sixth],
  forward: [-third, -third, -third],
  distance: 2,
};

describe('the plane of the picture', () => {
  it('shows points by similar triangles', () => {
    const lab = screenOf(LAB);
    expect(lab.project([2, 4, 10])).toEqual([1, 2]);
    expect(lab.project([0.5, -1, 5])).toEqual([0.5, -1]);
    expect(lab.project([0, 0, -1])).toBeNull();
    expect(lab.at([1, 2], [7, 7, 10])).toEqual([2, 4, 10]);
    const parallel = screenOf({ ...LAB, distance: 0 });
    expect(parallel.project([2, 1, 10])).toEqual([2, 1]);
    expect(parallel.at([2, 1], [0, 0, 30])).toEqual([2, 1, 30]);
  });

  it.each([LAB, OBLIQUE, { ...OBLIQUE, distance: 0 }])('finds the point of a plane that appears at a place', (camera) => {
    const plane = screenOf(camera, { x: [-1, 3], y: [-2, 0.5] });
    const through: Vec3 = [1, 2, 3.5];
    for (const place of [
      [0, 0],
      [2.5, -1.75],
    ] as Vec2[]) {
      const point = plane.at(place, through);
      expect(dot(subtract(point, through), camera.forward)).toBeCloseTo(0, 12);
      const [x, y] = plane.project(point)!;
      expect(x).toBeCloseTo(place[0], 12);
      expect(y).toBeCloseTo(place[1], 12);
    }
  });

  it('keeps what is the same all over the plane, and writes short numbers', () => {
    expect(screenOf(LAB).tidy([0.123456, 1.98765, 5.0000001], [0, 0, 5.4321], 0.01)).toEqual([0.12, 1.99, 5.4321]);
    const tidy = screenOf(OBLIQUE).tidy([0.1234567, 1.9876543, 0.5], [0, 0, 0], 0.01);
    expect(tidy).toEqual([0.1235, 1.9877, 0.5]);
  });

  it('has no points of a fisheye', () => {
    expect(ScreenPlane.of({ camera: { corners: null } } as unknown as SceneInfo)).toBeNull();
  });
});

describe('handles on the picture', () => {
  const scene: SceneSource = {
    version: 1,
    length: 'm',
    camera: {},
    sphere: [{ name: 'ball', center: [0, 0, 5], radius: 1 }],
    cylinder: [{ name: 'rod', from: [0, 0, 0], to: [0, 2, 0], radius: 1 }],
    plane: [{ name: 'floor', point: [0, 0, 0], normal: [0, 1, 0] }],
    light: [
      { name: 'lamp', position: [1, 2, 3], intensity: 1 },
      { name: 'sun', direction: [0, -1, 0] },
    ],
  };
  const handles = () => pictureHandlesOf(scene, [0, 0, -1]);
  const after = (key: string, to: Vec3): SceneSource => {
    const draft = structuredClone(scene);
    handles()
      .find((handle) => handle.key === key)!
      .move(draft, to);
    return draft;
  };

  it('are the middles of solids, the rims of spheres, and lamps', () => {
    expect(handles().map(({ key, at }) => [key, at])).toEqual([
      ['sphere[0]', [0, 0, 5]],
      ['sphere[0].radius', [0, 0, 4]],
      ['cylinder[0]', [0, 1, 0]],
      ['light[0].position', [1, 2, 3]],
    ]);
  });

  it('move what they belong to', () => {
    expect(after('sphere[0]', [1, 2, 5]).sphere![0]!.center).toEqual([1, 2, 5]);
    expect(after('sphere[0].radius', [0, 9, 2.5]).sphere![0]!.radius).toBe(2.5);
    expect(after('cylinder[0]', [1, 1.5, 0]).cylinder![0]).toMatchObject({ from: [1, 0.5, 0], to: [1, 2.5, 0] });
    expect(after('light[0].position', [4, 5, 6]).light![0]!.position).toEqual([4, 5, 6]);
  });
});

describe('probes on what is moved', () => {
  const scene: SceneSource = {
    version: 1,
    length: 'm',
    camera: {},
    sphere: [{ name: 'ball', center: [0, 0, 5], radius: 2 }],
    light: [{ name: 'lamp', position: [1, 2, 3], intensity: 1 }],
    probe: [{ at: [0, 0, 3] }, { at: [9, 9, 9] }],
  };
  const carried = (key: string, to: Vec3): Vec3[] => {
    const handle = pictureHandlesOf(scene, [1, 0, 0]).find((one) => one.key === key)!;
    const draft = structuredClone(scene);
    carrying(scene, ['ball', 'floor'], handle)(draft, to);
    return draft.probe!.map(({ at }) => at);
  };

  it('go along with it, and with its surface', () => {
    expect(carried('sphere[0]', [1, 0.5, 5])).toEqual([
      [1, 0.5, 3],
      [9, 9, 9],
    ]);
    expect(carried('sphere[0].radius', [1, 0, 5])).toEqual([
      [0, 0, 4],
      [9, 9, 9],
    ]);
    expect(carried('light[0].position', [0, 0, 0])).toEqual(scene.probe!.map(({ at }) => at));
  });
});
