import { describe, expect, it } from 'vitest';
import * as app from '../text/app';
import * as fields from '../text/fields';
import { format, parseNumber } from '../text/index.svelte';
import * as views from '../text/views';
import { randomNumbers } from './random-scene';

describe('numbers', () => {
  it('are read with a point or a comma', () => {
    for (const [typed, value] of [
      ['1.5', 1.5],
      ['1,5', 1.5],
      [' 1 000,25 ', 1000.25],
      ['−3', -3],
      ['+.5', 0.5],
      ['5.', 5],
      ['1e3', 1000],
      ['1,2E-3', 0.0012],
    ] as const) {
      expect(parseNumber(typed)).toBe(value);
    }
  });

  it('are refused where they are none', () => {
    for (const typed of ['', ' ', '-', '1..2', '1,2,3', '1.2.3', 'abc', '1e', '0x10', 'NaN', 'Infinity', '5 mm', '--1']) {
      expect(parseNumber(typed)).toBeNull();
    }
  });

  it('are read as they were shown, in both languages', () => {
    const random = randomNumbers(11);
    for (let tries = 0; tries < 500; tries += 1) {
      const value = (random() - 0.5) * 10 ** Math.floor(random() * 40 - 20);
      for (const language of ['en', 'ru'] as const) {
        expect(parseNumber(format(value, 12, language))).toBe(Number(value.toPrecision(12)));
      }
    }
  });

  it('have a comma in Russian and a true minus', () => {
    expect(format(-0.5, 6, 'ru')).toBe('−0,5');
    expect(format(-0.5, 6, 'en')).toBe('−0.5');
    expect(format(1234.5, 6, 'ru')).toBe('1234,5');
    expect(format(Number.NaN, 6, 'en')).toBe('–');
  });
});

/** The texts of a dictionary by the way to them. A function is called with something for each of its parameters. */
function texts(words: unknown, way = ''): Map<string, string> {
  if (typeof words === 'string') return new Map([[way, words]]);
  if (typeof words === 'function') {
    const say = words as (...given: unknown[]) => unknown;
    return texts(say(...Array.from({ length: say.length }, (_, index) => index + 1)), `${way}()`);
  }
  const entries = Object.entries(words as object);
  return new Map(entries.flatMap(([key, inner]) => [...texts(inner, `${way}.${key}`)]));
}

describe.each([
  ['app', app],
  ['fields', fields],
  ['views', views],
])('the words of %s', (_, dictionary) => {
  const shape = (words: Map<string, string>): string[] => [...words.keys()].sort();

  it('are the same keys in both languages', () => {
    expect(shape(texts(dictionary.ru))).toEqual(shape(texts(dictionary.en)));
  });

  it('are never empty', () => {
    for (const words of [dictionary.en, dictionary.ru]) {
      for (const [way, words_] of texts(words)) expect(words_.trim(), way).not.toBe('');
    }
  });
});
