/** Vectors, for placing things; no light is computed here. */

import type { Vec3 } from '../engine/types';

export function add([ax, ay, az]: Vec3, [bx, by, bz]: Vec3): Vec3 {
  return [ax + bx, ay + by, az + bz];
}

export function subtract([ax, ay, az]: Vec3, [bx, by, bz]: Vec3): Vec3 {
  return [ax - bx, ay - by, az - bz];
}

export function scale([x, y, z]: Vec3, factor: number): Vec3 {
  return [x * factor, y * factor, z * factor];
}

export function dot([ax, ay, az]: Vec3, [bx, by, bz]: Vec3): number {
  return ax * bx + ay * by + az * bz;
}

export function length([x, y, z]: Vec3): number {
  return Math.hypot(x, y, z);
}

/** The vector of length 1; null for one of length 0. */
export function unit(vector: Vec3): Vec3 | null {
  const norm = length(vector);
  return norm > 0 && Number.isFinite(norm) ? scale(vector, 1 / norm) : null;
}

/** The direction that makes these angles, in degrees: with −z, and about z from +x towards +y. */
export function directionOf(tilt: number, azimuth: number): Vec3 {
  const [t, a] = [(tilt * Math.PI) / 180, (azimuth * Math.PI) / 180];
  return [Math.sin(t) * Math.cos(a), Math.sin(t) * Math.sin(a), -Math.cos(t)].map(
    (part) => Number(part.toFixed(15)) + 0,
  ) as Vec3;
}

/** The angles of a direction, in degrees: its tilt from −z, and its azimuth, which one along z has none of. */
export function anglesOf([x, y, z]: Vec3): { tilt: number; azimuth: number | null } {
  const aside = Math.hypot(x, y);
  const tilt = tidy((Math.atan2(aside, -z) * 180) / Math.PI);
  const isUpright = tilt === 0 || tilt === 180;
  return { tilt, azimuth: isUpright ? null : tidy((Math.atan2(y, x) * 180) / Math.PI) };
}

/** Without the last digits, which a sine or an arc adds: 45 instead of 45.00000000000001. */
export function tidy(value: number): number {
  return Number(value.toFixed(11)) + 0;
}

/** To so many significant digits. */
export function rounded(value: number, digits: number): number {
  return Number(value.toPrecision(digits));
}

/** The power of ten at or below a positive number. */
export function decade(value: number): number {
  return 10 ** Math.floor(Math.log10(value));
}
