/** How long the page takes: medians, printed. */

import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { test, type Page } from '@playwright/test';
import { initSync, Core } from '../src/engine/wasm/isophote_web.js';
import { open, picture } from '../e2e/page';

const median = (values: number[]) => values.toSorted((a, b) => a - b)[values.length >> 1]!;
const told = (what: string, value: number, unit: string) =>
  console.log(`${what.padEnd(64)} ${value.toFixed(1).padStart(8)} ${unit}`);

test('first visit', async ({ browser }) => {
  const folder = 'dist/site';
  const files = readdirSync(folder, { recursive: true, withFileTypes: true }).filter((file) => file.isFile());
  const packed = files.map((file) => ({
    name: file.name,
    bytes: gzipSync(readFileSync(join(file.parentPath, file.name)), { level: 9 }).length,
  }));
  // The library for DOCX is loaded when a report is made.
  const first = packed.filter(({ name }) => !name.startsWith('docx') && !name.startsWith('dist-'));
  told('over the wire, gzip -9', first.reduce((sum, { bytes }) => sum + bytes, 0) / 1e6, 'MB');
  const times: number[] = [];
  for (let visit = 0; visit < 7; visit += 1) {
    const context = await browser.newContext();
    const page = await context.newPage();
    const start = performance.now();
    await open(page);
    times.push(performance.now() - start);
    await context.close();
  }
  told('first visit to the first picture with its values, loopback', median(times), 'ms');
});

for (const lights of [1, 16]) {
  test(`${lights} lights`, async ({ page }) => {
    await open(page);
    const scene = JSON.parse(labAsJson());
    scene.light = Array.from({ length: lights }, (_, index) => ({
      ...scene.light[0],
      name: `lamp ${index}`,
      position: [5 - index * 0.6, 5, -10],
    }));
    await measure(page, scene, `lab, 800 × 600, ${lights} lights: change to picture`);
  });
}

/** Loads the scene by a file, then makes small changes, and reports the median from a change to its map. */
async function measure(page: Page, scene: { light: { intensity: number }[] }, what: string): Promise<void> {
  const times: number[] = [];
  for (let change = 0; change < 15; change += 1) {
    scene.light[0]!.intensity = 100 + change;
    const [chooser] = await Promise.all([
      page.waitForEvent('filechooser'),
      page.getByRole('button', { name: 'Open…' }).click(),
    ]);
    await page.evaluate(() => performance.clearMeasures());
    await chooser.setFiles({
      name: 'scene.json',
      mimeType: 'application/json',
      buffer: Buffer.from(JSON.stringify(scene)),
    });
    await page.waitForFunction(() => performance.getEntriesByType('measure').length > 0);
    await picture(page);
    times.push(await page.evaluate(() => performance.getEntriesByType('measure').at(-1)!.duration));
  }
  told(what, median(times.slice(3)), 'ms');
}

test('the kernel beside the native one', async () => {
  initSync({ module: readFileSync('src/engine/wasm/isophote_web_bg.wasm') });
  const core = new Core();
  core.load(labAsJson());
  const times: number[] = [];
  for (let run = 0; run < 60; run += 1) {
    const start = performance.now();
    const band = core.render('brightness', 0, 600, 1);
    times.push(performance.now() - start);
    band.free();
  }
  told('lab, 800 × 600, one worker, in Node', median(times.slice(20)), 'ms');
});

function labAsJson(): string {
  initSync({ module: readFileSync('src/engine/wasm/isophote_web_bg.wasm') });
  const core = new Core();
  return JSON.stringify(JSON.parse(core.read(core.starter('lab'), 'toml')).scene);
}
