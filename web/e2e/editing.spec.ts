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
  const lamp = page.getByRole('group', { name: 'The scene from above' }).getByRole('slider', { name: 'light aside' });
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

test('shapes and lamps are moved on the picture: by drags, which are a step of undo each, and by keys', async ({
  page,
}) => {
  await open(page);
  const position = (name: string) => page.getByRole('slider', { name: `${name}, on the picture`, exact: true });
  const sphere = async () => {
    await picture(page);
    return ((await scene(page)) as unknown as { sphere: { center: number[]; radius: number }[] }).sphere[0]!;
  };
  const pull = async (name: string, right: number, down: number) => {
    const box = (await position(name).boundingBox())!;
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + right, y + down, { steps: 5 });
    await page.mouse.up();
  };
  // A unit of length in pixels, in the plane through the centre: that of the screen, as both are 5 m away.
  const plot = (await page.getByRole('application', { name: /Map of values/ }).boundingBox())!;
  const metre = plot.width / 8;

  await pull('ball', 0.5 * metre, -0.25 * metre);
  const moved = await sphere();
  expect(moved.center[0]).toBeCloseTo(0.5, 1);
  expect(moved.center[1]).toBeCloseTo(0.25, 1);
  expect(moved.center[2]).toBe(5);
  // The points on it went along, and the picture followed.
  await expect(page.getByRole('status').locator('.mistakes')).toHaveCount(0);
  await expect(page.getByRole('textbox', { name: 'x of P1' })).toHaveValue(`${moved.center[0]}`);
  // The numbers follow.
  await page.getByRole('region', { name: 'Fields' }).getByRole('button', { name: 'ball', exact: false }).first().waitFor();
  await expect(page.getByRole('group', { name: 'Centre, m' }).getByRole('textbox').first()).toHaveValue(
    `${moved.center[0]}`,
  );

  await pull('radius of ball', 0.5 * metre, 0);
  expect((await sphere()).radius).toBeCloseTo(1.5, 1);

  await position('ball').focus();
  await page.keyboard.press('ArrowLeft');
  const stepped = await sphere();
  expect(stepped.center[0]).toBeLessThan(moved.center[0]!);
  expect(stepped.center[1]).toBe(moved.center[1]);

  const undo = page.getByRole('button', { name: 'Undo' });
  await undo.click();
  expect((await sphere()).center).toEqual(moved.center);
  await undo.click();
  expect((await sphere()).radius).toBe(1);
  await undo.click();
  expect((await sphere()).center).toEqual([0, 0, 5]);
  await expect(undo).toBeDisabled();

  await page.getByRole('combobox', { name: 'Examples' }).selectOption('course-plane');
  await picture(page);
  const lamp = (await scene(page)).light[0]!.position;
  await pull('light lamp', 30, 0);
  await picture(page);
  const dragged = (await scene(page)).light[0]!.position;
  expect(dragged[0]).toBeGreaterThan(lamp[0]!);
  expect(dragged.slice(1)).toEqual(lamp.slice(1));
});
