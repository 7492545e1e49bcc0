import { describe, expect, it } from 'vitest';
import { fit, MAX_ZOOM, pan, pixelAt, Projection, WHOLE, within, zoomAbout } from './scale';
import type { Vec2 } from '../engine/types';

const WINDOW: { x: Vec2; y: Vec2 } = { x: [-4, 4], y: [-3, 3] };
const BOX = { width: 800, height: 600 };

describe('fit', () => {
  it('takes all of the width or all of the height', () => {
    expect(fit(2, { width: 400, height: 400 })).toEqual({ width: 400, height: 200 });
    expect(fit(0.5, { width: 400, height: 400 })).toEqual({ width: 200, height: 400 });
  });
});

describe('Projection', () => {
  it('puts the corners of the window into those of the box', () => {
    const projection = new Projection(WINDOW, BOX);
    expect(projection.toBox([-4, 3])).toEqual([0, 0]);
    expect(projection.toBox([4, -3])).toEqual([800, 600]);
    expect(projection.seen).toEqual(WINDOW);
  });

  it('goes there and back in any view', () => {
    const projection = new Projection(WINDOW, BOX, within({ zoom: 7, middle: [0.3, 0.8] }));
    for (const point of [
      [-1.5, -1.2],
      [0, 0],
      [3.9, 2.1],
    ] as Vec2[]) {
      const [x, y] = projection.fromBox(projection.toBox(point));
      expect(x).toBeCloseTo(point[0], 12);
      expect(y).toBeCloseTo(point[1], 12);
    }
  });
});

describe('views', () => {
  it('zoom about a point that stays where it is', () => {
    const about: Vec2 = [0.25, 0.6];
    const pixel: Vec2 = [about[0] * BOX.width, about[1] * BOX.height];
    const before = new Projection(WINDOW, BOX, WHOLE).fromBox(pixel);
    const after = new Projection(WINDOW, BOX, zoomAbout(WHOLE, 3, about)).fromBox(pixel);
    expect(after[0]).toBeCloseTo(before[0], 12);
    expect(after[1]).toBeCloseTo(before[1], 12);
  });

  it('show nothing outside the window', () => {
    expect(pan(WHOLE, [0.5, 0.5])).toEqual(WHOLE);
    expect(pan({ zoom: 2, middle: [0.5, 0.5] }, [10, -10])).toEqual({ zoom: 2, middle: [0.25, 0.75] });
    expect(zoomAbout(WHOLE, 0.1, [0, 0])).toEqual(WHOLE);
    expect(zoomAbout(WHOLE, 1e9, [0.5, 0.5]).zoom).toBe(MAX_ZOOM);
  });
});

describe('pixelAt', () => {
  it('counts columns from the left and rows from the top', () => {
    expect(pixelAt(WINDOW, BOX, [-3.999, 2.999])).toEqual([0, 0]);
    expect(pixelAt(WINDOW, BOX, [0.001, -0.001])).toEqual([400, 300]);
  });

  it('is nothing outside', () => {
    expect(pixelAt(WINDOW, BOX, [4, 0])).toBeNull();
    expect(pixelAt(WINDOW, BOX, [0, 3.01])).toBeNull();
  });
});
