import { describe, expect, it } from 'vitest';
import type { Vec2 } from '../engine/types';
import { moveEnd, moveLine, ownersOf, placeOf } from './lines';

const MAP = { window: { x: [-4, 4] as Vec2, y: [-3, 3] as Vec2 }, width: 400, height: 300, step: 2 as const };

describe('lines', () => {
  it('are where their row or column is', () => {
    expect(placeOf({ kind: 'row', row: 0 }, MAP)?.at).toBeCloseTo(2.995, 12);
    expect(placeOf({ kind: 'column', column: 799 }, MAP)?.at).toBeCloseTo(3.995, 12);
    expect(placeOf({ kind: 'through', shape: 'ball' }, MAP)).toBeNull();
  });

  it('go to the row or the column of a place, and stay on the map', () => {
    for (const row of [0, 17, 599]) {
      const { at } = placeOf({ kind: 'row', row }, MAP)!;
      expect(moveLine({ kind: 'row', row: 3 }, [0, at], MAP)).toEqual({ kind: 'row', row });
    }
    expect(moveLine({ kind: 'horizontal', y: 0 }, [0, 9], MAP)).toEqual({ kind: 'horizontal', y: 3 });
    expect(moveEnd({ kind: 'between', from: [0, 0], to: [1, 1] }, 'to', [-9, 2], MAP)).toEqual({
      kind: 'between',
      from: [0, 0],
      to: [-4, 2],
    });
  });

  it('through a centre have two sections', () => {
    expect(
      ownersOf([
        { kind: 'through', shape: 'a' },
        { kind: 'row', row: 1 },
      ]).map(({ kind }) => kind),
    ).toEqual(['through', 'through', 'row']);
  });
});
