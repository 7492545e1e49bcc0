/**
 * The questions that the page asks the core, and the answers. Lengths are in the scene's unit, angles in degrees; every
 * number is a double that the core computed, and no answer holds a formula of the page's own.
 */

import type { SceneSource } from '../scene/model';

export type Vec2 = [number, number];
export type Vec3 = [number, number, number];
export type Language = 'en' | 'ru';

/** What is wrong with a scene, or, for a warning, what its author should know; in the engine's language. */
export interface Problem {
  kind: 'unreadable' | 'syntax' | 'unknown-key' | 'missing-key' | 'wrong-type' | 'value' | 'warning';
  /** The item concerned, as `sphere[0].radius`; empty for the text as a whole. */
  path: string;
  /** What is wrong, with the value. */
  message: string;
  /** What is allowed, or what to do. */
  help: string | null;
  /** Line and column in the text, from 1, if the scene came from a text. */
  line: number | null;
  column: number | null;
}

/** What a text says. A scene that can be read at all is there even where it has problems. */
export interface ReadScene {
  scene: SceneSource | null;
  problems: Problem[];
}

export interface Checked {
  /** What there is to know of a valid scene; null where there are problems. */
  info: SceneInfo | null;
  /** Mistakes and warnings. */
  problems: Problem[];
}

export type ShapeKind =
  'sphere' | 'ellipsoid' | 'box' | 'cylinder' | 'cone' | 'plane' | 'rectangle' | 'disk' | 'mesh' | 'spheres';

/** Facts that follow from a valid scene. */
export interface SceneInfo {
  title: string;
  length: 'mm' | 'cm' | 'm';
  /** The unit of screen coordinates: that of lengths, or "°". */
  screenUnit: string;
  convention: {
    name: string;
    /** The label with the formula's number: "lab (3.3)". */
    label: string;
    /** The formula as text: "B = Σ E_j (k_d cosθ_o + k_s (N·H_j)^n)". */
    formula: string;
  };
  units: { brightness: string; irradiance: string; intensity: string; power: string; radiance: string };
  resolution: Vec2;
  /** Edges of the picture in screen coordinates: x to the right, y up. */
  window: { x: Vec2; y: Vec2 };
  camera: {
    projection: string;
    eye: Vec3;
    /** Unit vectors: to the right on the screen, up on it, into the picture. */
    right: Vec3;
    up: Vec3;
    forward: Vec3;
    /** The corners of the picture in space (lower left, lower right, upper right, upper left): a perspective's screen, or
     * the window of parallel rays. null for a fisheye or a panorama. */
    corners: [Vec3, Vec3, Vec3, Vec3] | null;
  };
  shapes: ShapeInfo[];
  /** The first lights, as many as a page can show. */
  lights: LightInfo[];
  materials: string[];
  probes: string[];
  areas: string[];
  grids: string[];
  shadows: boolean;
  hasAmbient: boolean;
  hasColors: boolean;
  /** Channels that a picture can show, in order: "brightness", "irradiance", "diffuse", …; of single lights, those of the first. */
  channels: string[];
}

export interface ShapeInfo {
  name: string;
  kind: ShapeKind;
  /** Its place in the scene: "sphere[0]". */
  path: string;
  material: string | null;
  center: Vec3;
  /** The corners of its bounding box; null for a plane, which has none. */
  bounds: { low: Vec3; high: Vec3 } | null;
  /** Where its centre appears in screen coordinates; null behind the eye. */
  onScreen: Vec2 | null;
}

export interface LightInfo {
  name: string;
  kind: 'isotropic' | 'lambertian' | 'spot' | 'parallel';
  on: boolean;
  /** null for a parallel light. */
  position: Vec3 | null;
  /** The unit vector along its axis, or of the light of a parallel one; null for an isotropic one. */
  axis: Vec3 | null;
  onScreen: Vec2 | null;
}

