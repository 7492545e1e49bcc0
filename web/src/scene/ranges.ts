/** What a number of a scene may be: the limits of the core (crates/isophote/src/scene/limits.rs), and, where they are wanted, those
 * of the course. The core has the last word; these say it while a number is typed. */

import { projectionOf } from './camera';
import type { LengthUnit, SceneSource } from './model';
import { materialIn } from './path';

export interface Range {
  min: number;
  max: number;
  /** Whether the least value is itself not allowed. */
  above?: boolean;
  whole?: boolean;
  /** Whether these are the course's own limits. */
  course?: boolean;
}

const IN_A_METRE: Record<LengthUnit, number> = { mm: 1000, cm: 100, m: 1 };
const STRENGTH: Range = { min: 0, max: 1e30 };

/** The keys whose numbers are places, and those that are sizes; sizes are above 0. */
const PLACES = /^(center|position|target|eye|point|from|to|base|apex|at|corner|x|y|translation)$/;
const SIZES = /^(radius|radii|size|width|height|distance|scale)$/;

/** The range of the number at a path: of `light[0].position[2]`, say. */
export function rangeAt(scene: SceneSource, path: string, course: boolean): Range {
  const own = course ? courseRange(scene, path) : null;
  return own ?? coreRange(scene, path);
}

function coreRange(scene: SceneSource, path: string): Range {
  const unit = IN_A_METRE[scene.length];
  const material = materialIn(scene, path);
  const key = material === null ? lastKey(path) : path.slice(`material.${material}.`.length).replace(/\[.*/, '');
  const coordinate = 1e15 * unit;
  if (PLACES.test(key)) return { min: -coordinate, max: coordinate };
  if (SIZES.test(key))
    return { min: path.startsWith('area') ? 0 : 1e-12 * unit, max: coordinate, above: path.startsWith('area') };
  switch (key) {
    case 'apex_radius':
      return { min: 0, max: coordinate };
    case 'intensity':
    case 'power':
    case 'irradiance':
    case 'radiance':
      return STRENGTH;
    case 'diffuse':
      return { min: 0, max: isAlbedo(scene, 'diffuse') ? 1 : 1e6 };
    case 'specular':
      return { min: 0, max: isAlbedo(scene, 'specular') ? 1 : 1e6 };
    case 'shininess':
      return { min: 0, max: 1e5, above: true };
    case 'tilt':
      return { min: 0, max: 180 };
    case 'azimuth':
    case 'longitude':
      return { min: -360, max: 360 };
    case 'latitude':
      return { min: -90, max: 90 };
    case 'field_of_view':
      return projectionOf(scene.camera) === 'perspective' ? { min: 1e-6, max: 179.9999 } : { min: 1e-6, max: 360 };
    case 'inner_angle':
      return { min: 0, max: 89.5 };
    case 'outer_angle':
      return { min: 0.5, max: 90 };
    case 'resolution':
      return { min: 1, max: 65536, whole: true };
    case 'samples':
      return { min: 1, max: 4096, whole: true };
    case 'tolerance':
      return { min: 1e-4, max: 1 };
    default:
      return { min: -1e100, max: 1e100 };
  }
}

/** Whether the convention makes a coefficient a fraction of the light. */
function isAlbedo(scene: SceneSource, coefficient: 'diffuse' | 'specular'): boolean {
  const convention = scene.convention ?? 'radiance';
  if (coefficient === 'specular') return convention === 'radiance';
  return ['lambert', 'course-pi', 'radiance', 'blinn-phong-pi'].includes(convention);
}

/** The ranges that the tasks of the course set: sides of the screen and heights 100 to 10000 mm, x and y as far from the middle,
 * 200 to 800 pixels, I₀ 0.01 to 10000 W/sr. */
function courseRange(scene: SceneSource, path: string): Range | null {
  const millimetres = (min: number, max: number): Range => {
    const factor = IN_A_METRE[scene.length] / 1000;
    return { min: min * factor, max: max * factor, course: true };
  };
  if (path === 'camera.width' || path === 'camera.height') return millimetres(100, 10000);
  if (/^camera\.resolution\[[01]\]$/.test(path)) return { min: 200, max: 800, whole: true, course: true };
  if (/^(light\[\d+\]\.position|camera\.eye)\[2\]$/.test(path)) return millimetres(100, 10000);
  if (/^(light\[\d+\]\.position|camera\.eye|sphere\[\d+\]\.center)\[\d\]$/.test(path)) return millimetres(-10000, 10000);
  if (/^light\[\d+\]\.intensity/.test(path)) return { min: 0.01, max: 10000, course: true };
  return null;
}

function lastKey(path: string): string {
  return /([^.[\]]+)(\[\d+\])*$/.exec(path)?.[1] ?? '';
}

export function isIn({ min, max, above, whole }: Range, value: number): boolean {
  return (above ? value > min : value >= min) && value <= max && (!whole || Number.isInteger(value));
}

/** The nearest allowed value; of a range that does not hold its least value, `value` itself stays where it is too small. */
export function clamped(range: Range, value: number, before: number): number {
  if (range.above && value <= range.min) return before;
  const inside = Math.min(Math.max(value, range.min), range.max);
  return range.whole ? Math.round(inside) : inside;
}
