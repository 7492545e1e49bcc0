/** What is said to a worker, and what it answers. */

import type { Colormap, ExportRequest, Frame, Language, ProbeRequest, SectionRequest, SurfaceRequest } from './types';

/** The core, compiled once for all workers; or its bytes, where workers have to compile it themselves. */
export type CoreModule = WebAssembly.Module | ArrayBuffer;

/** A question about a scene: the worker loads that first, if it holds another one. */
interface OfScene {
  /** As JSON. */
  scene: string;
}

export type Question =
  | { kind: 'start'; module: CoreModule }
  | { kind: 'language'; language: Language }
  | { kind: 'file'; name: string; content: Uint8Array }
  | { kind: 'read'; text: string; syntax: 'toml' | 'json' }
  | { kind: 'starter'; name: string }
  | { kind: 'toml'; text: string }
  | { kind: 'check'; text: string }
  | { kind: 'colormap'; name: Colormap }
  | ({ kind: 'render'; channel: string; first: number; count: number; step: number } & OfScene)
  | ({ kind: 'thumbnail'; channel: string } & OfScene)
  | ({ kind: 'surface'; request: SurfaceRequest; channel: string } & OfScene)
  | ({ kind: 'grid'; grid: string; channel: string } & OfScene)
  | ({
      kind: 'analyse';
      head: Omit<Frame, 'values' | 'shapes'>;
      values: Float64Array;
      shapes: Int32Array;
      levels: number | number[];
    } & OfScene)
  | ({ kind: 'probe'; requests: ProbeRequest[] } & OfScene)
  | ({ kind: 'explain'; request: ProbeRequest } & OfScene)
  | ({ kind: 'section'; lines: SectionRequest[]; channels: string[] } & OfScene)
  | ({ kind: 'areas' } & OfScene)
  | ({ kind: 'export'; request: ExportRequest } & OfScene);

export interface Answer {
  id: number;
  value: unknown;
  /** Why there is no value. */
  error: string | null;
  /** Whether the worker has to be replaced. */
  fatal: boolean;
}

/** Rows of a map. */
export interface BandAnswer {
  head: Omit<Frame, 'values' | 'shapes' | 'step'> & { full: [number, number] };
  values: Float64Array;
  shapes: Int32Array;
}
