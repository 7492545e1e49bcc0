/** The commands and the Python code that give the numbers and files that the page shows. */

import type { PictureStyle, SectionRequest, Vec2 } from '../engine/types';
import type { SceneSource } from './model';

/** What the page shows of a scene. */
export interface Shown {
  scene: SceneSource;
  /** The scene as a file, and the name of that file. */
  toml: string;
  file: string;
  channel: string;
  style: PictureStyle;
  sections: readonly SectionRequest[];
  sectionChannels: readonly string[];
}

/** The command line, a command a line. */
export function commandsOf({ scene, file, channel, style, sections, sectionChannels }: Shown): string {
  const name = quoted(file);
  const one = channel === 'brightness' ? '' : ` --channel ${quoted(channel)}`;
  const picture = [
    ...(style.colormap === 'gray' ? [] : [`--colormap ${style.colormap}`]),
    ...(style.range ? [`--range=${style.range.join(',')}`] : []),
    ...(style.normalization === 'max' ? [] : [`--normalize ${style.normalization}`]),
  ];
  const figure = [
    `--colormap ${style.colormap}`,
    ...(style.range ? [`--range=${style.range.join(',')}`] : []),
    `--isophotes ${style.isophotes}`,
  ];
  const commands = [
    `isophote render ${name}${one} ${[...picture, '-o picture.png'].join(' ')}`,
    `isophote render ${name}${one} ${[...figure, '--figure figure.svg'].join(' ')}`,
  ];
  if (scene.probe?.length) commands.push(`isophote probe ${name} --explain`);
  if (sections.length > 0) {
    const channels = sectionChannels.map((each) => `--channel ${quoted(each)}`);
    commands.push(`isophote section ${name} ${[...sections.map(lineOption), ...channels, '-o section.csv'].join(' ')}`);
  }
  if (scene.grid?.length) commands.push(`isophote grid ${name}`);
  return `${commands.join('\n')}\n`;
}

function lineOption(line: SectionRequest): string {
  switch (line.kind) {
    case 'row':
      return `--row ${line.row}`;
    case 'column':
      return `--column ${line.column}`;
    case 'horizontal':
      return `--horizontal=${line.y}`;
    case 'vertical':
      return `--vertical=${line.x}`;
    case 'between':
      return `--line=${[...line.from, ...line.to].join(',')}`;
    case 'through':
      return `--through ${quoted(line.shape)}`;
  }
}

/** A word for a shell. */
function quoted(word: string): string {
  return /^[\w./:-]+$/.test(word) && !word.startsWith('-') ? word : `'${word.replace(/'/g, `'\\''`)}'`;
}

/** A Python program that holds the scene. */
export function pythonOf({ scene, toml, channel, style, sections, sectionChannels }: Shown): string {
  const text = (value: string): string => JSON.stringify(value);
  const pictureOptions = pictureOptionsOf(style);
  const lines = [
    'import isophote as iso',
    '',
    `scene = iso.Scene.from_toml("""\\`,
    toml.replace(/\\/g, '\\\\').replace(/"""/g, '\\"\\"\\"').replace(/\n*$/, ''),
    '""")',
    '',
    `m = iso.render(scene, channels=[${text(channel)}])`,
    `print(m.max(), m.min(), m.mean(), m.units[${text(channel)}])`,
    `m.save("picture.png"${pictureOptions})`,
    `ax = m.plot(isophotes=${style.isophotes}, cmap=${text(style.colormap)})`,
    'ax.figure.savefig("figure.svg")',
  ];
  if (scene.probe?.length) lines.push('', 'probes = iso.probe(scene)', 'print(probes)', 'print(probes.explain(0))');
  if (scene.area?.length) lines.push('', 'for name, area in iso.areas(scene).items():', '    print(name, area)');
  for (const line of sections) {
    for (const place of placesOf(line)) {
      const channels = sectionChannels.map((each) => text(each)).join(', ');
      lines.push('', `section = iso.section(scene, ${place})`, `section.plot(${channels})`);
    }
  }
  return `${lines.join('\n')}\n`;
}

function pictureOptionsOf({ colormap, range, normalization }: PictureStyle): string {
  const options = [
    ...(colormap === 'gray' ? [] : [`colormap=${JSON.stringify(colormap)}`]),
    ...(range ? [`range=(${range.join(', ')})`] : normalization === 'minmax' ? ['range=(m.min(), m.max())'] : []),
  ];
  return options.map((option) => `, ${option}`).join('');
}

function placesOf(line: SectionRequest): string[] {
  const point = ([x, y]: Vec2): string => `(${x}, ${y})`;
  switch (line.kind) {
    case 'row':
      return [`row=${line.row}`];
    case 'column':
      return [`column=${line.column}`];
    case 'horizontal':
      return [`y=${line.y}`];
    case 'vertical':
      return [`x=${line.x}`];
    case 'between':
      return [`between=[${point(line.from)}, ${point(line.to)}]`];
    case 'through': {
      const shape = JSON.stringify(line.shape);
      return [`through=${shape}`, `through=${shape}, vertical=True`];
    }
  }
}
