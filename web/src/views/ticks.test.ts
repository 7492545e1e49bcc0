import { describe, expect, it } from 'vitest';
import { logTicks, niceTicks, tickDigits } from './ticks';

describe('niceTicks', () => {
  it('takes round numbers within the ends', () => {
    expect(niceTicks(-4, 4, 8)).toEqual([-4, -3, -2, -1, 0, 1, 2, 3, 4]);
    expect(niceTicks(0, 0.388475847845, 5)).toEqual([0, 0.1, 0.2, 0.3]);
    expect(niceTicks(13, 1040, 4)).toEqual([500, 1000]);
  });

  it('has no digits that arithmetic added', () => {
    expect(niceTicks(0, 0.7, 7)).toEqual([0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]);
    expect(niceTicks(0, 3e-12, 3)).toEqual([0, 1e-12, 2e-12, 3e-12]);
  });

  it('takes ends in either order', () => {
    expect(niceTicks(3, -3, 3)).toEqual(niceTicks(-3, 3, 3));
  });

  it('has nothing to say about no span', () => {
    expect(niceTicks(2, 2, 5)).toEqual([2]);
    expect(niceTicks(0, Infinity, 5)).toEqual([]);
    expect(niceTicks(NaN, 1, 5)).toEqual([]);
  });

  it('never gives many more than asked for', () => {
    for (let span = 1e-9; span < 1e9; span *= 3.7) {
      const ticks = niceTicks(0.3 * span, 1.3 * span, 6);
      expect(ticks.length).toBeGreaterThanOrEqual(2);
      expect(ticks.length).toBeLessThanOrEqual(7);
    }
  });
});

describe('logTicks', () => {
  it('takes powers of ten', () => {
    expect(logTicks(0.05, 500)).toEqual([0.1, 1, 10, 100]);
  });

  it('takes 2 and 5 too where there are few', () => {
    expect(logTicks(1, 10)).toEqual([1, 2, 5, 10]);
  });

  it('has none at or below 0', () => {
    expect(logTicks(0, 1)).toEqual([]);
  });
});

describe('tickDigits', () => {
  it('is enough to tell ticks apart', () => {
    expect(tickDigits([0, 0.1, 0.2])).toBe(1);
    expect(tickDigits([1000, 1005, 1010])).toBe(4);
    expect(tickDigits([0.998, 0.9985, 0.999])).toBe(4);
  });
});
