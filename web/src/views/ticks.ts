/** Round numbers on an axis. */

/** Values of the form {1, 2, 5}·10ᵏ apart, about so many, within the two ends. */
export function niceTicks(from: number, to: number, about: number): number[] {
  const low = Math.min(from, to);
  const high = Math.max(from, to);
  const span = high - low;
  if (!(span > 0) || !Number.isFinite(span) || about < 1) return low === high && Number.isFinite(low) ? [low] : [];
  const step = niceStep(span / about);
  // An end that is a tick but for rounding counts as one.
  const slack = 1e-9 * step;
  const first = Math.ceil((low - slack) / step);
  const last = Math.floor((high + slack) / step);
  return Array.from({ length: last - first + 1 }, (_, index) => roundTo((first + index) * step, step));
}

/** Powers of ten between two positive ends, with 2 and 5 between them where there are few. */
export function logTicks(low: number, high: number): number[] {
  if (!(low > 0 && high > low && Number.isFinite(high))) return [];
  const first = Math.floor(Math.log10(low));
  const last = Math.ceil(Math.log10(high));
  const mantissas = last - first <= 2 ? [1, 2, 5] : [1];
  const ticks: number[] = [];
  for (let exponent = first; exponent <= last; exponent += 1) {
    for (const mantissa of mantissas) ticks.push(Number(`${mantissa}e${exponent}`));
  }
  return ticks.filter((tick) => tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9));
}

/** The significant digits that tell ticks apart. */
export function tickDigits(ticks: readonly number[]): number {
  const [first, second] = ticks;
  if (first === undefined || second === undefined) return 4;
  const largest = Math.max(...ticks.map(Math.abs));
  return Math.min(12, Math.max(1, Math.floor(Math.log10(largest)) - Math.floor(Math.log10(Math.abs(second - first))) + 1));
}

/** The least of {1, 2, 5}·10ᵏ that is not below a number. */
function niceStep(atLeast: number): number {
  const power = 10 ** Math.floor(Math.log10(atLeast));
  const mantissa = [1, 2, 5].find((candidate) => candidate * power >= atLeast * (1 - 1e-9)) ?? 10;
  return mantissa * power;
}

/** A multiple of a step, without the digits that the multiplication added. */
function roundTo(value: number, step: number): number {
  const decimals = Math.max(0, Math.min(100, 1 - Math.floor(Math.log10(step))));
  return Number(value.toFixed(decimals)) + 0;
}
