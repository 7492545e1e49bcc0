/** What the core says to a Russian page: mistakes, calculations, figures. */

import { choose, command, expect, open, picture, saved, test } from './page';

test.beforeEach(async ({ page }) => {
  await open(page);
  await page.getByRole('button', { name: 'Русский' }).click();
  await picture(page);
});

test('mistakes of a scene are Russian, and follow the language of the page', async ({ page }) => {
  const lab = command('new', 'lab', '-o', '-');
  const wrong = lab.replace(/^radius = 1\b/m, 'radius = -1').replace('material = "clay"', 'material = "chalk"');
  await choose(page, 'wrong.toml', wrong, 'Открыть…');
  const mistakes = page.getByRole('status').getByRole('listitem');
  await expect(mistakes).toHaveText([
    '`sphere[0].radius` равно -1; допустимо: больше 0 (от 1e-12 до 1e15 m)',
    'sphere[0].material: материала «chalk» нет; допустимо: clay',
  ]);
  await page.getByRole('button', { name: 'English' }).click();
  await expect(mistakes).toHaveText([
    '`sphere[0].radius` is -1; allowed: above 0 (1e-12 to 1e15 m)',
    'sphere[0].material: there is no material "chalk"; allowed: clay',
  ]);
});

test('a calculation is that of the command in Russian, with the units as the command writes them', async ({ page }) => {
  await page.getByRole('tab', { name: 'Почему' }).click();
  await page.getByRole('combobox', { name: 'Точка' }).selectOption('P1');
  const calculation = page.locator('.why');
  for (const text of ['Геометрия (2.2), длины в m', 'Источник 1 «lamp»', 'диффузная =', 'Сумма по источникам: 1', 'W/m2'])
    await expect(calculation).toContainText(text);
  await expect(calculation).not.toContainText('Вт');
  // The page's own numbers have Russian units.
  await page.getByRole('tab', { name: 'Значения' }).click();
  await expect(page.getByRole('tabpanel')).toContainText('Вт/м²');
  await page.getByRole('tab', { name: 'Почему' }).click();
  await page.getByRole('button', { name: 'English' }).click();
  await expect(calculation).toContainText('Sum over 1 light');
});

test('figures have Russian labels, and tables the same columns in every language', async ({ page }) => {
  const figure = (await saved(page, 'Рисунок с осями и изофотами (SVG)', 'Сохранить')).toString();
  for (const label of ['яркость, lab (3.3), W/m²', 'нет поверхности']) expect(figure).toContain(label);
  const russian = await saved(page, 'Значения в контрольных точках (CSV)', 'Сохранить');
  await page.getByRole('button', { name: 'English' }).click();
  await picture(page);
  expect(await saved(page, 'Values at the probes (CSV)')).toEqual(russian);
  expect((await saved(page, 'Figure with axes and isophotes (SVG)')).toString()).toContain('brightness, lab (3.3), W/m²');
});

test('what a file is refused for is Russian', async ({ page }) => {
  await page.getByRole('combobox', { name: 'Нормировка' }).selectOption('own');
  const black = page.getByRole('textbox', { name: 'Значение чёрного' });
  await black.fill('5');
  await black.press('Enter');
  const refused = async (entry: string) => {
    await page.getByRole('button', { name: 'Сохранить', exact: true }).click();
    await page.getByRole('button', { name: entry }).click();
    return page.getByRole('status').locator('.notice');
  };
  await expect(await refused('Рисунок с осями и изофотами (SVG)')).toContainText(
    'концы должны быть конечны, меньший — первым',
  );
  await expect(await refused('Картина, 0–255 (PNG)')).toContainText('чёрное должно быть меньше белого, оба конечны');
});
