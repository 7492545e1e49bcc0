import { describe, expect, it } from 'vitest';
import type { Vec2 } from '../engine/types';
import { level, paint, palette, rangeOf, rangeProblem } from './paint';

const GRAY = palette(Uint8Array.from({ length: 768 }, (_, index) => Math.floor(index / 3)));

/** The grey levels that values become; null is a missed pixel. */
function grays(wanted: (number | null)[], range: Vec2, normalization: 'max' | 'minmax' | 'log' = 'max'): number[] {
  const values = Float64Array.from(wanted, (value) => value ?? 0);
  const shapes = Int32Array.from(wanted, (value) => (value === null ? -1 : 0));
  const out = new Uint32Array(wanted.length);
  paint({ values, shapes }, GRAY, range, normalization, out);
  return [...out].map((pixel) => pixel & 0xff);
}

describe('paint', () => {
  it('makes 0 black, the maximum white, and rounds halves up', () => {
    expect(grays([0, 0.5, 1, 0.25], [0, 1])).toEqual([0, 128, 255, 64]);
    expect(grays([127.49, 127.5], [0, 255])).toEqual([127, 128]);
  });

  it('clamps to a range', () => {
    expect(grays([-1, 5, 15, 25], [5, 15])).toEqual([0, 0, 255, 255]);
  });

  it('is black where there is no light', () => {
    expect(grays([0, 0], [0, 0])).toEqual([0, 0]);
  });

  it('spaces decades evenly in a logarithmic picture', () => {
    expect(grays([0, 0.01, 0.1, 1, 10], [0.01, 10], 'log')).toEqual([0, 0, 85, 170, 255]);
  });

  it('keeps missed pixels black in any colours', () => {
    const colors = palette(Uint8Array.from({ length: 768 }, () => 200));
    const out = new Uint32Array(2);
    paint({ values: Float64Array.of(0, 0), shapes: Int32Array.of(-1, 0) }, colors, [0, 1], 'max', out);
    expect([...out]).toEqual([0xff000000, 0xffc8c8c8]);
  });

  it('agrees with the level of a single value', () => {
    for (const normalization of ['max', 'log'] as const) {
      for (let value = 0; value <= 1; value += 0.013) {
        const [gray] = grays([value], [0.001, 0.9], normalization);
        expect(gray).toBe(Math.floor(level(value, [0.001, 0.9], normalization) * 255 + 0.5));
      }
    }
  });
});

describe('rangeOf', () => {
  const values = { values: Float64Array.of(0, 2, 8), shapes: Int32Array.of(-1, 0, 0) };

  it('follows the normalisation and leaves missed pixels out', () => {
    expect(rangeOf(values, { range: null, normalization: 'max' })).toEqual([0, 8]);
    expect(rangeOf(values, { range: null, normalization: 'minmax' })).toEqual([2, 8]);
    expect(rangeOf(values, { range: null, normalization: 'log' })).toEqual([0.008, 8]);
    expect(rangeOf(values, { range: [1, 4], normalization: 'max' })).toEqual([1, 4]);
  });

  it('is empty where nothing is seen', () => {
    const missed = { values: Float64Array.of(0), shapes: Int32Array.of(-1) };
    expect(rangeOf(missed, { range: null, normalization: 'minmax' })).toEqual([0, 0]);
  });
});

describe('rangeProblem', () => {
  it('refuses what the core refuses', () => {
    expect(rangeProblem([0, 1], 'max')).toBeNull();
    expect(rangeProblem([1, 1], 'max')).toBe('order');
    expect(rangeProblem([-Infinity, 1], 'max')).toBe('order');
    expect(rangeProblem([0, 1], 'log')).toBe('log');
  });
});
