/** Values become colours exactly as in the core's PNG: crates/isophote-export/src/png. */

import type { PictureStyle, Vec2 } from '../engine/types';

type Normalization = PictureStyle['normalization'];

/** White over black in a logarithmic picture without a range. */
const DECADES = 1000;

/** Opaque black in memory order red, green, blue, alpha on a little-endian processor, which WebAssembly requires anyway. */
const BLACK = 0xff000000;

export interface Values {
  values: Float64Array;
  /** −1 where nothing is seen. */
  shapes: Int32Array;
}

/** 256 opaque pixels of three bytes each. */
export function palette(bytes: Uint8Array): Uint32Array {
  return Uint32Array.from({ length: 256 }, (_, level) => {
    const [red = 0, green = 0, blue = 0] = bytes.subarray(3 * level, 3 * level + 3);
    return ((0xff << 24) | (blue << 16) | (green << 8) | red) >>> 0;
  });
}

/** The values of black and white. */
export function rangeOf({ values, shapes }: Values, style: Pick<PictureStyle, 'range' | 'normalization'>): Vec2 {
  if (style.range) return style.range;
  let smallest = Infinity;
  let largest = -Infinity;
  for (let index = 0; index < values.length; index += 1) {
    if (shapes[index]! < 0) continue;
    const value = values[index]!;
    if (value < smallest) smallest = value;
    if (value > largest) largest = value;
  }
  if (smallest > largest) return [0, 0];
  const white = Math.max(0, largest);
  if (style.normalization === 'max') return [0, white];
  return style.normalization === 'log' ? [white / DECADES, white] : [smallest, largest];
}

/** Why a range of one's own cannot be used: the core would refuse it too. */
export function rangeProblem([black, white]: Vec2, normalization: Normalization): 'order' | 'log' | null {
  if (!(black < white) || !Number.isFinite(white - black)) return 'order';
  return normalization === 'log' && black <= 0 ? 'log' : null;
}

/** The level of a value, from 0 (black) to 1; 0 in a map without light. */
export function level(value: number, [black, white]: Vec2, normalization: Normalization): number {
  if (!(black < white)) return 0;
  if (normalization !== 'log') return clamp((value - black) / (white - black));
  return value <= black ? 0 : clamp(Math.log(value / black) / Math.log(white / black));
}

/** Fills a picture of 32-bit pixels; missed pixels are black, even with a colour map. */
export function paint(
  { values, shapes }: Values,
  colors: Uint32Array,
  [black, white]: Vec2,
  normalization: Normalization,
  out: Uint32Array,
): void {
  const dark = !(black < white);
  const logarithmic = normalization === 'log';
  const span = logarithmic ? Math.log(white / black) : white - black;
  const darkest = colors[0]!;
  for (let index = 0; index < out.length; index += 1) {
    if (shapes[index]! < 0) {
      out[index] = BLACK;
      continue;
    }
    const value = values[index]!;
    if (dark || value <= black) {
      out[index] = darkest;
      continue;
    }
    const linear = (logarithmic ? Math.log(value / black) : value - black) / span;
    out[index] = colors[linear >= 1 ? 255 : Math.round(linear * 255)]!;
  }
}

function clamp(share: number): number {
  return Math.min(1, Math.max(0, share));
}
