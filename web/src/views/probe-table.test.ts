import { expect, it } from 'vitest';
import type { ProbeReading } from '../engine/types';
import { probesAsText } from './probe-table';

it('writes numbers as spreadsheets of the language read them', () => {
  const reading: ProbeReading = {
    name: 'P1',
    point: [0, -0.5, 4],
    normal: [0, 0, -1],
    shape: 'ball',
    screen: null,
    seen: true,
    unseenBecause: null,
    cosThetaO: 1,
    brightness: 0.25,
    irradiance: 1e-7,
    ambient: 0,
    diffuse: 0.25,
    specular: 0,
    lights: [],
  };
  const table = (language: 'en' | 'ru') =>
    probesAsText(['name'], [{ reading, error: null }], ['brightness', 'irradiance'], language);
  expect(table('en')).toBe('name\nP1\t0\t-0.5\t4\t0.25\t1e-7');
  expect(table('ru')).toBe('name\nP1\t0\t-0,5\t4\t0,25\t1e-7');
});
