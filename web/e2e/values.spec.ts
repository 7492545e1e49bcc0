/** The numbers of the page are those of the command. */

import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Page } from '@playwright/test';
import { choose, command, expect, folder, open, picture, saved, test } from './page';

const PRESETS = ['lab', 'course-sphere', 'course-plane', 'two-lights', 'sun', 'room', 'photometric', 'course'];

interface Probes {
  probes: { name: string; point: number[]; channels: { brightness: { value: number }; irradiance: { value: number } } }[];
}

for (const preset of PRESETS) {
  test(`${preset}: picture, extremes and probes are those of the command`, async ({ page }) => {
    await open(page);
    await page.getByRole('combobox', { name: 'Examples' }).selectOption(preset);
    await picture(page);
    const scene = join(folder(), 'scene.toml');
    writeFileSync(scene, await saved(page, 'Scene (TOML)'));

    if (/^\[\[probe\]\]/m.test(readFileSync(scene, 'utf8'))) await compareProbes(page, scene);

    const png = await saved(page, 'Picture, 0–255 (PNG)');
    const out = join(folder(), 'picture.png');
    command('render', scene, '--json', '--quiet', '-o', out);
    const [found, expected] = [await levels(page, png), await levels(page, readFileSync(out))];
    expect(found.length).toBe(expected.length);
    // A value half way between two levels may be rounded either way: WebAssembly has no fused multiply-add.
    const differing = found.filter((level, index) => level !== expected[index]);
    expect(differing.length).toBeLessThanOrEqual(3);
    expect(found.every((level, index) => Math.abs(level - expected[index]!) <= 1)).toBe(true);
  });
}

/** Every value at the scene's probes is that of the command to 1e-12. */
async function compareProbes(page: Page, scene: string): Promise<void> {
  const told = JSON.parse(command('probe', scene, '--json', '--quiet')) as Probes;
  expect(told.probes.length).toBeGreaterThan(0);
  const rows = (await saved(page, 'Values at the probes (CSV)')).toString().trim().split('\n');
  const table = rows.filter((row) => !row.startsWith('#')).slice(1);
  expect(table.length).toBe(told.probes.length);
  table.forEach((row, index) => {
    const probe = told.probes[index]!;
    const [, , , , brightness, irradiance] = row.split(',').map(Number);
    near(brightness!, probe.channels.brightness.value, 1e-12);
    near(irradiance!, probe.channels.irradiance.value, 1e-12);
  });
}

function near(found: number, expected: number, relative: number) {
  expect(Math.abs(found - expected), `${found} ${expected}`).toBeLessThanOrEqual(relative * Math.abs(expected));
}

/** The grey levels of a picture. */
async function levels(page: Page, png: Buffer): Promise<number[]> {
  const text = await page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d')!;
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    let red = '';
    for (let at = 0; at < data.length; at += 4) red += String.fromCharCode(data[at]!);
    return btoa(red);
  }, png.toString('base64'));
  return [...Buffer.from(text, 'base64')];
}

test('each light alone is a small picture, and the examples say what they are', async ({ page }) => {
  await open(page);
  await expect(page.getByRole('combobox', { name: 'Examples' }).locator('option[value=sun]')).toHaveText(
    'A sphere in the sun — Parallel light',
  );
  await page.getByRole('combobox', { name: 'Examples' }).selectOption('two-lights');
  await picture(page);
  await page.getByRole('tab', { name: 'More' }).click();
  const lights = page.getByRole('region', { name: 'Each light alone' }).getByRole('button', { name: /, up to/ });
  await expect(lights).toHaveCount(2);
  await lights.first().click();
  await picture(page);
  await expect(lights.first()).toHaveAttribute('aria-pressed', 'true');
  const isPainted = await lights
    .first()
    .locator('canvas')
    .evaluate((canvas: HTMLCanvasElement) => {
      const { data } = canvas.getContext('2d')!.getImageData(0, 0, canvas.width, canvas.height);
      return data.some((part, index) => index % 4 < 3 && part > 0);
    });
  expect(isPainted).toBe(true);
});

