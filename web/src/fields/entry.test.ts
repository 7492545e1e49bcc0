import { beforeEach, describe, expect, it } from 'vitest';
import { text } from '../text/index.svelte';
import { ANY, readEntry } from './entry';

describe('what is typed where a number is wanted', () => {
  beforeEach(() => text.choose('en'));

  it('is a number with a comma or a point', () => {
    expect(readEntry('1,5', ANY)).toEqual({ value: 1.5, fault: null });
    expect(readEntry(' −2.5e3', ANY)).toEqual({ value: -2500, fault: null });
  });

  it('is refused with what is allowed', () => {
    const fault = (typed: string, range = ANY) => readEntry(typed, range).fault;
    expect(fault('two')).toBe('Write a number, such as 1.5');
    expect(fault('1e999')).toBe('Allowed: any number');
    expect(fault('-3', { min: 0, max: 1 })).toBe('Allowed: 0 to 1');
    expect(fault('0', { min: 0, max: 5, above: true })).toBe('Allowed: above 0, up to 5');
    expect(fault('2.5', { min: 1, max: 9, whole: true })).toBe('Allowed: whole numbers, 1 to 9');
    expect(fault('900', { min: 200, max: 800, course: true })).toBe('Allowed in the course: 200 to 800');
  });
});
