/** The numbers of the page are those of the command. */

import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { command, expect, folder, open, picture, saved, test } from './page';

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

    const png = await saved(page, 'Picture, 0–255 (PNG)');
    const out = join(folder(), 'picture.png');
    const render = JSON.parse(command('render', scene, '--json', '--quiet', '-o', out)) as {
      max: { value: number } | null;
    };
    expect(render).toBeTruthy();
    expect(png.subarray(1, 4).toString()).toBe('PNG');
  });
}

function near(found: number, expected: number, relative: number) {
  expect(Math.abs(found - expected), `${found} ${expected}`).toBeLessThanOrEqual(relative * Math.abs(expected));
}
