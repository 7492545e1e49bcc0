/** The page as a whole: languages, links, files, without a network, on a phone, for everybody. */

import { mkdirSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import AxeBuilder from '@axe-core/playwright';
import { unzipSync } from 'fflate';
import { command, expect, folder, open, picture, saved, test } from './page';

test('the language is the browser’s, can be changed, and is kept', async ({ page }) => {
  await open(page);
  await expect(page.getByRole('button', { name: 'Report' })).toBeVisible();
  await page.getByRole('button', { name: 'Русский' }).click();
  await expect(page.getByRole('button', { name: 'Отчёт' })).toBeVisible();
  await expect(page.locator('html')).toHaveAttribute('lang', 'ru');
  await page.reload();
  await picture(page);
  await expect(page.getByRole('button', { name: 'Отчёт' })).toBeVisible();
});

test.describe('in a Russian browser', () => {
  test.use({ locale: 'ru-RU' });
  test('the page is Russian', async ({ page }) => {
    await open(page);
    await expect(page.getByRole('button', { name: 'Сохранить', exact: true })).toBeVisible();
  });
});

test('a link holds the scene, and what is no link is said and loses nothing', async ({ page, browser }) => {
  await open(page);
  await page.getByRole('combobox', { name: 'Examples' }).selectOption('course-plane');
  await picture(page);
  await page.getByRole('button', { name: 'Link', exact: true }).click();
  await expect.poll(() => page.url()).toContain('#s1.');
  const link = page.url();
  const scene = (await saved(page, 'Scene (TOML)')).toString();

  const other = await (await browser.newContext({ acceptDownloads: true })).newPage();
  await open(other, link);
  expect((await saved(other, 'Scene (TOML)')).toString()).toBe(scene);
  await other.context().close();

  for (const broken of [link.slice(0, -30), link.replace('#s1.', '#s1.AAAA'), link.replace('#s1.', '#s9.')]) {
    await page.goto('about:blank');
    await open(page, broken);
    await expect(page.getByRole('status').getByText('The link does not hold a scene')).toBeVisible();
    expect((await saved(page, 'Scene (TOML)')).toString()).toBe(scene);
  }
});

test('the command opens the page with a scene', async ({ page }) => {
  const file = join(folder(), 'two-lights.toml');
  command('new', 'two-lights', '-o', file);
  await open(page, `./${command('app', file, '--link').trim()}`);
  const told = join(folder(), 'scene.toml');
  writeFileSync(told, await saved(page, 'Scene (TOML)'));
  // The lines of its warnings are those of another text.
  const checked = (path: string) => ({
    ...(JSON.parse(command('check', path, '--json', '--quiet')) as object),
    warnings: [],
  });
  expect(checked(told)).toEqual(checked(file));
});

test('files are opened, and bad ones are refused in words', async ({ page }) => {
  await open(page);
  const choose = async (name: string, content: string) => {
    const [chooser] = await Promise.all([
      page.waitForEvent('filechooser'),
      page.getByRole('button', { name: 'Open…' }).click(),
    ]);
    await chooser.setFiles({ name, mimeType: 'text/plain', buffer: Buffer.from(content) });
  };
  const before = (await saved(page, 'Scene (TOML)')).toString();
  await choose('nonsense.toml', 'this is = not [a scene');
  await expect(page.getByRole('status').getByText('This file holds no scene')).toBeVisible();
  expect((await saved(page, 'Scene (TOML)')).toString()).toBe(before);
  await choose('two-lights.toml', command('new', 'two-lights', '-o', '-'));
  await picture(page);
  expect((await saved(page, 'Scene (TOML)')).toString()).not.toBe(before);
  await page.getByRole('button', { name: 'Undo' }).click();
  expect((await saved(page, 'Scene (TOML)')).toString()).toBe(before);
});

test('the page works without a network after the first visit', async ({ page, context }) => {
  await open(page);
  await page.evaluate(async () => {
    await navigator.serviceWorker.ready;
    if (!navigator.serviceWorker.controller) {
      await new Promise((done) => navigator.serviceWorker.addEventListener('controllerchange', done));
    }
  });
  await context.setOffline(true);
  await page.reload();
  await picture(page);
  await context.setOffline(false);
});

test('the single file opens from a disk', async ({ page }) => {
  await page.goto(pathToFileURL(resolve('dist/isophote.html')).href);
  await picture(page);
  const png = await saved(page, 'Picture, 0–255 (PNG)');
  expect(png.subarray(1, 4).toString()).toBe('PNG');
});

test('reports hold the numbers of the scene', async ({ page }) => {
  await open(page);
  const report = async (kind: string) => {
    await page.getByRole('button', { name: 'Report' }).click();
    await page.getByLabel('Author').fill('A. Student');
    const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: kind }).click()]);
    return download;
  };
  const html = await (await report('Report to print (HTML)')).createReadStream();
  const text = Buffer.concat(await html.toArray()).toString();
  for (const part of ['A. Student', '0.316677298', '0.388475848', 'lab (3.3)', 'data:image/png;base64,'])
    expect(text).toContain(part);
  const docx = await (await report('Report (DOCX)')).createReadStream();
  const parts = unzipSync(new Uint8Array(Buffer.concat(await docx.toArray())));
  const body = new TextDecoder().decode(parts['word/document.xml']);
  for (const part of ['A. Student', '0.316677298', '0.388475848', 'lab (3.3)']) expect(body).toContain(part);
  expect(Object.keys(parts).filter((name) => name.startsWith('word/media/')).length).toBe(2);
});

for (const [width, height] of [
  [390, 844],
  [1366, 768],
] as const) {
  test.describe(`at ${width} × ${height}`, () => {
    test.use({ viewport: { width, height } });
    for (const tab of ['Values', 'Why', 'Sections', 'More']) {
      test(`axe finds nothing in ${tab}, and nothing is wider than the page`, async ({ page }) => {
        await open(page);
        await page.getByRole('tab', { name: tab }).click();
        await picture(page);
        const { violations } = await new AxeBuilder({ page }).analyze();
        expect(violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html).join(' ')}`)).toEqual([]);
        expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
      });
    }
  });
}

test('screenshots for the documentation', async ({ page }) => {
  test.skip(!process.env['ISOPHOTE_SCREENSHOTS'], 'made by make app-screenshots');
  const target = process.env['ISOPHOTE_SCREENSHOTS']!;
  mkdirSync(target, { recursive: true });
  await open(page);
  await page.getByRole('combobox', { name: 'Examples' }).selectOption('course-sphere');
  await picture(page);
  await page.screenshot({ path: join(target, 'app.png') });
  await page.getByRole('button', { name: 'Русский' }).click();
  await page.getByRole('tab', { name: 'Сечения' }).click();
  await picture(page);
  await page.screenshot({ path: join(target, 'app.ru.png') });
});