/** A channel of the map, row by row from the top. */
export interface Frame {
  channel: string;
  unit: string;
  width: number;
  height: number;
  /** 0 where no surface is seen. */
  values: Float64Array;
  /** The index of the shape seen, −1 where there is none. */
  shapes: Int32Array;
  /** Edges in the coordinates of the axes. */
  window: { x: Vec2; y: Vec2 };
  axes: [Axis, Axis];
  /** What the coordinates are: "screen", "longitude-latitude", … */
  coordinates: string;
  /** Pixels that get any light; null where that was not asked. */
  lit: number | null;
  /** 2 for a preview of half the resolution. */
  step: 1 | 2;
}

export interface Axis {
  name: string;
  title: string;
  unit: string;
}

export interface FrameStatistics {
  pixels: number;
  visible: number;
  /** Visible pixels that get any light; null where the frame does not say. */
  lit: number | null;
  /** null where no surface is seen. */
  max: Extreme | null;
  min: Extreme | null;
  mean: number | null;
}

/** An extreme over the centres of the pixels. */
export interface Extreme {
  value: number;
  /** Column and row from the top left, from 0. */
  pixel: Vec2;
  screen: Vec2;
  /** The point of the surface there; null on a map of a surface or a grid. */
  point: Vec3 | null;
}

/** A curve of equal value: polylines of points in the frame's coordinates. */
export interface Isophote {
  level: number;
  lines: { points: Vec2[]; closed: boolean }[];
}

export interface Analysis {
  statistics: FrameStatistics;
  isophotes: Isophote[];
}

/** Where a value is wanted. */
export type ProbeRequest =
  | { name: string; at: Vec3; snap?: boolean }
  | { name: string; pixel: Vec2 }
  | { name: string; screen: Vec2 }
  | { name: string; shape: string; angles: Vec2 };

export interface ProbeReading {
  name: string;
  point: Vec3;
  normal: Vec3;
  shape: string;
  /** Where the point appears in screen coordinates; null behind the eye. */
  screen: Vec2 | null;
  /** Whether the eye sees it; if not, why. */
  seen: boolean;
  unseenBecause: string | null;
  cosThetaO: number;
  brightness: number;
  irradiance: number;
  ambient: number;
  diffuse: number;
  specular: number;
  lights: {
    name: string;
    irradiance: number;
    diffuse: number;
    specular: number;
    visibility: number;
    cosThetaI: number;
    cosThetaH: number;
    /** null for a parallel light. */
    distance: number | null;
  }[];
}

/** A reading, or why there is none. */
export type Probed = { reading: ProbeReading; error: null } | { reading: null; error: string };

/** The calculation of a value, step by step: plain text with formula numbers, in blocks. The first block is the geometry, then
 * one for each light, then ambient light if there is any, then the sum. */
export interface Explanation {
  title: string;
  blocks: { title: string; lines: string[] }[];
  /** Blocks, most of them lights, that are left out before the last two. */
  omitted: number;
}

/** A line on the screen. */
export type SectionRequest =
  | { kind: 'row'; row: number }
  | { kind: 'column'; column: number }
  | { kind: 'horizontal'; y: number }
  | { kind: 'vertical'; x: number }
  | { kind: 'between'; from: Vec2; to: Vec2 }
  /** The horizontal and the vertical line through the centre of a shape: two sections. */
  | { kind: 'through'; shape: string };

export interface Section {
  /** Where it runs, in words. */
  name: string;
  /** What a position along the line is: x, y, or the distance from the first point. */
  axis: 'x' | 'y' | 'distance';
  /** Positions along the line. */
  positions: number[];
  screen: Vec2[];
  /** By channel: values, null where no surface is seen. */
  values: Record<string, (number | null)[]>;
  units: Record<string, string>;
  points: (Vec3 | null)[];
}

/** The values inside a circle or a rectangle of interest. */
export interface AreaReading {
  name: string;
  on: string | null;
  unit: string;
  /** null where no surface is seen. */
  max: AreaExtreme | null;
  min: AreaExtreme | null;
  mean: number | null;
  /** An estimate of the error of the mean. */
  meanError: number | null;
  /** The fraction of it that the eye sees, or that shows a surface. */
  visible: number;
}

