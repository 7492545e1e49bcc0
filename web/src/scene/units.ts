/** Another unit for the lengths of a scene. */

import { projectionOf, framingOf } from './camera';
import type { LengthUnit, SceneSource } from './model';
import { itemsOf, LISTS, type Item, type List } from './edit';

const IN_A_METRE: Record<LengthUnit, number> = { mm: 1000, cm: 100, m: 1 };

/** The lengths, and lists of lengths, of each kind of item. Directions, angles and strengths are none. */
const LENGTHS: Record<List, readonly string[]> = {
  sphere: ['center', 'radius'],
  ellipsoid: ['center', 'radii'],
  box: ['center', 'size'],
  cylinder: ['from', 'to', 'radius'],
  cone: ['base', 'apex', 'radius', 'apex_radius'],
  plane: ['point'],
  rectangle: ['center', 'width', 'height'],
  disk: ['center', 'radius'],
  mesh: ['position', 'scale'],
  spheres: [],
  light: ['position', 'target'],
  probe: ['at'],
  area: ['center', 'radius', 'size'],
  grid: ['corner', 'center', 'u', 'v'],
};

/** Whether the scene can be written in another unit: the numbers in a file of spheres are not the page's to change. */
export function canConvert(scene: SceneSource): boolean {
  return itemsOf(scene, 'spheres').length === 0;
}

/** Writes the same scene in another unit. */
export function convertLengths(draft: SceneSource, to: LengthUnit): void {
  const [multiply, divide] = [IN_A_METRE[to], IN_A_METRE[draft.length]];
  const convert = (value: unknown): unknown => {
    if (typeof value === 'number') return Number(((value * multiply) / divide).toPrecision(16));
    return Array.isArray(value) ? value.map(convert) : value;
  };
  const convertKeys = (table: Item | undefined, keys: readonly string[]): void => {
    for (const key of keys) if (table?.[key] !== undefined) table[key] = convert(table[key]);
  };
  const isScreenInLengths = screenIsInLengths(draft);
  for (const list of LISTS) {
    for (const item of itemsOf(draft, list)) {
      if (list === 'area' && item.on === undefined) {
        if (isScreenInLengths) convertKeys(item, ['at', 'radius', 'size']);
      } else {
        if (list === 'mesh') item.scale ??= [1, 1, 1];
        convertKeys(item, LENGTHS[list]);
      }
    }
  }
  const { camera } = draft;
  convertKeys(camera as Item, ['eye', 'target']);
  convertKeys(camera.screen as Item | undefined, ['distance', 'x', 'y']);
  convertKeys(camera.window as Item | undefined, ['x', 'y']);
  convertKeys(camera.pose as Item | undefined, ['translation']);
  draft.length = to;
}

/** Whether places on the screen change with the unit: not angles, and not those of a screen at the distance of one unit. */
function screenIsInLengths({ camera }: SceneSource): boolean {
  const projection = projectionOf(camera);
  return projection === 'orthographic' || (projection === 'perspective' && framingOf(camera) === 'screen');
}
