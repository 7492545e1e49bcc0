/** Scenes to start from. Their titles and descriptions are in text/fields.ts, under the same names. */

import type { SceneSource } from './model';

export type PresetName =
  'lab' | 'course-sphere' | 'course-plane' | 'two-lights' | 'sun' | 'room' | 'photometric' | 'course';

export interface Preset {
  name: PresetName;
  /** The scene; null for a starter of the core, which `Engine.starter` has under this name. */
  scene: ((title: string) => SceneSource) | null;
  /** Whether the ranges that the course sets are meant for it. */
  course: boolean;
}

export const PRESETS: readonly Preset[] = [
  { name: 'lab', scene: null, course: false },
  { name: 'course-sphere', scene: null, course: true },
  { name: 'course-plane', scene: null, course: true },
  { name: 'two-lights', scene: null, course: false },
  { name: 'sun', scene: sun, course: false },
  { name: 'room', scene: room, course: false },
  { name: 'photometric', scene: null, course: false },
  { name: 'course', scene: null, course: false },
];

/** A sphere in parallel light. */
function sun(title: string): SceneSource {
  return {
    version: 1,
    title,
    length: 'm',
    convention: 'radiance',
    camera: {
      eye: [0, 0, 6],
      target: [0, 0, 0],
      screen: { distance: 6, x: [-1.6, 1.6], y: [-1.2, 1.2] },
      resolution: [800, 600],
    },
    material: { clay: { diffuse: 0.6, specular: 0.05, shininess: 30 } },
    sphere: [{ name: 'ball', center: [0, 0, 0], radius: 1, material: 'clay' }],
    light: [{ name: 'sun', emission: 'parallel', direction: [-0.6, -0.5, -0.6], irradiance: 1000 }],
    probe: [{ name: 'front', at: [0, 0, 1] }],
  };
}

/** A corner of a room with a few solids, a lamp under the ceiling and light from the walls. */
function room(title: string): SceneSource {
  return {
    version: 1,
    title,
    length: 'm',
    quantities: 'photometric',
    convention: 'radiance',
    shadows: true,
    camera: {
      eye: [1.6, 1.7, 2.2],
      target: [-0.5, 0.7, -1],
      screen: { distance: 1, x: [-0.8, 0.8], y: [-0.6, 0.6] },
      resolution: [800, 600],
    },
    material: {
      plaster: { diffuse: 0.8 },
      wood: { diffuse: 0.4, specular: 0.1, shininess: 20 },
      glaze: { diffuse: 0.35, specular: 0.3, shininess: 60 },
    },
    sphere: [{ name: 'ball', center: [0.15, 0.94, -0.75], radius: 0.2, material: 'glaze' }],
    box: [
      { name: 'room', center: [0, 1.25, 0], size: [4, 2.5, 5], material: 'plaster' },
      { name: 'cupboard', center: [-1.7, 0.9, 0.4], size: [0.6, 1.8, 1.2], material: 'wood' },
    ],
    cylinder: [{ name: 'foot', from: [0, 0.01, -0.8], to: [0, 0.73, -0.8], radius: 0.05, material: 'wood' }],
    cone: [{ name: 'cone', base: [-0.35, 0.745, -0.8], apex: [-0.35, 1.2, -0.8], radius: 0.15, material: 'plaster' }],
    disk: [{ name: 'table', center: [0, 0.74, -0.8], normal: [0, 1, 0], radius: 0.7, material: 'wood' }],
    light: [{ name: 'lamp', position: [0.3, 2.2, -0.4], power: 1500 }],
    ambient: { radiance: 5 },
    probe: [{ name: 'table', at: [0.3, 0.74, -0.4] }],
  };
}
