import { describe, expect, it } from 'vitest';
import { cursorAfter, nearest, pathOf } from './plot';

const same = (value: number) => value;

describe('pathOf', () => {
  it('has gaps where there is no value', () => {
    expect(pathOf({ positions: [0, 1, 2, 3], values: [1, 2, null, 4] }, same, same)).toBe('M0.00 1.00L1.00 2.00M3.00 4.00');
  });
});

describe('nearest', () => {
  it('finds the position next to a place', () => {
    expect(nearest([0, 1, 2], 1.4)).toBe(1);
    expect(nearest([0, 1, 2], 99)).toBe(2);
    expect(nearest([], 1)).toBe(-1);
  });
});

describe('cursorAfter', () => {
  const key = (name: string, shiftKey = false) => ({ key: name, shiftKey });

  it('begins in the middle and stays on the plot', () => {
    expect(cursorAfter(key('ArrowRight'), null, { low: 0, high: 200 })).toBe(101);
    expect(cursorAfter(key('ArrowLeft', true), 4, { low: 0, high: 200 })).toBe(0);
    expect(cursorAfter(key('End'), 4, { low: 0, high: 200 })).toBe(200);
  });

  it('leaves other keys alone', () => {
    expect(cursorAfter(key('Escape'), 4, { low: 0, high: 200 })).toBeNull();
    expect(cursorAfter(key('Tab'), 4, { low: 0, high: 200 })).toBeUndefined();
  });
});
