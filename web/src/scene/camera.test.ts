import { describe, expect, it } from 'vitest';
import * as camera from './camera';
import type { CameraSource } from './model';
import { randomNumbers } from './random-scene';

function lab(): CameraSource {
  return { eye: [0, 0, 0], forward: [0, 0, 1], screen: { distance: 5, x: [-4, 4], y: [-3, 3] }, resolution: [800, 600] };
}

describe('square pixels', () => {
  it('stay square, and what was typed stays as it was typed', () => {
    const random = randomNumbers(7);
    const it = lab();
    for (let step = 0; step < 500; step += 1) {
      const axis = random() < 0.5 ? 0 : 1;
      if (random() < 0.5) {
        const size = Number((1 + random() * 20).toFixed(1));
        camera.setWindowSize(it, axis, size, true);
        expect(camera.sizeOf([it.screen?.x, it.screen?.y][axis] as [number, number])).toBeCloseTo(size, 10);
      } else {
        const pixels = 200 + Math.floor(random() * 600);
        camera.setPixels(it, axis, pixels, true);
        expect(it.resolution?.[axis]).toBe(pixels);
      }
      expect(camera.hasSquarePixels(it)).toBe(true);
      expect(it.resolution?.every((count) => Number.isInteger(count) && count > 0)).toBe(true);
    }
  });

  it('change the resolution, not the window, where whole numbers fit', () => {
    const it = lab();
    camera.setWindowSize(it, 1, 8, true);
    expect(it.resolution).toEqual([800, 800]);
    expect(it.screen).toEqual({ distance: 5, x: [-4, 4], y: [-4, 4] });
    camera.setPixels(it, 0, 600, true);
    expect(it.resolution).toEqual([600, 600]);
    expect(it.screen).toEqual({ distance: 5, x: [-4, 4], y: [-4, 4] });
  });

  it('are left alone where they are not wanted', () => {
    const it = lab();
    camera.setWindowSize(it, 0, 10, false);
    expect(it.resolution).toEqual([800, 600]);
    expect(camera.hasSquarePixels(it)).toBe(false);
  });

  it('have steps that keep both numbers whole', () => {
    expect(camera.pixelStep({ resolution: [800, 600] }, 0)).toBe(12);
    expect(camera.pixelStep({ resolution: [600, 600] }, 0)).toBe(10);
    expect(camera.pixelStep({ resolution: [797, 600] }, 0)).toBe(1);
  });
});

describe('the framing', () => {
  it('shows the same by an angle as by a screen', () => {
    const it = lab();
    camera.setFraming(it, 'field_of_view', 5);
    expect(it.screen).toBeUndefined();
    expect(it.field_of_view).toBeCloseTo((2 * Math.atan(0.8) * 180) / Math.PI, 9);
    camera.setFraming(it, 'screen', 5);
    expect(it.field_of_view).toBeUndefined();
    [-4, 4].forEach((edge, side) => expect(it.screen?.x[side]).toBeCloseTo(edge, 8));
    [-3, 3].forEach((edge, side) => expect(it.screen?.y[side]).toBeCloseTo(edge, 8));
  });

  it('has the keys of its projection and no others', () => {
    const keys: Record<string, string> = { perspective: 'screen', orthographic: 'window', panorama: '' };
    const it = lab();
    for (const projection of [...camera.PROJECTIONS, ...camera.PROJECTIONS.toReversed()]) {
      camera.setProjection(it, projection, 5, 1);
      const own = Object.keys(it).filter((key) => ['screen', 'window', 'field_of_view'].includes(key));
      expect(own.join()).toBe(keys[projection] ?? 'field_of_view');
      expect(camera.hasSquarePixels(it)).toBe(true);
    }
  });
});

describe('the aim', () => {
  it('is the same however it is written', () => {
    const it: CameraSource = { eye: [0, 0, 5], target: [1, 2, 0], up: [0, 1, 0] };
    const before = camera.viewOf(it);
    for (const mode of ['angles', 'forward', 'target'] as const) {
      camera.setView(it, mode, [1, 2, 0]);
      expect(camera.viewModeOf(it)).toBe(mode);
      camera.viewOf(it).forEach((part, axis) => expect(part).toBeCloseTo(before[axis] as number, 5));
    }
    camera.setView(it, 'down', [0, 0, 0]);
    expect(camera.viewOf(it)).toEqual([0, 0, -1]);
  });

  it('drops an up that would lie along the view', () => {
    const it: CameraSource = { eye: [0, 0, 5], forward: [1, 0, 0], up: [0, 0, 1] };
    camera.setView(it, 'down', [0, 0, 0]);
    expect(it.up).toBeUndefined();
  });
});
