/** What a report says, as blocks: `html.ts` and `docx.ts` write them down. Everything comes from the scene and the core, but for what only
 * the author knows. */

import type { Engine, ExportRequest, SceneInfo, SectionRequest, Vec3 } from '../engine/types';
import type { SceneSource } from '../scene/model';
import { probesOf } from '../computing.svelte';
import { fill, format, type Words } from '../text/index.svelte';

export interface Author {
  title: string;
  author: string;
  group: string;
  teacher: string;
  institution: string;
  conclusion: string;
}

export type Block =
  | { kind: 'heading'; text: string }
  | { kind: 'paragraph'; text: string }
  | { kind: 'formula'; text: string }
  | { kind: 'table'; head: string[]; rows: string[][] }
  /** A PNG, with the size of its page in px. */
  | { kind: 'image'; png: Uint8Array; width: number; height: number; caption: string }
  | { kind: 'code'; text: string };

export interface Report {
  title: string;
  language: 'en' | 'ru';
  /** Lines under the title. */
  lines: string[];
  blocks: Block[];
}

export interface Asked {
  engine: Engine;
  scene: SceneSource;
  info: SceneInfo;
  author: Author;
  sections: SectionRequest[];
  isophotes: number;
  words: Words;
}

export async function makeReport({ engine, scene, info, author, sections, isophotes, words }: Asked): Promise<Report> {
  const language = engine.language;
  const w = words.app.reportWords;
  const f = words.app.reportFields;
  const number = (value: number, digits = 6) => format(value, digits, language);
  const point = ([x, y, z]: Vec3) => fill(w.at, { x: number(x), y: number(y), z: number(z), unit: info.length });
  const style = { colormap: 'gray', range: null, normalization: 'max', isophotes } as const;
  const unit = info.units.brightness;

  const { statistics } = await engine.analyse(scene, await engine.map(scene, 'brightness'), 0);
  const probed = await engine.probe(scene, probesOf(scene));
  const areas = scene.area?.length ? await engine.areas(scene) : [];

  const blocks: Block[] = [];
  const heading = (text: string) => blocks.push({ kind: 'heading', text });
  const paragraph = (text: string) => blocks.push({ kind: 'paragraph', text });
  const image = async (request: ExportRequest, caption: string) => {
    const png = await engine.export(scene, request);
    const size = pngSize(png);
    // Figures have two pixels for each px of their page.
    blocks.push({ kind: 'image', png, width: size[0] / 2, height: size[1] / 2, caption });
  };

  heading(w.task);
  paragraph(w.taskText);

  heading(w.parameters);
  blocks.push({ kind: 'table', head: [w.parameter, w.value], rows: parameters(scene, info, w, (value) => number(value)) });

  heading(w.formulas);
  paragraph(fill(w.formulaText, { label: info.convention.label }));
  blocks.push({ kind: 'formula', text: info.convention.formula });
  paragraph(w.irradianceText);
  blocks.push({ kind: 'formula', text: 'E_j = v_j I_j cosθ_i / r_j²   (3.1)' });

  heading(w.picture);
  await image({ kind: 'figure-png', channel: 'brightness', style, marks: true }, info.title);
  if (statistics.max && statistics.min) {
    const range = { min: number(statistics.min.value), max: number(statistics.max.value), unit };
    paragraph(fill(w.pictureText, range));
    heading(w.extremes);
    const rows = [
      [w.maximum, number(statistics.max.value, 9), statistics.max.point ? point(statistics.max.point) : ''],
      [w.minimum, number(statistics.min.value, 9), statistics.min.point ? point(statistics.min.point) : ''],
      [w.mean, number(statistics.mean ?? NaN, 9), ''],
    ];
    blocks.push({ kind: 'table', head: ['', fill(w.brightness, { unit }), ''], rows });
  }

  if (sections.length > 0) {
    heading(w.sections);
    await image({ kind: 'section-png', sections, channels: ['brightness'] }, '');
  }

  if (probed.length > 0) {
    heading(w.points);
    const head = [
      w.point,
      ...['x', 'y', 'z'].map((axis) => `${axis}, ${info.length}`),
      fill(w.brightness, { unit }),
      fill(w.irradiance, { unit: info.units.irradiance }),
      '',
    ];
    const rows = probed.map(({ reading, error }, index) => {
      const name = probesOf(scene)[index]!.name;
      if (!reading) return [name, '', '', '', '', '', error];
      const note = reading.seen ? '' : fill(w.unseen, { why: reading.unseenBecause ?? '' });
      const numbers = [...reading.point.map((coordinate) => number(coordinate)), number(reading.brightness, 9)];
      return [name, ...numbers, number(reading.irradiance, 9), note];
    });
    blocks.push({ kind: 'table', head, rows });
  }

  if (areas.length > 0) {
    heading(w.areas);
    const head = [w.area, w.maximum, w.mean, w.minimum].map((text, index) => (index === 0 ? text : `${text}, ${unit}`));
    const rows = areas.map((area) => [
      area.name,
      area.max ? `${number(area.max.value, 9)} ${point(area.max.point)}` : '–',
      area.mean === null ? '–' : number(area.mean, 9),
      area.min ? `${number(area.min.value, 9)} ${point(area.min.point)}` : '–',
    ]);
    blocks.push({ kind: 'table', head, rows });
  }

  if (author.conclusion.trim()) {
    heading(w.conclusions);
    for (const text of author.conclusion.split(/\n+/)) paragraph(text);
  }

  paragraph(fill(w.madeWith, { version: engine.version }));
  blocks.push({ kind: 'code', text: await engine.toToml(scene) });

  const named: [string, string][] = [
    [f.institution, author.institution],
    [f.author, author.author],
    [f.group, author.group],
    [f.teacher, author.teacher],
  ];
  const lines = named.filter(([, value]) => value.trim()).map(([label, value]) => `${label}: ${value}`);
  return { title: author.title.trim() || info.title || w.picture, language, lines, blocks };
}