export interface AreaExtreme {
  value: number;
  point: Vec3;
  screen: Vec2 | null;
  seen: boolean;
}

/** A map over a shape's own surface. */
export interface SurfaceRequest {
  shape: string;
  width: number;
  /** A projection that keeps areas, or one that keeps the coordinate. */
  equalArea?: boolean;
}

/** Why a question has no answer: it is refused, its worker stopped, or a newer one made it pointless. */
export type NoAnswer = 'refused' | 'lost' | 'pointless';

/** The error of a question that has no answer; the message is in the engine's language. */
export class EngineError extends Error {
  constructor(
    message: string,
    readonly problems: Problem[] = [],
    readonly kind: NoAnswer = 'refused',
  ) {
    super(message);
    this.name = 'EngineError';
  }
}

/** How values become a picture. */
export interface PictureStyle {
  colormap: Colormap;
  /** Values of black and white; null for the range of the normalisation. */
  range: Vec2 | null;
  normalization: 'max' | 'minmax' | 'log';
  isophotes: number;
}

export type Colormap = 'gray' | 'viridis' | 'cividis' | 'inferno' | 'turbo' | 'batlow';

/** A file to be made. */
export type ExportRequest =
  /** The picture of 0–255 as the command writes it. */
  | { kind: 'png'; channel: string; style: PictureStyle }
  /** The figure with axes, colour bar and isophotes. */
  | { kind: 'figure-svg' | 'figure-png'; channel: string; style: PictureStyle; marks: boolean }
  | { kind: 'map-csv'; channels: string[] }
  | { kind: 'section-csv' | 'section-svg' | 'section-png'; sections: SectionRequest[]; channels: string[] }
  | { kind: 'probes-csv'; probes: ProbeRequest[] };

/** The core, in workers. Every question concerns a scene as it is written; an invalid one is answered by an `EngineError` with
 * its problems. Questions that may take long do not delay others of another kind. */
export interface Engine {
  /** The language of messages and explanations. */
  language: Language;
  /** A file that scenes name. It is kept until the page is left. */
  addFile(name: string, content: Uint8Array): Promise<void>;
  read(text: string, syntax: 'toml' | 'json'): Promise<ReadScene>;
  /** A starter scene, as text with its comments in the engine's language. */
  starter(name: string): Promise<string>;
  /** The scene as a TOML file. */
  toToml(scene: SceneSource): Promise<string>;
  check(scene: SceneSource): Promise<Checked>;
  /** A map. `step` 2 renders every second pixel. */
  render(scene: SceneSource, channel: string, step?: 1 | 2): Promise<Frame>;
  /** A whole map that no picture waits for and that is not abandoned with them: it takes longer. */
  map(scene: SceneSource, channel: string): Promise<Frame>;
  /** Statistics and isophotes of a frame that `render`, `map`, `surface` or `grid` gave; about so many levels, or given ones. */
  analyse(scene: SceneSource, frame: Frame, isophotes: number | number[]): Promise<Analysis>;
  probe(scene: SceneSource, requests: ProbeRequest[]): Promise<Probed[]>;
  explain(scene: SceneSource, request: ProbeRequest): Promise<Explanation>;
  section(scene: SceneSource, lines: SectionRequest[], channels: string[]): Promise<Section[]>;
  areas(scene: SceneSource): Promise<AreaReading[]>;
  /** A small map: at most 200 pixels wide and high, of the same window. */
  thumbnail(scene: SceneSource, channel: string): Promise<Frame>;
  surface(scene: SceneSource, request: SurfaceRequest, channel: string): Promise<Frame>;
  grid(scene: SceneSource, name: string, channel: string): Promise<Frame>;
  /** 256 colours, three bytes each. */
  colormap(name: Colormap): Promise<Uint8Array>;
  export(scene: SceneSource, request: ExportRequest): Promise<Uint8Array>;
  /** Nobody waits for the answer any more: what takes long is stopped. */
  abandon(kind: 'render' | 'section' | 'explain' | 'areas' | 'surface' | 'grid' | 'thumbnail'): void;
  /** The version of the core. */
  version: string;
}
