/** A line of an explanation, such as "cosθ_i = max(0, N·L) = 0.89   (3.1)", as parts to be set like mathematics. */

export type Style = 'plain' | 'variable' | 'vector' | 'number' | 'sub' | 'sup';

export interface Part {
  text: string;
  style: Style;
}

export interface Line {
  /** The formula. */
  parts: Part[];
  /** What stands behind it: the formula's number, or a remark. */
  notes: Part[][];
}

const VECTORS = new Set(['P', 'C', 'N', 'O', 'V', 'L', 'H', 'S', 'A', 'D']);
const VARIABLES = new Set(['E', 'I', 'B', 'k', 'r', 'n', 'v', 'x', 'c', 'f', 'R', 'Φ']);
const FUNCTION = /^(cos|sin|tan|max|min|ln|log|exp)/;
const RAISED: Record<string, string> = { '²': '2', '³': '3', '⁻': '−', '¹': '1', ⁿ: 'n', '⁰': '0' };
const LOWERED: Record<string, string> = { '₀': '0', '₁': '1', '₂': '2' };

/** Quoted names, powers, indices, numbers, words and single signs, in this order. */
const TOKEN =
  /("[^"]*"|“[^”]*”|«[^»]*»)|\^(\([^()]*\)|[−-]?[\d.,]*\d|\p{L})|_(\p{L}+|\d+)|([⁻⁰¹²³ⁿ]+)|([₀₁₂]+)|(\d+(?:[.,]\d+)?(?:e[+-]?\d+)?)|(\p{L}+)|([\s\S])/gu;

export function typeset(line: string): Line {
  const [formula = '', ...notes] = line
    .trim()
    .replace(/\s+=/g, ' =')
    .split(/\s{3,}/);
  return { parts: partsOf(formula), notes: notes.map(partsOf) };
}

function partsOf(text: string): Part[] {
  const signed = text.replace(/(^|[\s(,=×^])-(?=[\d.(])/g, '$1−').replace(/\s{2,}/g, ' ');
  const parts: Part[] = [];
  let previous = '';
  for (const match of signed.matchAll(TOKEN)) {
    const [, quoted, power, index, raised, lowered, number, word, sign] = match;
    if (quoted !== undefined) push(parts, quoted, 'plain');
    else if (power !== undefined) push(parts, power.replace(/^\((.*)\)$/, '$1'), 'sup');
    else if (index !== undefined) push(parts, index, 'sub');
    else if (raised !== undefined) push(parts, translate(raised, RAISED), 'sup');
    else if (lowered !== undefined) push(parts, translate(lowered, LOWERED), 'sub');
    else if (number !== undefined) pushNumber(parts, number);
    else if (word !== undefined) pushWord(parts, word, previous);
    else push(parts, sign ?? '', 'plain');
    previous = match[0].trim() || previous;
  }
  return parts;
}

function pushNumber(parts: Part[], number: string): void {
  const [mantissa = '', exponent] = number.split('e');
  push(parts, mantissa, 'number');
  if (exponent !== undefined) {
    push(parts, ' · 10', 'number');
    push(parts, String(Number(exponent)).replace('-', '−'), 'sup');
  }
}

function pushWord(parts: Part[], word: string, previous: string): void {
  const [name] = FUNCTION.exec(word) ?? [];
  if (name !== undefined && word.length <= name.length + 1) {
    push(parts, name, 'plain');
    if (word.length > name.length) push(parts, `\u2009${word.slice(name.length)}`, 'variable');
    return;
  }
  // A letter behind a number or a fraction bar of units is a unit: "15.7 m", "W/m²".
  const isUnit = /[\d)]$/.test(previous) && word === 'm';
  if (isUnit || word.length > 1) push(parts, word, 'plain');
  else if (VECTORS.has(word)) push(parts, word, 'vector');
  else if (VARIABLES.has(word) || /\p{Script=Greek}/u.test(word)) push(parts, word, word === 'Σ' ? 'plain' : 'variable');
  else push(parts, word, 'plain');
}

/** Neighbours of one style are one part. */
function push(parts: Part[], text: string, style: Style): void {
  const last = parts.at(-1);
  if (last?.style === style && (style === 'plain' || style === 'number')) last.text += text;
  else parts.push({ text, style });
}

function translate(text: string, table: Record<string, string>): string {
  return [...text].map((character) => table[character] ?? character).join('');
}
