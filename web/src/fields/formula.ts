/** A formula as the core writes it, taken apart for typesetting: `k_d cosθ_o + k_s (N·H_j)^n`. */

export interface Part {
  text: string;
  at: 'line' | 'sub' | 'sup';
}

export function partsOf(formula: string): Part[] {
  const parts: Part[] = [];
  for (const [, before = '', mark, letters, bracketed] of formula.matchAll(
    /([^_^]*)(?:([_^])(?:(\p{L}+|\d+)|\(([^)]*)\))|$)/gu,
  )) {
    if (before !== '') parts.push({ text: before, at: 'line' });
    const raised = letters ?? bracketed;
    if (raised !== undefined) parts.push({ text: raised, at: mark === '_' ? 'sub' : 'sup' });
  }
  return parts;
}