test('as many pixels are lit as the command says', async ({ page }) => {
  await open(page);
  await expect(page.getByRole('tabpanel')).toContainText('Of them lit: 32059.');
});

test('a scene with colours is shown in them or by its luminance, and saved as it is shown', async ({ page }) => {
  await open(page);
  await choose(
    page,
    'color.toml',
    readFileSync('../scenes/color.toml', 'utf8').replace(/^tolerance = .*$/m, 'samples = 1'),
  );
  await picture(page);
  const colors = () =>
    page.locator('.plot canvas').evaluate((canvas: HTMLCanvasElement) => {
      const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', { willReadFrequently: true })!;
      copy.drawImage(canvas, 0, 0);
      const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let at = 0; at < data.length; at += 4) if (data[at]! > data[at + 1]! + 20) count += 1;
      return count;
    });
  expect(await colors()).toBe(0);
  await page.getByRole('combobox', { name: 'Colours' }).selectOption('as seen, in colour');
  await picture(page);
  await expect.poll(colors).toBeGreaterThan(1000);

  const scene = join(folder(), 'scene.toml');
  writeFileSync(scene, await saved(page, 'Scene (TOML)'));
  const out = join(folder(), 'picture.png');
  command('render', scene, '--channel', 'color', '--json', '--quiet', '-o', out);
  const [found, expected] = [
    await levels(page, await saved(page, 'Picture, 0–255 (PNG)')),
    await levels(page, readFileSync(out)),
  ];
  expect(found.length).toBe(expected.length);
  expect(found.every((level, index) => Math.abs(level - expected[index]!) <= 1)).toBe(true);

  await page.getByRole('combobox', { name: 'Colours' }).selectOption('viridis');
  await picture(page);
  expect((await saved(page, 'Figure with axes and isophotes (SVG)')).toString()).toContain('brightness');
});

test('a scene is opened together with the mesh that it names', async ({ page }) => {
  await open(page);
  const [chooser] = await Promise.all([
    page.waitForEvent('filechooser'),
    page.getByRole('button', { name: 'Open…' }).click(),
  ]);
  await chooser.setFiles(['../scenes/meshes/vase.obj', '../scenes/mesh.toml']);
  await expect(page.getByRole('status').getByText('stay in this page only')).toBeVisible();
  await picture(page);
  await expect(page.getByRole('region', { name: 'Fields' }).getByRole('button', { name: 'vase mesh' })).toBeVisible();
  const out = join(folder(), 'picture.png');
  command('render', '../scenes/mesh.toml', '--json', '--quiet', '-o', out);
  const [found, expected] = [
    await levels(page, await saved(page, 'Picture, 0–255 (PNG)')),
    await levels(page, readFileSync(out)),
  ];
  expect(found.length).toBe(expected.length);
  expect(found.every((level, index) => Math.abs(level - expected[index]!) <= 1)).toBe(true);

  // The mesh alone is no scene, and nothing is lost.
  const [again] = await Promise.all([
    page.waitForEvent('filechooser'),
    page.getByRole('button', { name: 'Open…' }).click(),
  ]);
  await again.setFiles(['../scenes/meshes/vase.obj', '../scenes/points/spiral.csv']);
  await expect(page.getByRole('status').getByText('There is no scene among these files')).toBeVisible();
  await page.getByRole('button', { name: 'Link', exact: true }).click();
  await expect(page.getByRole('status').getByText('stay in this page only')).toBeVisible();

  // The next visit is without the mesh, says so, and keeps the rest.
  await page.reload();
  await expect(page.getByRole('status').getByText('open the scene file together with them')).toBeVisible();
  await expect(page.getByRole('region', { name: 'Fields' }).getByRole('button', { name: 'table disk' })).toBeVisible();
});
