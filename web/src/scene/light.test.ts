import { describe, expect, it } from 'vitest';
import { aimModeOf, directionOfLight, EMISSIONS, setAim, setEmission, setStrength, strengthOf } from './light';
import type { LightSource } from './model';
import { randomScene, SEEDS } from './random-scene';
import { anglesOf, directionOf, unit } from './vector';

/** The keys that docs/scene-file.md allows for each emission. */
const ALLOWED: Record<string, string[]> = {
  isotropic: ['position', 'intensity', 'power'],
  lambertian: ['position', 'intensity', 'power', 'axis', 'target', 'tilt', 'azimuth'],
  spot: ['position', 'intensity', 'power', 'axis', 'target', 'tilt', 'azimuth', 'inner_angle', 'outer_angle'],
  parallel: ['direction', 'tilt', 'azimuth', 'irradiance'],
};

function expectWhole(light: LightSource): void {
  const emission = light.emission ?? 'isotropic';
  const keys = Object.keys(light).filter((key) => !['name', 'on', 'emission', 'casts_shadows'].includes(key));
  expect(keys.filter((key) => !ALLOWED[emission]?.includes(key))).toEqual([]);
  if (emission === 'parallel') expect(light.irradiance).toBeDefined();
  else {
    expect(light.position).toHaveLength(3);
    expect([light.intensity, light.power].filter((value) => value !== undefined)).toHaveLength(1);
  }
  const aims = [light.axis, light.direction, light.target, light.tilt].filter((value) => value !== undefined);
  expect(aims).toHaveLength(emission === 'isotropic' ? 0 : 1);
  if (emission === 'spot') expect((light.outer_angle ?? 0) - (light.inner_angle ?? 0)).toBeGreaterThanOrEqual(0.5);
}

describe('the emission', () => {
  it('keeps the keys together, from any to any', () => {
    for (const seed of SEEDS) {
      for (const light of randomScene(seed).light ?? []) {
        for (const emission of [...EMISSIONS, ...EMISSIONS.toReversed()]) {
          setEmission(light, emission, [1, 2, 3], 5);
          expectWhole(light);
        }
      }
    }
  });

  it('stays as it is if nothing changes', () => {
    const light: LightSource = { position: [0, 0, 1], intensity: 3 };
    setEmission(light, 'isotropic', [0, 0, 0], 1);
    expect(light).toEqual({ position: [0, 0, 1], intensity: 3 });
  });
});

describe('the aim', () => {
  it('stays when it is written another way', () => {
    const light: LightSource = { emission: 'lambertian', position: [0, 0, 2], intensity: 1, target: [1, 1, 0] };
    const before = directionOfLight(light);
    for (const mode of ['angles', 'vector', 'target'] as const) {
      setAim(light, mode, [1, 1, 0]);
      expect(aimModeOf(light)).toBe(mode);
      directionOfLight(light).forEach((part, axis) => expect(part).toBeCloseTo(before[axis] as number, 5));
      expectWhole(light);
    }
    setAim(light, 'down', [0, 0, 0]);
    expect(light.tilt).toBe(0);
    expect(directionOfLight(light)).toEqual([0, 0, -1]);
  });

  it('has the angles of the course: from straight down, and from +x towards +y', () => {
    expect(directionOf(0, 30)).toEqual([0, 0, -1]);
    expect(directionOf(90, 0)).toEqual([1, 0, 0]);
    expect(directionOf(90, 90)).toEqual([0, 1, 0]);
    expect(anglesOf([1, 0, -1])).toEqual({ tilt: 45, azimuth: 0 });
    expect(anglesOf([0, 0, 5])).toEqual({ tilt: 180, azimuth: null });
    for (const [tilt, azimuth] of [
      [10, 20],
      [120, -150],
      [45, 15],
    ] as const) {
      expect(anglesOf(unit(directionOf(tilt, azimuth)) ?? [0, 0, 0])).toEqual({ tilt, azimuth });
    }
  });
});

describe('the strength', () => {
  it('is the same as intensity and as power', () => {
    const lambertian: LightSource = { emission: 'lambertian', position: [0, 0, 1], power: 600, tilt: 0 };
    setStrength(lambertian, 'intensity');
    expect(lambertian.intensity).toBeCloseTo(600 / Math.PI, 10);
    setStrength(lambertian, 'power');
    expect(lambertian.power).toBeCloseTo(600, 10);
    expect(strengthOf(lambertian)).toBe('power');
    const isotropic: LightSource = { position: [0, 0, 1], intensity: [1, 2, 3] };
    setStrength(isotropic, 'power');
    expect(isotropic.power).toEqual([4, 8, 12].map((factor) => expect.closeTo(factor * Math.PI, 10)));
    const spot: LightSource = {
      emission: 'spot',
      position: [0, 0, 1],
      intensity: 1,
      inner_angle: 60,
      outer_angle: 90,
      tilt: 0,
    };
    setStrength(spot, 'power');
    expect(spot.power).toBeCloseTo(1.5 * Math.PI, 10);
  });
});
