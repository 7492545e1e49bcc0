/** Random scenes for tests: every kind of item, names with all that a name may hold, numbers with all their digits. */

import type { Vec2, Vec3 } from '../engine/types';
import type { Amount, LightSource, SceneSource } from './model';

/** A sequence of numbers from 0 to 1 that a seed determines (mulberry32). */
export function randomNumbers(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

const NAMES = ['ball', 'шар 1', 'lamp "A"', 'a.b[0].c', "it's", '–', 'émail 😀', 'x'.repeat(40), 'ball.diffuse'];

export function randomScene(seed: number): SceneSource {
  const random = randomNumbers(seed);
  const pick = <T>(items: readonly T[]): T => items[Math.floor(random() * items.length)] as T;
  const maybe = (chance = 0.5): boolean => random() < chance;
  const number = (): number => (random() - 0.5) * 10 ** Math.floor(random() * 8 - 3);
  const point = (): Vec3 => [number(), number(), number()];
  const size = (): number => Math.abs(number()) + 1e-6;
  const edges = (): Vec2 => [-size(), size()];
  const amount = (most = 1): Amount => (maybe(0.8) ? random() * most : [random() * most, random() * most, random() * most]);
  const several = <T>(make: (index: number) => T, most = 3): T[] =>
    Array.from({ length: Math.floor(random() * most) }, (_, i) => make(i));
  const materials = Object.fromEntries(
    several(() => [pick(NAMES), { diffuse: amount(), specular: amount(), shininess: size() }] as const, 4),
  );
  const used = new Set<string>();
  const named = (): { name?: string; material?: string } => {
    const name = pick(NAMES);
    const material = pick([...Object.keys(materials), undefined]);
    const isFree = maybe(0.7) && !used.has(name);
    used.add(name);
    return { ...(isFree ? { name } : {}), ...(material === undefined ? {} : { material }) };
  };
  const light = (index: number): LightSource => {
    const emission = pick(['isotropic', 'lambertian', 'spot', 'parallel'] as const);
    const strength: LightSource = maybe() ? { intensity: amount(1000) } : { power: amount(1000) };
    const aim: LightSource = pick([
      { axis: point() },
      { target: point() },
      { tilt: 0 },
      { tilt: random() * 180, azimuth: number() },
    ]);
    const name = maybe() ? { name: `${pick(NAMES)} ${index}` } : {};
    const on = maybe(0.2) ? { on: false } : {};
    if (emission === 'parallel') return { ...name, ...on, emission, direction: point(), irradiance: amount(1000) };
    if (emission === 'isotropic')
      return { ...name, ...on, ...(maybe() ? { emission } : {}), position: point(), ...strength };
    const cones = emission === 'spot' ? { inner_angle: random() * 40, outer_angle: 41 + random() * 40 } : {};
    return { ...name, ...on, emission, position: point(), ...strength, ...aim, ...cones };
  };
  const rectangles = several(() => ({ ...named(), center: point(), normal: point(), width: size(), height: size() }));
  const area = rectangles.map((rectangle, index) => ({
    on: rectangle.name ?? `rectangle[${index}]`,
    center: rectangle.center,
    radius: size(),
  }));
  const scene: SceneSource = {
    version: 1,
    ...(maybe() ? { title: pick(NAMES) } : {}),
    length: pick(['mm', 'cm', 'm'] as const),
    ...(maybe() ? { convention: pick(['lab', 'course', 'radiance', 'irradiance'] as const) } : {}),
    ...(maybe() ? { shadows: maybe() } : {}),
    camera: {
      eye: point(),
      ...pick([{ target: point() }, { forward: point() }, { tilt: 0 }, { tilt: 30, azimuth: 45 }]),
      ...pick([
        { screen: { distance: size(), x: edges(), y: edges() } },
        { field_of_view: 1 + random() * 170 },
        { projection: 'orthographic' as const, window: { x: edges(), y: edges() } },
      ]),
      resolution: [1 + Math.floor(random() * 1000), 1 + Math.floor(random() * 1000)],
    },
    material: materials,
    sphere: several(() => ({ ...named(), center: point(), radius: size() })),
    box: several(() => ({
      ...named(),
      center: point(),
      size: [size(), size(), size()] as Vec3,
      rotation: { axis: point(), degrees: 30 },
    })),
    cone: several(() => ({ ...named(), base: point(), apex: point(), radius: size(), apex_radius: size() })),
    plane: several(() => ({ ...named(), point: point(), normal: point() })),
    rectangle: rectangles,
    light: several(light, 6),
    ...(maybe() ? { ambient: { radiance: amount(10) } } : {}),
    probe: several((index) => ({ name: `P${index}`, at: point() }), 5),
    area,
    grid: several(() => ({ center: point(), u: point(), v: point(), points: [3, 4] as Vec2 })),
  };
  return Object.fromEntries(Object.entries(scene).filter(([, value]) => !isEmpty(value))) as unknown as SceneSource;
}

function isEmpty(value: unknown): boolean {
  return Array.isArray(value) ? value.length === 0 : typeof value === 'object' && Object.keys(value as object).length === 0;
}

export const SEEDS = Array.from({ length: 200 }, (_, index) => index);
