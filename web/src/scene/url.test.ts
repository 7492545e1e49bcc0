import { deflateSync } from 'fflate';
import { describe, expect, it } from 'vitest';
import { randomNumbers, randomScene, SEEDS } from './random-scene';
import { crc32, isLink, jsonOfLink, linkOf, LinkError } from './url';

function fault(fragment: string): string | null {
  try {
    jsonOfLink(fragment);
    return null;
  } catch (error) {
    return (error as LinkError).fault;
  }
}

/** A link with this content, whatever it is. */
function forged(bytes: Uint8Array): string {
  const data = Buffer.from(deflateSync(bytes)).toString('base64url');
  return `#s1.${data}.${crc32(bytes).toString(16).padStart(8, '0')}`;
}

describe('a link', () => {
  it('holds any scene', () => {
    for (const seed of SEEDS) {
      const scene = randomScene(seed);
      const link = linkOf(scene);
      expect(link).toMatch(/^#s1\.[A-Za-z0-9_-]+\.[0-9a-f]{8}$/);
      expect(JSON.parse(jsonOfLink(link))).toEqual(scene);
    }
  });

  it('has the checksum that zlib has', () => {
    expect(crc32(new TextEncoder().encode('123456789'))).toBe(0xcbf43926);
  });

  it('is known by its beginning', () => {
    expect(isLink('#s1.x')).toBe(true);
    expect(isLink('#s2.x')).toBe(true);
    expect(isLink('#values')).toBe(false);
    expect(fault('')).toBe('none');
    expect(fault('#s2.AAAA.00000000')).toBe('version');
  });

  it('cut short says so or is refused', () => {
    const link = linkOf(randomScene(3));
    for (let end = 4; end < link.length; end += 1) expect(['short', 'damaged']).toContain(fault(link.slice(0, end)));
    expect(fault(link.slice(0, link.length - 3))).toBe('short');
    expect(fault(link.slice(0, 40))).toBe('short');
  });

  it('changed in any place is refused', () => {
    const link = linkOf(randomScene(5));
    const random = randomNumbers(1);
    for (let tries = 0; tries < 300; tries += 1) {
      const at = 4 + Math.floor(random() * (link.length - 4));
      const other = link[at] === 'A' ? 'B' : 'A';
      const changed = link.slice(0, at) + other + link.slice(at + 1);
      // The last character of base64 may have bits that stand for nothing.
      const same = Buffer.from(changed.split('.')[1] as string, 'base64url').equals(
        Buffer.from(link.split('.')[1] as string, 'base64url'),
      );
      if (!same || changed.split('.')[2] !== link.split('.')[2]) expect(fault(changed)).not.toBeNull();
    }
    expect(fault(`${link}00`)).toBe('damaged');
    expect(fault(link.replace('.', '.%'))).toBe('damaged');
  });

  it('that unpacks to too much is refused', () => {
    expect(fault(forged(new Uint8Array(32 << 20)))).toBe('large');
    expect(fault(forged(new Uint8Array(8 << 20)))).toBeNull();
    expect(fault(forged(new Uint8Array((8 << 20) + 1)))).toBe('large');
  }, 30_000);

  it('with text that is no UTF-8 is refused', () => {
    expect(fault(forged(Uint8Array.from([0x22, 0xff, 0x22])))).toBe('damaged');
  });
});
