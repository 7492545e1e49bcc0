/** Everything that a person reads, in two languages. Each part of the page has its own dictionary; TypeScript sees to it that both
 * languages have the same keys. */

import type { Language } from '../engine/types';
import * as app from './app';
import * as fields from './fields';
import * as views from './views';

const DICTIONARIES = {
  en: { app: app.en, fields: fields.en, views: views.en },
  ru: { app: app.ru, fields: fields.ru, views: views.ru },
};

export type Words = (typeof DICTIONARIES)['en'];

class Text {
  language = $state<Language>(preferred());

  /** The words of the language in use. */
  get words(): Words {
    return DICTIONARIES[this.language];
  }

  /** Changes the language, and remembers it where the browser lets us. */
  choose(language: Language): void {
    this.language = language;
    try {
      localStorage.setItem('isophote.language', language);
    } catch {
      // Then the browser's first language is used the next time.
    }
  }

  /** A number for people: 12 significant digits at most, in the language's notation. */
  number(value: number, digits = 6): string {
    return format(value, digits, this.language);
  }
}

/** The language chosen before, or the browser's first one that there is. */
function preferred(): Language {
  const languages = [stored(), ...(globalThis.navigator?.languages ?? [])];
  const known = languages
    .map((language) => language?.slice(0, 2))
    .find((language) => language === 'en' || language === 'ru');
  return (known as Language | undefined) ?? 'en';
}

function stored(): string | null {
  try {
    return localStorage.getItem('isophote.language');
  } catch {
    return null;
  }
}

/** A number with so many significant digits and no trailing zeros: 0.316677, 1.2e-7; with a comma in Russian, and a true minus. */
export function format(value: number, digits: number, language: Language): string {
  if (!Number.isFinite(value)) return '–';
  const magnitude = Math.abs(value);
  const plain =
    magnitude !== 0 && (magnitude < 1e-4 || magnitude >= 10 ** Math.max(digits, 6))
      ? value
          .toExponential(digits - 1)
          .replace(/\.?0+e/, 'e')
          .replace('e+', 'e')
      : String(Number(value.toPrecision(digits)));
  const signed = plain.replace(/-/g, '−');
  return language === 'ru' ? signed.replace('.', ',') : signed;
}

/** The number that a person typed, with a decimal point or comma, a true minus, or spaces between thousands; null if it is none. */
export function parseNumber(typed: string): number | null {
  const plain = typed
    .replace(/[\s\u00a0\u202f]/g, '')
    .replace(/−/g, '-')
    .replace(',', '.');
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain)) return null;
  return Number(plain);
}

/** A text with values in its {places}. */
export function fill(template: string, values: Record<string, string>): string {
  return template.replace(/\{(\w+)\}/g, (place, name: string) => values[name] ?? place);
}

/** What an error says. */
export function reasonOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

export const text = new Text();
