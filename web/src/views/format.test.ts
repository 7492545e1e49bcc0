import { expect, it } from 'vitest';
import { unitName } from './format';

it('writes units in Russian, and leaves alone what is Russian already', () => {
  const units = { 'W/(m²·sr)': 'Вт/(м²·ср)', 'W/m²': 'Вт/м²', lx: 'лк', 'cd/m²': 'кд/м²', mm: 'мм', '°': '°', '1': '' };
  for (const [unit, russian] of Object.entries(units)) {
    expect(unitName(unit, 'ru')).toBe(russian);
    expect(unitName(russian, 'ru')).toBe(russian);
  }
  expect(unitName('W/m²', 'en')).toBe('W/m²');
});
