import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { commandsOf, pythonOf, type Shown } from './code';
import { addArea, addGrid, addLight, addProbe, addShape } from './defaults';
import { MADE_SHAPES } from './edit';
import { PRESETS } from './presets';
import { randomScene, SEEDS } from './random-scene';
import { clamped, isIn, rangeAt } from './ranges';
import { SceneKeeper } from './storage';
import { canConvert, convertLengths } from './units';

describe('another unit', () => {
  it('and back is the same scene', () => {
    const close = (value: unknown): unknown => {
      if (typeof value === 'number')
        return expect.closeTo(value, value === 0 ? 15 : 12 - Math.ceil(Math.log10(Math.abs(value))));
      if (Array.isArray(value)) return value.map(close);
      if (typeof value !== 'object' || value === null) return value;
      return Object.fromEntries(Object.entries(value).map(([key, inner]) => [key, close(inner)]));
    };
    for (const seed of SEEDS) {
      const before = randomScene(seed);
      const it = structuredClone(before);
      for (const unit of ['mm', 'm', 'cm', before.length] as const) convertLengths(it, unit);
      expect(it).toEqual(close(before));
    }
  });

  it('scales lengths and nothing else', () => {
    const scene = randomScene(0);
    const it = {
      ...scene,
      length: 'm' as const,
      light: [
        {
          emission: 'lambertian' as const,
          position: [1, 2, 3] as [number, number, number],
          axis: [0, 0, -1] as [number, number, number],
          intensity: 5,
        },
      ],
      camera: {
        eye: [0, 0, 0.3] as [number, number, number],
        forward: [0, 0, 1] as [number, number, number],
        field_of_view: 40,
      },
      area: [{ at: [0.1, 0.2] as [number, number], radius: 0.1 }],
    };
    convertLengths(it, 'mm' as 'm');
    expect(it.light[0]).toEqual({ emission: 'lambertian', position: [1000, 2000, 3000], axis: [0, 0, -1], intensity: 5 });
    expect(it.camera).toEqual({ eye: [0, 0, 300], forward: [0, 0, 1], field_of_view: 40 });
    // The window of a field of view is at the distance of one unit, whichever it is.
    expect(it.area).toEqual([{ at: [0.1, 0.2], radius: 0.1 }]);
    expect(canConvert({ ...it, spheres: [{ file: 'points.csv' }] })).toBe(false);
  });
});

describe('ranges', () => {
  const scene = { ...randomScene(0), length: 'mm' as const, convention: 'course-pi' as const };

  it('are those of the core', () => {
    expect(rangeAt(scene, 'sphere[0].radius', false)).toEqual({ min: 1e-9, max: 1e18, above: false });
    expect(rangeAt({ ...scene, material: { 'a.b': {} } }, 'material.a.b.diffuse', false)).toEqual({ min: 0, max: 1 });
    expect(rangeAt({ ...scene, convention: 'lab' }, 'material.x.diffuse', false)).toEqual({ min: 0, max: 1e6 });
    expect(isIn(rangeAt(scene, 'light[0].intensity', false), 0)).toBe(true);
    expect(isIn(rangeAt(scene, 'material.x.shininess', false), 0)).toBe(false);
    expect(isIn(rangeAt(scene, 'camera.resolution[0]', false), 1.5)).toBe(false);
  });

  it('are those of the course where they are wanted', () => {
    expect(rangeAt(scene, 'light[1].position[2]', true)).toEqual({ min: 100, max: 10000, course: true });
    expect(rangeAt({ ...scene, length: 'm' }, 'camera.width', true)).toEqual({ min: 0.1, max: 10, course: true });
    expect(isIn(rangeAt(scene, 'camera.resolution[1]', true), 801)).toBe(false);
    expect(isIn(rangeAt(scene, 'light[0].intensity', true), 0.001)).toBe(false);
  });

  it('hold what is dragged inside', () => {
    expect(clamped({ min: 0, max: 1 }, 2, 0.5)).toBe(1);
    expect(clamped({ min: 0, max: 1, above: true }, -1, 0.5)).toBe(0.5);
    expect(clamped({ min: 1, max: 9, whole: true }, 3.4, 3)).toBe(3);
  });
});

