/** The page as a whole: languages, links, files, without a network, on a phone, for everybody. */

import { mkdirSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import AxeBuilder from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import { unzipSync } from 'fflate';
import { choose, command, expect, folder, open, picture, saved, test } from './page';

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
  const before = (await saved(page, 'Scene (TOML)')).toString();
  await choose(page, 'nonsense.toml', 'this is = not [a scene');
  await expect(page.getByRole('status').getByText('This file holds no scene')).toBeVisible();
  expect((await saved(page, 'Scene (TOML)')).toString()).toBe(before);
  await choose(page, 'two-lights.toml', command('new', 'two-lights', '-o', '-'));
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

/** What axe finds on the page as it is. */
async function violations(page: Page): Promise<string[]> {
  const { violations } = await new AxeBuilder({ page }).analyze();
  return violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html).join(' ')}`);
}

/** The page in both languages and both themes, with the names of what is clicked. */
const VERSIONS = [
  {
    locale: 'en-GB',
    colorScheme: 'light',
    tabs: ['Values', 'Why', 'Sections', 'More'],
    open: 'Open…',
    report: 'Report',
    warnings: 'Worth knowing',
    mistakes: 'This scene cannot be computed',
  },
  {
    locale: 'ru-RU',
    colorScheme: 'dark',
    tabs: ['Значения', 'Почему', 'Сечения', 'Ещё'],
    open: 'Открыть…',
    report: 'Отчёт',
    warnings: 'Полезно знать',
    mistakes: 'Такую сцену рассчитать нельзя',
  },
] as const;

for (const { locale, colorScheme, tabs, ...names } of VERSIONS) {
  for (const [width, height] of [
    [390, 844],
    [1366, 768],
  ] as const) {
    test.describe(`${locale}, ${colorScheme}, at ${width} × ${height}`, () => {
      test.use({ locale, colorScheme, viewport: { width, height } });
      test('axe finds nothing in any tab, and nothing is wider than the page', async ({ page }) => {
        await open(page);
        for (const [index, tab] of tabs.entries()) {
          await test.step(tab, async () => {
            await page.getByRole('tab', { name: tab }).click();
            if (index === 1) await page.getByRole('tabpanel').getByRole('combobox').selectOption('P1');
            if (index === 2) await page.getByRole('tabpanel').getByRole('button', { name: 'ball' }).first().click();
            await picture(page);
            expect(await violations(page)).toEqual([]);
            expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
          });
        }
      });

      test('axe finds nothing in warnings, in mistakes and in the form of a report', async ({ page }) => {
        const lab = command('new', 'lab', '-o', '-');
        await open(page);
        await choose(page, 'odd.toml', `${lab}\n[material.spare]\ndiffuse = 0.5\n`, names.open);
        await picture(page);
        await page.getByText(names.warnings).click();
        expect(await violations(page)).toEqual([]);
        await page.getByRole('button', { name: names.report, exact: true }).click();
        expect(await violations(page)).toEqual([]);
        await page.keyboard.press('Escape');
        await choose(page, 'wrong.toml', lab.replace(/^radius = 1\b/m, 'radius = -1'), names.open);
        await expect(page.getByRole('status').getByText(names.mistakes)).toBeVisible();
        expect(await violations(page)).toEqual([]);
        expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
      });
    });
  }
}

test('the theme can be chosen by hand', async ({ page }) => {
  await open(page);
  const theme = page.getByRole('combobox', { name: 'Theme' });
  const background = () => page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
  await theme.selectOption('dark');
  expect(await background()).toBe('rgb(20, 23, 26)');
  await theme.selectOption('light');
  expect(await background()).toBe('rgb(246, 247, 248)');
});

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
