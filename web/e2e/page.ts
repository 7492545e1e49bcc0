/** What the tests of the page share. */

import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { expect, test as base, type Page } from '@playwright/test';

/** The command, from the build that the other tests use. */
export const ISOPHOTE = [process.env['ISOPHOTE'], '../target/debug/isophote'].find((path) => path && existsSync(path));

/** A page that says anything in its console, or throws, fails its test. */
export const test = base.extend({
  page: async ({ page }, use) => {
    const complaints: string[] = [];
    page.on('console', (message) => {
      if (['error', 'warning'].includes(message.type())) complaints.push(message.text());
    });
    page.on('pageerror', (error) => complaints.push(error.message));
    await use(page);
    expect(complaints).toEqual([]);
  },
});

export { expect };

/** Opens the page, with a fragment perhaps, and waits for its picture. */
export async function open(page: Page, address = ''): Promise<void> {
  await page.goto(address);
  await picture(page);
}

/** Waits until the picture of the present scene is there, with its extremes. */
export async function picture(page: Page): Promise<void> {
  await expect(page.locator('html[data-state="ready"]')).toBeAttached({ timeout: 30_000 });
}

/** Saves by an entry of the menu, and returns the file's bytes. */
export async function saved(page: Page, entry: string, save = 'Save'): Promise<Buffer> {
  await page.getByRole('button', { name: save, exact: true }).click();
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: entry }).click()]);
  return readFileSync(await download.path());
}

/** Opens a file with this content. */
export async function choose(page: Page, name: string, content: string, button = 'Open…'): Promise<void> {
  const [chooser] = await Promise.all([
    page.waitForEvent('filechooser'),
    page.getByRole('button', { name: button }).click(),
  ]);
  await chooser.setFiles({ name, mimeType: 'text/plain', buffer: Buffer.from(content) });
}

/** A folder of its own for a test's files. */
export function folder(): string {
  return mkdtempSync(join(tmpdir(), 'isophote-app-'));
}

/** What the command prints. */
export function command(...options: string[]): string {
  if (!ISOPHOTE) throw new Error('build the command first: cargo build');
  return execFileSync(ISOPHOTE, options, { encoding: 'utf8', maxBuffer: 1 << 28, stdio: ['ignore', 'pipe', 'pipe'] });
}
