/** What a lamp sends out and where it is aimed: changes that keep the keys of its emission together. */

import type { Vec3 } from '../engine/types';
import type { Amount, LightSource } from './model';
import { anglesOf, directionOf, scale, subtract, unit } from './vector';

export type Emission = NonNullable<LightSource['emission']>;
export const EMISSIONS: readonly Emission[] = ['isotropic', 'lambertian', 'spot', 'parallel'];

/** How the axis of a lamp, or the direction of parallel light, is written. */
export type AimMode = 'down' | 'target' | 'vector' | 'angles';
export type Strength = 'intensity' | 'power' | 'irradiance';

export function emissionOf(light: LightSource): Emission {
  return light.emission ?? 'isotropic';
}

export function aimModes(emission: Emission): readonly AimMode[] {
  if (emission === 'isotropic') return [];
  return emission === 'parallel' ? ['down', 'vector', 'angles'] : ['down', 'target', 'vector', 'angles'];
}

export function aimModeOf(light: LightSource): AimMode {
  if (light.target) return 'target';
  if (light.tilt !== undefined) return light.tilt === 0 && light.azimuth === undefined ? 'down' : 'angles';
  return 'vector';
}

/** Where the light goes; straight down if that is written nowhere. */
export function directionOfLight(light: LightSource): Vec3 {
  if (light.target && light.position) return unit(subtract(light.target, light.position)) ?? [0, 0, -1];
  if (light.tilt !== undefined) return directionOf(light.tilt, light.azimuth ?? 90);
  return light.axis ?? light.direction ?? [0, 0, -1];
}

/** Writes the aim another way. `at` is what a target is put at. */
export function setAim(light: LightSource, mode: AimMode, at: Vec3): void {
  const direction = directionOfLight(light);
  dropAim(light);
  if (mode === 'down') {
    light.tilt = 0;
  } else if (mode === 'angles') {
    const { tilt, azimuth } = anglesOf(direction);
    light.tilt = tilt;
    light.azimuth = azimuth ?? 0;
  } else if (mode === 'target') {
    light.target = at;
  } else {
    light[light.emission === 'parallel' ? 'direction' : 'axis'] = short(direction);
  }
}

/** A direction without the digits that only its unit length needs. */
function short(direction: Vec3): Vec3 {
  return direction.map((part) => Number(part.toPrecision(6))) as Vec3;
}

function dropAim(light: LightSource): void {
  for (const key of ['axis', 'direction', 'target', 'tilt', 'azimuth'] as const) delete light[key];
}

/** Changes the emission: drops the keys that mean nothing for the new one and writes those that it needs. `at` is a point worth
 * lighting, and `far` the distance at which a lamp is put that had no position. */
export function setEmission(light: LightSource, emission: Emission, at: Vec3, far: number): void {
  const before = emissionOf(light);
  if (emission === before) return;
  const direction = before === 'isotropic' ? null : directionOfLight(light);
  const mode = before === 'isotropic' ? null : aimModeOf(light);
  light.emission = emission;
  if (emission !== 'spot') {
    delete light.inner_angle;
    delete light.outer_angle;
  } else {
    light.inner_angle ??= 15;
    light.outer_angle ??= 25;
  }
  if (emission === 'parallel') {
    const towards = direction ?? unit(subtract(at, light.position ?? [0, 0, 0])) ?? [0, 0, -1];
    const byAngles = mode === 'angles' || mode === 'down';
    if (!byAngles) {
      dropAim(light);
      light.direction = short(towards);
    }
    delete light.position;
    delete light.intensity;
    delete light.power;
    light.irradiance ??= 1000;
    return;
  }
  if (before === 'parallel') {
    light.position = subtract(at, scale(unit(direction ?? [0, 0, -1]) ?? [0, 0, -1], far)).map((part) =>
      Number(part.toPrecision(6)),
    ) as Vec3;
    delete light.irradiance;
    light.intensity ??= 100;
    if (light.direction) {
      light.axis = light.direction;
      delete light.direction;
    }
  }
  if (emission === 'isotropic') dropAim(light);
  else if (before === 'isotropic') light.target = at;
}

/** The solid angle by which I₀ is to be multiplied for the power: that of docs/scene-file.md. */
function solidAngle(light: LightSource): number {
  const cosine = (degrees: number | undefined): number => Math.cos(((degrees ?? 0) * Math.PI) / 180);
  switch (emissionOf(light)) {
    case 'lambertian':
      return Math.PI;
    case 'spot':
      return Math.PI * (2 - cosine(light.inner_angle) - cosine(light.outer_angle));
    default:
      return 4 * Math.PI;
  }
}

/** How the strength of a light is written. */
export function strengthOf(light: LightSource): Strength {
  if (emissionOf(light) === 'parallel') return 'irradiance';
  return light.power === undefined ? 'intensity' : 'power';
}

/** Writes the same strength as intensity or as power. */
export function setStrength(light: LightSource, strength: 'intensity' | 'power'): void {
  const before = strengthOf(light);
  if (before === 'irradiance' || before === strength) return;
  const factor = strength === 'power' ? solidAngle(light) : 1 / solidAngle(light);
  const amount = light[before];
  delete light[before];
  if (amount !== undefined) light[strength] = times(amount, factor);
}

function times(amount: Amount, factor: number): Amount {
  const one = (value: number): number => Number((value * factor).toPrecision(15));
  return typeof amount === 'number' ? one(amount) : (amount.map(one) as Vec3);
}
