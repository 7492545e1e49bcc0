/** Values, units, places and channels in the words of the page's language. */

import type { Axis, Language, SceneInfo } from '../engine/types';
import { text } from '../text/index.svelte';

const RUSSIAN: Record<string, string> = {
  W: 'Вт',
  sr: 'ср',
  lm: 'лм',
  lx: 'лк',
  cd: 'кд',
  m: 'м',
  cm: 'см',
  mm: 'мм',
};

/** A unit as the language writes it: "W/(m²·sr)" is "Вт/(м²·ср)" in Russian; "1" is no unit to be shown. */
export function unitName(unit: string, language: Language = text.language): string {
  if (unit === '1') return '';
  return language === 'ru' ? unit.replace(/[a-zA-Z]+/g, (word) => RUSSIAN[word] ?? word) : unit;
}

/** "0.316677 W/m²" */
export function quantity(value: number, unit: string, digits = 6): string {
  return withUnit(text.number(value, digits), unit);
}

function withUnit(number: string, unit: string): string {
  const name = unitName(unit);
  if (name === '') return number;
  return name === '°' ? `${number}°` : `${number}\u00a0${name}`;
}

/** "x, mm": the title of an axis or a column. */
export function titled(title: string, unit: string): string {
  const name = unitName(unit);
  return name === '' ? title : `${title}, ${name}`;
}

/** The title of a map's axis: "x, mm", "longitude, °". */
export function axisTitle({ name, unit }: Axis): string {
  const known: Record<string, string> = text.words.views.axes;
  return titled(known[name] ?? name, unit);
}

/** "(0, 0, 4)", with semicolons between decimal commas. */
export function place(coordinates: readonly number[], digits = 5): string {
  const separator = text.language === 'ru' ? '; ' : ', ';
  return `(${coordinates.map((coordinate) => text.number(coordinate, digits)).join(separator)})`;
}

/** "(0, 0, 4) m" */
export function placeIn(coordinates: readonly number[], unit: string, digits = 5): string {
  return withUnit(place(coordinates, digits), unit);
}

/** The name of a channel: of "light.lamp", "Irradiance from “lamp”". */
export function channelName(channel: string, info: SceneInfo | null): string {
  const words = text.words.views.channels;
  const irradiance = info?.units.irradiance === 'lx' ? words.illuminance : words.irradiance;
  const [, kind, light] = /^(light|brightness)\.(.*)$/s.exec(channel) ?? [];
  if (light !== undefined) return words.light(kind === 'light' ? irradiance : words.brightness, light);
  if (channel === 'irradiance') return irradiance;
  const known: Record<string, unknown> = words;
  const name = known[channel];
  return typeof name === 'string' ? name : channel;
}
