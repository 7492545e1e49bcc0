/** The picture in words, for those who do not see it. */

import type { Analysis, Frame, Probed, SceneInfo, Vec2 } from '../engine/types';
import { text } from '../text/index.svelte';
import { channelName, placeIn, quantity, unitName } from './format';

export interface Shown {
  frame: Frame;
  analysis: Analysis | null;
  info: SceneInfo | null;
  probed: Probed[];
}

export function describe({ frame, analysis, info, probed }: Shown): string {
  const words = text.words.views.describe;
  const value = (number: number) => quantity(number, frame.unit);
  const { width, height } = frame;
  const head = words.channel(
    channelName(frame.channel, info),
    unitName(frame.unit),
    width * frame.step,
    height * frame.step,
  );
  if (!analysis) return head;
  const { max, min, mean, visible, pixels } = analysis.statistics;
  if (!max || !min || mean === null) return `${head} ${words.seesNothing}`;
  const at = (screen: Vec2) => placeIn(screen, frame.axes[0].unit, 4);
  const sentences = [head, words.visible(text.number((100 * visible) / pixels, 3))];
  if (max.value === min.value) {
    sentences.push(words.even, words.mean(value(mean)));
  } else {
    sentences.push(words.max(value(max.value), at(max.screen)), words.min(value(min.value), at(min.screen)));
    sentences.push(words.mean(value(mean)), brightest(frame, max.pixel, max.screen, info));
  }
  return [...sentences, ...probed.flatMap((each, index) => probe(each, index, info))].join(' ');
}

/** Where the brightest place is, from the middle of the shape that it is on. */
function brightest(frame: Frame, [column, row]: Vec2, screen: Vec2, info: SceneInfo | null): string {
  const words = text.words.views.describe;
  const index = frame.shapes[Math.floor(row / frame.step) * frame.width + Math.floor(column / frame.step)] ?? -1;
  const shape = frame.coordinates.startsWith('screen') ? info?.shapes[index] : undefined;
  if (shape?.onScreen && shape.bounds) return words.brightest(direction(shape.onScreen, screen, frame), shape.name);
  const { x, y } = frame.window;
  return words.brightestOfPicture(direction([(x[0] + x[1]) / 2, (y[0] + y[1]) / 2], screen, frame));
}

/** One of eight directions, or the middle where it is nearer than a hundredth of the picture. */
export function direction(from: Vec2, to: Vec2, { window }: Pick<Frame, 'window'>): string {
  const words = text.words.views.describe;
  const [right, up] = [to[0] - from[0], to[1] - from[1]];
  if (Math.hypot(right, up) < 0.01 * Math.abs(window.x[1] - window.x[0])) return words.middle;
  const octant = Math.round(Math.atan2(up, right) / (Math.PI / 4));
  return words.directions[(octant + 8) % 8] ?? words.middle;
}

function probe({ reading }: Probed, index: number, info: SceneInfo | null): string[] {
  const words = text.words.views.describe;
  if (!reading) return [words.probeOff(info?.probes[index] ?? `${index + 1}`)];
  const value = quantity(reading.brightness, info?.units.brightness ?? '');
  return [reading.seen ? words.probe(reading.name, value) : words.hiddenProbe(reading.name, value)];
}
