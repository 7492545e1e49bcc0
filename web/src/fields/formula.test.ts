import { describe, expect, it } from 'vitest';
import { partsOf } from './formula';

const html = (formula: string): string =>
  partsOf(formula)
    .map(({ text, at }) => (at === 'line' ? text : `<${at}>${text}</${at}>`))
    .join('');

describe('a formula', () => {
  it('has its indices and powers', () => {
    expect(html('B = Σ E_j (k_d cosθ_o + k_s (N·H_j)^n)')).toBe(
      'B = Σ E<sub>j</sub> (k<sub>d</sub> cosθ<sub>o</sub> + k<sub>s</sub> (N·H<sub>j</sub>)<sup>n</sup>)',
    );
    expect(html('B = Σ E_j')).toBe('B = Σ E<sub>j</sub>');
    expect(html('I_j/r_j²')).toBe('I<sub>j</sub>/r<sub>j</sub>²');
    expect(html('2^(−n/2)')).toBe('2<sup>−n/2</sup>');
    expect(html('')).toBe('');
  });
});