describe('what is added', () => {
  it('has finite numbers and a name of its own in any scene', () => {
    for (const seed of SEEDS.slice(0, 50)) {
      const it = randomScene(seed);
      for (const kind of MADE_SHAPES) {
        addShape(it, null, kind, kind);
        addShape(it, null, kind, kind);
      }
      for (const make of [addLight, addProbe, addArea, addGrid]) {
        make(it, null, 'new');
        make(it, null, 'new');
      }
      expect(JSON.stringify(it)).not.toMatch(/null|NaN|Infinity/);
      expect(it.light?.slice(-2).map(({ name }) => name)).toEqual(['new', 'new 2']);
      expect(it.light?.at(-1)?.position).not.toEqual(it.light?.at(-2)?.position);
    }
  });
});

describe('starters', () => {
  it('have names of their own', () => {
    expect(new Set(PRESETS.map(({ name }) => name)).size).toBe(PRESETS.length);
    for (const { scene } of PRESETS) expect(scene?.('A title')?.title ?? 'A title').toBe('A title');
  });
});

describe('code', () => {
  const shown: Shown = {
    scene: { ...randomScene(1), probe: [{ at: [0, 0, 0] }] },
    toml: 'version = 1\ntitle = """C:\\\\x"""\n',
    file: "it's.toml",
    channel: 'light.a lamp',
    style: { colormap: 'cividis', range: [-1, 2], normalization: 'minmax', isophotes: 4 },
    sections: [
      { kind: 'horizontal', y: -1 },
      { kind: 'between', from: [-1, 0], to: [1, 1e-7] },
      { kind: 'through', shape: 'the ball' },
    ],
    sectionChannels: ['brightness', 'diffuse'],
  };

  it('quotes what a shell would take apart', () => {
    const commands = commandsOf(shown);
    expect(commands).toContain(`isophote render 'it'\\''s.toml' --channel 'light.a lamp' --colormap cividis --range=-1,2`);
    expect(commands).toContain(
      `--horizontal=-1 --line=-1,0,1,1e-7 --through 'the ball' --channel brightness --channel diffuse -o section.csv`,
    );
  });

  it('keeps the text of the scene whole in Python', () => {
    const python = pythonOf(shown);
    expect(python).toContain('title = \\"\\"\\"C:\\\\\\\\x\\"\\"\\"');
    expect(python).toContain('iso.section(scene, between=[(-1, 0), (1, 1e-7)])');
    expect(python).toContain('through="the ball", vertical=True');
  });
});

describe('the last scene', () => {
  beforeEach(() => {
    vi.useFakeTimers();
    localStorage.clear();
  });
  afterEach(() => vi.useRealTimers());

  it('is kept a little later, once', () => {
    const set = vi.spyOn(Storage.prototype, 'setItem');
    const keeper = new SceneKeeper(() => undefined);
    SEEDS.slice(0, 9).forEach((seed) => keeper.keep(randomScene(seed)));
    expect(keeper.last()).toBeNull();
    vi.runAllTimers();
    expect(JSON.parse(keeper.last() ?? '')).toEqual(randomScene(8));
    expect(set).toHaveBeenCalledTimes(1);
    keeper.keep(randomScene(9));
    keeper.flush();
    expect(JSON.parse(keeper.last() ?? '')).toEqual(randomScene(9));
    keeper.forget();
    expect(keeper.last()).toBeNull();
    set.mockRestore();
  });

  it('that cannot be kept is told once, and again when it can', () => {
    const faults: unknown[] = [];
    let fails: DOMException | null = new DOMException('full', 'QuotaExceededError');
    const storage = {
      setItem: () => {
        if (fails) throw fails;
      },
    } as unknown as Storage;
    const keeper = new SceneKeeper((fault) => faults.push(fault), storage);
    for (const seed of [1, 2]) {
      keeper.keep(randomScene(seed));
      vi.runAllTimers();
    }
    fails = null;
    keeper.keep(randomScene(3));
    vi.runAllTimers();
    expect(faults).toEqual(['full', null]);
    const none = new SceneKeeper((fault) => faults.push(fault), null);
    none.keep(randomScene(1));
    none.flush();
    expect(faults.at(-1)).toBe('forbidden');
    expect(none.last()).toBeNull();
  });
});
