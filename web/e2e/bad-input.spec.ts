/** What a person, a link or a browser can do wrong: a sentence says it, and nothing is lost. */

import { deflateRawSync } from 'node:zlib';
import { test as plain } from '@playwright/test';
import { crc32 } from '../src/scene/url';
import { choose, command, expect, open, picture, saved, test } from './page';

const LAMPS = 99_000;

test('a scene of 99,000 lamps is opened, shown in part, and edited', async ({ page }) => {
  test.slow();
  const lamp = (index: number) =>
    `[[light]]\nname = "l${index}"\nposition = [${Math.sin(index)}, ${Math.cos(index)}, -10]\nintensity = 0.001\n`;
  const lab = command('new', 'lab', '-o', '-').replace(/^resolution = .*$/m, 'resolution = [80, 60]');
  await open(page);
  await choose(page, 'lamps.toml', lab + Array.from({ length: LAMPS }, (_, index) => lamp(index)).join('\n'));
  const count = page.locator('summary').filter({ hasText: 'Lights' });
  await expect(count).toContainText(`${LAMPS + 1}`, { timeout: 60_000 });
  await picture(page);
  await expect(page.getByRole('button', { name: /Show 50 more of \d+ that are not shown/ })).toBeVisible();
  await expect(page.getByText(/\d+ more are not drawn/).first()).toBeVisible();
  // What is added is open, though it is far beyond what is listed.
  await page.getByRole('button', { name: 'Add a light' }).click();
  await expect(count).toContainText(`${LAMPS + 2}`);
  await expect(page.getByRole('group', { name: 'lamp 2' })).toBeVisible();
  for (const tab of ['Why', 'More', 'Values']) {
    await page.getByRole('tab', { name: tab }).click();
    if (tab === 'Why') {
      await page.getByRole('tabpanel').getByRole('combobox').selectOption('P1');
      await expect(page.getByText(/\d+ more steps, of lights that count all the same/)).toBeVisible({ timeout: 30_000 });
    }
    await picture(page);
    expect(await page.locator('*').count()).toBeLessThan(6000);
  }
  await page.getByRole('button', { name: 'Undo' }).click();
  await expect(count).toContainText(`${LAMPS + 1}`);
});

test('a full storage is told, and the scene goes on', async ({ page }) => {
  await page.addInitScript(() => {
    Storage.prototype.setItem = () => {
      throw new DOMException('full', 'QuotaExceededError');
    };
  });
  await open(page);
  await expect(page.getByRole('status').getByText('The browser has no room to keep the scene')).toBeVisible();
  await page.getByRole('button', { name: 'Add a light' }).click();
  await picture(page);
  expect((await saved(page, 'Scene (TOML)')).toString().match(/^\[\[light\]\]$/gm)).toHaveLength(2);
});

/** A link that holds any text, with a correct sum. */
function linkOf(text: string): string {
  const bytes = new TextEncoder().encode(text);
  const data = deflateRawSync(bytes).toString('base64url');
  return `#s1.${data}.${crc32(bytes).toString(16).padStart(8, '0')}`;
}

for (const [what, text] of [
  ['no scene', '{}'],
  ['a list', '[1, 2]'],
  ['no JSON', 'version = 1'],
  ['a list where a table belongs', '{"version": 1, "length": "m", "camera": [], "light": {}}'],
  ['a text where a number belongs', '{"version": 1, "length": "m", "camera": {"eye": "there"}, "sphere": "one"}'],
  ['an infinite number', '{"version": 1, "length": "m", "camera": {"eye": [1e999, 0, 0]}, "sphere": [{"radius": -1e999}]}'],
  ['a resolution of any size', '{"version": 1, "length": "m", "camera": {"resolution": [4294967295, 4294967295]}}'],
  ['a depth of brackets', `${'['.repeat(100_000)}${']'.repeat(100_000)}`],
]) {
  test(`a forged link of ${what} is told, and the page works on`, async ({ page }) => {
    await open(page, linkOf(text!));
    await expect(page.getByRole('status').locator('.notice').first()).toBeVisible();
    await page.getByRole('combobox', { name: 'Examples' }).selectOption('two-lights');
    await picture(page);
    await expect(page.getByRole('status').locator('.mistakes')).toHaveCount(0);
    await expect(page.getByRole('img', { name: /Maximum/ })).toBeVisible();
  });
}

test('a number like 1e999 in a file is told with its place', async ({ page }) => {
  await open(page);
  const lab = command('new', 'lab', '-o', '-');
  await choose(page, 'huge.toml', lab.replace(/^radius = 1\b/m, 'radius = 1e999'));
  await expect(page.getByRole('status').getByText('The file was opened with problems')).toContainText('radius');
  await expect(page.getByRole('img', { name: /Maximum/ })).toBeVisible();
});

test('a file of more than 64 MiB is refused at once', async ({ page }) => {
  await open(page);
  await page.locator('input[type=file]').evaluate((input: HTMLInputElement) => {
    const files = new DataTransfer();
    files.items.add(new File([new Uint8Array(65 << 20)], 'enormous.toml'));
    input.files = files.files;
    input.dispatchEvent(new Event('change', { bubbles: true }));
  });
  await expect(page.getByRole('status').getByText('larger than 64 MiB')).toBeVisible();
});

test('a file of 60 MiB that is no scene is refused', async ({ page }) => {
  await open(page);
  await page.locator('input[type=file]').evaluate((input: HTMLInputElement) => {
    const files = new DataTransfer();
    files.items.add(new File(['x'.repeat(60 << 20)], 'enormous.toml'));
    input.files = files.files;
    input.dispatchEvent(new Event('change', { bubbles: true }));
  });
  await expect(page.getByRole('status').getByText('This file holds no scene')).toBeVisible({ timeout: 30_000 });
});

plain('without WebAssembly the page says what it needs', async ({ page }) => {
  await page.addInitScript(() => Reflect.deleteProperty(globalThis, 'WebAssembly'));
  await page.goto('.');
  await expect(page.getByText('This browser cannot compute here')).toBeVisible();
});

test('lost workers are replaced, and the next change is computed', async ({ page }) => {
  await open(page);
  expect(page.workers().length).toBeGreaterThan(1);
  for (const worker of page.workers()) {
    await worker.evaluate(() => {
      setTimeout(() => {
        throw new Error('lost');
      });
    });
  }
  await page.getByRole('combobox', { name: 'Examples' }).selectOption('two-lights');
  await picture(page);
  await expect(page.getByRole('heading', { name: /The whole picture/ })).toBeVisible();
  await page.getByRole('button', { name: 'Add a light' }).click();
  await picture(page);
  expect((await saved(page, 'Picture, 0–255 (PNG)')).subarray(1, 4).toString()).toBe('PNG');
});
