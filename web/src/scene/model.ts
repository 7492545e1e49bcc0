/** A scene exactly as its file has it: the keys of docs/scene-file.md. Nothing is filled in; lengths are in `length`. */

import type { Vec2, Vec3 } from '../engine/types';

/** A number, or the three of linear RGB. */
export type Amount = number | Vec3;

export type LengthUnit = 'mm' | 'cm' | 'm';
export type Convention =
  'irradiance' | 'lambert' | 'lab' | 'course' | 'course-pi' | 'radiance' | 'blinn-phong' | 'blinn-phong-pi';

export interface SceneSource {
  version: 1;
  title?: string;
  length: LengthUnit;
  handedness?: 'left' | 'right';
  convention?: Convention;
  shadows?: boolean;
  quantities?: 'radiometric' | 'photometric';
  color_space?: string;
  camera: CameraSource;
  sampling?: { samples?: number; tolerance?: number; filter?: string };
  material?: Record<string, MaterialSource>;
  sphere?: SphereSource[];
  ellipsoid?: EllipsoidSource[];
  box?: BoxSource[];
  cylinder?: CylinderSource[];
  cone?: ConeSource[];
  plane?: PlaneSource[];
  rectangle?: RectangleSource[];
  disk?: DiskSource[];
  mesh?: Record<string, unknown>[];
  spheres?: Record<string, unknown>[];
  light?: LightSource[];
  ambient?: { radiance?: Amount; obstructed?: boolean; samples?: number };
  probe?: ProbeSource[];
  area?: AreaSource[];
  grid?: GridSource[];
}

export interface CameraSource {
  projection?: 'perspective' | 'orthographic' | 'fisheye-equidistant' | 'fisheye-equal-area' | 'panorama';
  eye?: Vec3;
  target?: Vec3;
  forward?: Vec3;
  /** Degrees between the direction of view and −z, and its direction about z from +x towards +y. */
  tilt?: number;
  azimuth?: number;
  up?: Vec3;
  screen?: { distance: number; x: Vec2; y: Vec2 };
  window?: { x: Vec2; y: Vec2 };
  field_of_view?: number;
  resolution?: Vec2;
  [other: string]: unknown;
}

export interface MaterialSource {
  diffuse?: Amount;
  specular?: Amount;
  shininess?: number;
}

export interface ShapeSource {
  name?: string;
  material?: string;
  casts_shadow?: boolean;
  receives_shadow?: boolean;
}

export interface Rotation {
  axis: Vec3;
  degrees: number;
}

export interface SphereSource extends ShapeSource {
  center: Vec3;
  radius: number;
}

export interface EllipsoidSource extends ShapeSource {
  center: Vec3;
  radii: Vec3;
  rotation?: Rotation;
}

export interface BoxSource extends ShapeSource {
  center: Vec3;
  size: Vec3;
  rotation?: Rotation;
}

export interface CylinderSource extends ShapeSource {
  from: Vec3;
  to: Vec3;
  radius: number;
}

export interface ConeSource extends ShapeSource {
  base: Vec3;
  apex: Vec3;
  radius: number;
  apex_radius?: number;
}

export interface PlaneSource extends ShapeSource {
  point: Vec3;
  normal: Vec3;
}

export interface RectangleSource extends ShapeSource {
  center: Vec3;
  normal: Vec3;
  up?: Vec3;
  width: number;
  height: number;
}

export interface DiskSource extends ShapeSource {
  center: Vec3;
  normal: Vec3;
  radius: number;
}

export interface LightSource {
  name?: string;
  emission?: 'isotropic' | 'lambertian' | 'spot' | 'parallel';
  position?: Vec3;
  intensity?: Amount;
  power?: Amount;
  axis?: Vec3;
  target?: Vec3;
  tilt?: number;
  azimuth?: number;
  /** Half angles of a spot's cones, in degrees. */
  inner_angle?: number;
  outer_angle?: number;
  /** Of a parallel light: where the light goes, and E₀. */
  direction?: Vec3;
  irradiance?: Amount;
  casts_shadows?: boolean;
  on?: boolean;
}

export interface ProbeSource {
  name?: string;
  at: Vec3;
  published?: number;
}

export interface AreaSource {
  name?: string;
  on?: string;
  center?: Vec3;
  at?: Vec2;
  radius?: number;
  size?: Vec2;
  up?: Vec3;
}

export interface GridSource {
  name?: string;
  corner?: Vec3;
  center?: Vec3;
  u: Vec3;
  v: Vec3;
  points: Vec2;
  side?: 'front' | 'back' | 'both';
}