function parameters(
  scene: SceneSource,
  info: SceneInfo,
  w: Words['app']['reportWords'],
  number: (value: number) => string,
): string[][] {
  const numbers = (values: number[], separator: string) => values.map((value) => number(value)).join(separator);
  const vector = (value: Vec3) => `(${numbers(value, '; ')})`;
  const { window, screenUnit, length } = info;
  const amount = (value: unknown) =>
    Array.isArray(value) ? `(${value.map((each) => number(each as number)).join('; ')})` : number(value as number);
  const rows: string[][] = [
    [w.convention, info.convention.label],
    [w.length, length],
    [w.camera, `O = ${vector(info.camera.eye)} ${length}`],
    [w.direction, vector(info.camera.forward)],
    [w.screen, `x: ${numbers(window.x, ' … ')} ${screenUnit}; y: ${numbers(window.y, ' … ')} ${screenUnit}`],
    [w.resolution, info.resolution.join(' × ')],
  ];
  for (const shape of info.shapes) {
    const [, kind, index] = /^(\w+)\[(\d+)\]$/.exec(shape.path) ?? [];
    const lists = scene as unknown as Record<string, Record<string, unknown>[] | undefined>;
    const written = kind === undefined ? undefined : lists[kind]?.[Number(index)];
    rows.push([`${w.shape} «${shape.name}»`, `${shape.kind}: ${described(written ?? {}, number)} ${length}`]);
  }
  for (const [name, material] of Object.entries(scene.material ?? {})) {
    const parts = [`k_d = ${amount(material.diffuse ?? 0)}`];
    if (material.specular !== undefined) parts.push(`k_s = ${amount(material.specular)}`);
    if (material.shininess !== undefined) parts.push(`n = ${number(material.shininess)}`);
    rows.push([`${w.material} «${name}»`, parts.join(', ')]);
  }
  info.lights.forEach((light, index) => {
    const written = scene.light?.[index];
    if (!written || !light.on) return;
    const strength =
      written.irradiance !== undefined
        ? `E₀ = ${amount(written.irradiance)} ${info.units.irradiance}`
        : written.power !== undefined
          ? `Φ = ${amount(written.power)} ${info.units.power}`
          : `I₀ = ${amount(written.intensity ?? 0)} ${info.units.intensity}`;
    const place = light.position ? `S = ${vector(light.position)} ${length}, ` : '';
    rows.push([`${w.light} «${light.name}»`, `${light.kind}: ${place}${strength}`]);
  });
  return rows;
}

/** The numbers of a shape by their keys. */
function described(shape: Record<string, unknown>, number: (value: number) => string): string {
  const parts: string[] = [];
  for (const [key, value] of Object.entries(shape)) {
    if (typeof value === 'number') parts.push(`${key} = ${number(value)}`);
    if (Array.isArray(value)) parts.push(`${key} = (${value.map((each) => number(each as number)).join('; ')})`);
  }
  return parts.join(', ');
}

/** Width and height, from a PNG's header. */
function pngSize(png: Uint8Array): [number, number] {
  const view = new DataView(png.buffer, png.byteOffset, png.byteLength);
  return [view.getUint32(16), view.getUint32(20)];
}
