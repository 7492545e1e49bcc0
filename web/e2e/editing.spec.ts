/** What a person does with hands and keys. */

import { parse } from 'smol-toml';
import { expect, open, picture, saved, test } from './page';

interface Written {
  light: { position: number[] }[];
  material: Record<string, { diffuse: number }>;
}

async function scene(page: Parameters<typeof saved>[0]): Promise<Written> {
  return parse((await saved(page, 'Scene (TOML)')).toString()) as unknown as Written;
}

test('a lamp is dragged on a plan, moved by keys, and put back by undo', async ({ page }) => {
  await open(page);
  await page.getByRole('combobox', { name: 'Examples' }).selectOption('course-sphere');
  await picture(page);
  const before = (await scene(page)).light[1]!.position;
  const lamp = page.getByRole('slider', { name: 'light aside' }).first();
  const box = (await lamp.locator('circle').first().boundingBox())!;
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 20, y + 5, { steps: 4 });
  await page.mouse.up();
  await picture(page);
  const dragged = (await scene(page)).light[1]!.position;
  expect(dragged).not.toEqual(before);
  // A plan from above leaves the height alone.
  expect(dragged[2]).toBe(before[2]);
  await lamp.focus();
  await page.keyboard.press('ArrowLeft');
  await picture(page);
  const moved = (await scene(page)).light[1]!.position;
  expect(moved).not.toEqual(dragged);
  // The key is a step, and the whole drag is another.
  await page.getByRole('button', { name: 'Undo' }).click();
  expect((await scene(page)).light[1]!.position).toEqual(dragged);
  await page.getByRole('button', { name: 'Undo' }).click();
  expect((await scene(page)).light[1]!.position).toEqual(before);
});

test('a wrong number is marked, a comma is as good as a point, and the last good picture stays', async ({ page }) => {
  await open(page);
  await page.getByText('Materials', { exact: true }).click();
  await page.getByText('clay', { exact: true }).last().click();
  const field = page.getByRole('textbox', { name: /k.?d|Diffuse/i }).first();
  await field.fill('0,25');
  await field.press('Enter');
  await picture(page);
  expect((await scene(page)).material['clay']!.diffuse).toBe(0.25);
  await field.fill('-3');
  await expect(field).toHaveAttribute('aria-invalid', 'true');
  expect((await scene(page)).material['clay']!.diffuse).toBe(0.25);
  await field.fill('1e999');
  await expect(field).toHaveAttribute('aria-invalid', 'true');
});

test('a coordinate of a point is stepped by keys and marked where it is wrong, as a field is', async ({ page }) => {
  await open(page);
  const x = page.getByRole('textbox', { name: 'x of P1' });
  await x.focus();
  await page.keyboard.press('ArrowUp');
  await expect(x).toHaveValue('0.01');
  await page.keyboard.press('ArrowDown');
  await x.fill('1e999');
  await expect(x).toHaveAttribute('aria-invalid', 'true');
  await expect(page.getByText('Allowed: −1e15 to 1e15')).toBeVisible();
  await page.keyboard.press('Escape');
  await expect(x).toHaveValue('0');
  await x.blur();
  // Every press of a key is a step of its own.
  for (const before of ['0.01', '0']) {
    await page.getByRole('button', { name: 'Undo' }).click();
    await expect(x).toHaveValue(before);
  }
});
