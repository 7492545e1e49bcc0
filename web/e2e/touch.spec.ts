/** The wheel and fingers: the page scrolls as any other, and what is under them is moved and zoomed. */

import { parse } from 'smol-toml';
import type { CDPSession, Page } from '@playwright/test';
import { expect, open, picture, saved, test } from './page';

const scrolled = (page: Page) => page.evaluate(() => window.scrollY);
const plot = (page: Page) => page.getByRole('application', { name: /Map of values/ });
/** How large the whole map is, in widths of what is seen of it. */
const zoom = (page: Page) =>
  plot(page).evaluate((element) => element.querySelector('canvas')!.clientWidth / element.clientWidth);

async function middleOf(page: Page, name: string | null = null): Promise<[number, number]> {
  const target = name === null ? plot(page) : page.getByRole('slider', { name, exact: true });
  const box = (await target.boundingBox())!;
  return [box.x + box.width / 2, box.y + box.height / 2];
}

test.describe('the wheel', () => {
  // Narrow, so that the page scrolls.
  test.use({ viewport: { width: 900, height: 700 } });

  test('scrolls the page over the picture, and zooms with Ctrl or after a click', async ({ page }) => {
    await open(page);
    await page.mouse.move(...(await middleOf(page)));
    await page.mouse.wheel(0, 120);
    await expect.poll(() => scrolled(page)).toBeGreaterThan(0);
    expect(await zoom(page)).toBeCloseTo(1, 2);
    await expect(page.getByText('Ctrl and the wheel zoom; after a click here')).toBeVisible();

    await page.evaluate(() => window.scrollTo(0, 0));
    await page.mouse.move(...(await middleOf(page)));
    await page.keyboard.down('Control');
    await page.mouse.wheel(0, -200);
    await page.keyboard.up('Control');
    await expect.poll(() => zoom(page)).toBeGreaterThan(1.2);
    expect(await scrolled(page)).toBe(0);
    await expect(page.getByText('Ctrl and the wheel zoom; after a click here')).toHaveCount(0);

    const before = await zoom(page);
    const [x, y] = await middleOf(page);
    await page.mouse.click(x + 60, y + 60);
    await page.mouse.wheel(0, -200);
    await expect.poll(() => zoom(page)).toBeGreaterThan(1.2 * before);
    expect(await scrolled(page)).toBe(0);
  });
});

test.describe('fingers', () => {
  test.use({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });

  /** Fingers that are put down, moved in steps and lifted. */
  async function touch(session: CDPSession, from: [number, number][], to: [number, number][]): Promise<void> {
    const points = (share: number) =>
      from.map(([x, y], id) => ({
        id,
        x: x + share * (to[id]![0] - x),
        y: y + share * (to[id]![1] - y),
      }));
    await session.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: points(0) });
    for (let step = 1; step <= 8; step += 1) {
      await session.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: points(step / 8) });
    }
    await session.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  }

  test('one scrolls the page or drags a handle, two zoom the picture', async ({ page }) => {
    await open(page);
    const session = await page.context().newCDPSession(page);
    const center = async () => {
      const scene = parse((await saved(page, 'Scene (TOML)')).toString()) as unknown as { sphere: { center: number[] }[] };
      return scene.sphere[0]!.center;
    };

    // A handle follows one finger, up and down too, and the page stays.
    const [x, y] = await middleOf(page, 'ball, on the picture');
    await touch(session, [[x, y]], [[x + 20, y - 40]]);
    await picture(page);
    expect(await scrolled(page)).toBe(0);
    const moved = await center();
    expect(moved[0]).toBeGreaterThan(0.2);
    expect(moved[1]).toBeGreaterThan(0.4);
    expect(moved[2]).toBe(5);

    // Two fingers that part zoom, and the page stays as it is.
    const [u, v] = await middleOf(page);
    await touch(
      session,
      [
        [u - 20, v - 30],
        [u + 20, v + 30],
      ],
      [
        [u - 50, v - 75],
        [u + 50, v + 75],
      ],
    );
    await expect.poll(() => zoom(page)).toBeGreaterThan(1.5);
    expect(await scrolled(page)).toBe(0);
    expect(await page.evaluate(() => window.visualViewport!.scale)).toBe(1);
    await page.getByRole('button', { name: 'Whole picture' }).click();

    // Elsewhere on the picture one finger scrolls the page.
    const box = (await plot(page).boundingBox())!;
    await touch(session, [[box.x + 20, box.y + box.height - 20]], [[box.x + 20, box.y - 180]]);
    await expect.poll(() => scrolled(page)).toBeGreaterThan(50);
    expect(await center()).toEqual(moved);
  });
});
