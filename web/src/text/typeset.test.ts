import { describe, expect, it } from 'vitest';
import * as fieldWords from './fields';
import { typeset, type Part } from './typeset';

/** Parts as text: *variable*, **vector**, _{index}, ^{power}. */
function shown(parts: Part[]): string {
  const marks: Record<Part['style'], (text: string) => string> = {
    plain: (text) => text,
    number: (text) => text,
    variable: (text) => `*${text}*`,
    vector: (text) => `**${text}**`,
    sub: (text) => `_{${text}}`,
    sup: (text) => `^{${text}}`,
  };
  return parts.map(({ text, style }) => marks[style](text)).join('');
}

const formula = (line: string) => shown(typeset(line).parts);

describe('typeset', () => {
  it('sets functions upright and their angle with its index', () => {
    expect(formula('  cosθ_i = max(0, N·L) = max(0, -0.5) = 0')).toBe(
      'cos*\u2009θ*_{i} = max(0, **N**·**L**) = max(0, −0.5) = 0',
    );
  });

  it('sets powers and indices', () => {
    expect(formula('E   = v I cosθ_i / r²')).toBe('*E* = *v* *I* cos*\u2009θ*_{i} / *r*^{2}');
    expect(formula('B = Σ E_j (k_d + k_s (N·H_j)^n)')).toBe('*B* = Σ *E*_{j} (*k*_{d} + *k*_{s} (**N**·**H**_{j})^{n})');
    expect(formula('cosθ_h^n = 0.97^20 = 0.5')).toBe('cos*\u2009θ*_{h}^{n} = 0.97^{20} = 0.5');
    expect(formula('I   = I₀ x²(3 − 2x)')).toBe('*I* = *I*_{0} *x*^{2}(3 − 2*x*)');
    expect(formula('15.6843871414²')).toBe('15.6843871414^{2}');
    expect(formula('2^(−n/2)')).toBe('2^{−n/2}');
  });

  it('leaves units and words upright', () => {
    expect(formula('r   = ‖S − P‖ = 15.68 m')).toBe('*r* = ‖**S** − **P**‖ = 15.68 m');
    expect(formula('I   = 100 W/sr, isotropic')).toBe('*I* = 100 W/sr, isotropic');
    expect(formula('diffuse  = E k_d cosθ_o = 0.25 W/m²')).toBe('diffuse = *E* *k*_{d} cos*\u2009θ*_{o} = 0.25 W/m^{2}');
  });

  it('leaves names in quotes alone', () => {
    expect(formula('P on "E_1 r²"')).toBe('**P** on "E_1 r²"');
    expect(formula('на «лампа N»')).toBe('на «лампа N»');
  });

  it('splits off remarks and formula numbers', () => {
    const { parts, notes } = typeset('  P   = (0, 0, 4)   on "ball"');
    expect(shown(parts)).toBe('**P** = (0, 0, 4)');
    expect(notes.map(shown)).toEqual(['on "ball"']);
    expect(typeset('E = 1 W/m²   (3.1)').notes.map(shown)).toEqual(['(3.1)']);
  });

  it('writes powers of ten', () => {
    expect(formula('E = 1.2e-7 W/m²')).toBe('*E* = 1.2 · 10^{−7} W/m^{2}');
    expect(formula('E = -1,2e-7')).toBe('*E* = −1,2 · 10^{−7}');
  });

  it('leaves the words of a sentence alone', () => {
    expect(formula('The formula of the lab: k_d darkens, as cosθ_o does; c(n) too.')).toBe(
      'The formula of the lab: *k*_{d} darkens, as cos*\u2009θ*_{o} does; *c*(*n*) too.',
    );
    for (const fields of [fieldWords.en, fieldWords.ru]) {
      for (const sentence of Object.values(fields.conventions)) {
        const { parts, notes } = typeset(sentence);
        expect(notes).toEqual([]);
        const words = parts.map((part) => part.text).join('');
        expect(words.replace(/\u2009/g, '')).toBe(sentence.replace(/_/g, ''));
      }
    }
  });

  it('loses no text', () => {
    const line = 'specular = E k_s (N·H)^n = 0.36 × 0.3 × 0.57 = 0.0627 W/m²';
    const text = typeset(line)
      .parts.map((part) => part.text)
      .join('');
    expect(text).toBe('specular = E ks (N·H)n = 0.36 × 0.3 × 0.57 = 0.0627 W/m2');
  });
});
