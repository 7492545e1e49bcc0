/** The engine: the core in workers. One answers what is answered at once, one renders maps beside the picture, one does other work
 * that may take long, and all others render bands of rows of the picture. */

import { resolutionOf } from '../scene/camera';
import type { SceneSource } from '../scene/model';
import type { BandAnswer, CoreModule, Question } from './messages';
import { CoreClient } from './pool';
import type {
  Analysis,
  AreaReading,
  Checked,
  Colormap,
  Engine,
  Explanation,
  ExportRequest,
  Frame,
  Language,
  Probed,
  ProbeRequest,
  ReadScene,
  Section,
  SectionRequest,
  SurfaceRequest,
} from './types';

/** Bands for each worker: several, so that one with an easy part of the image takes another. */
const BANDS_PER_WORKER = 2;
/** Fewer rows are not worth a message. */
const LEAST_ROWS = 32;

class WorkerEngine implements Engine {
  version = '';
  readonly #answering: CoreClient;
  readonly #rendering: CoreClient[];
  readonly #module: CoreModule;
  readonly #files = new Map<string, Uint8Array>();
  /** Started when they are needed. */
  #maps: CoreClient | null = null;
  #long: CoreClient | null = null;
  #language: Language;
  #texts = new WeakMap<SceneSource, string>();

  constructor(module: CoreModule, workers: number, language: Language) {
    this.#language = language;
    this.#module = module;
    this.#answering = new CoreClient(module, language, this.#files);
    this.#rendering = Array.from({ length: workers }, () => new CoreClient(module, language, this.#files));
  }

  /** Waits for the first core. */
  async start(): Promise<void> {
    this.version = await this.#answering.started;
  }

  get language(): Language {
    return this.#language;
  }

  set language(language: Language) {
    this.#language = language;
    for (const client of this.#clients) client.setLanguage(language);
  }

  get #clients(): CoreClient[] {
    return [this.#answering, this.#maps, this.#long, ...this.#rendering].filter((client) => client !== null);
  }

  #ofMaps(): CoreClient {
    return (this.#maps ??= new CoreClient(this.#module, this.#language, this.#files));
  }

  #ofLong(): CoreClient {
    return (this.#long ??= new CoreClient(this.#module, this.#language, this.#files));
  }

  abandon(kind: Question['kind']): void {
    // A whole map for a file is rendered by another worker, and wanted in any case.
    for (const client of kind === 'render' ? this.#rendering : [this.#maps, this.#long]) {
      client?.abandon((question) => question.kind === kind);
    }
  }

  async addFile(name: string, content: Uint8Array): Promise<void> {
    this.#files.set(name, content);
    await Promise.all(this.#clients.map((client) => client.ask({ kind: 'file', name, content })));
  }

  read(text: string, syntax: 'toml' | 'json'): Promise<ReadScene> {
    return this.#answering.ask({ kind: 'read', text, syntax });
  }

  starter(name: string): Promise<string> {
    return this.#answering.ask({ kind: 'starter', name });
  }

  toToml(scene: SceneSource): Promise<string> {
    return this.#answering.ask({ kind: 'toml', text: this.#text(scene) });
  }

  check(scene: SceneSource): Promise<Checked> {
    return this.#answering.ask({ kind: 'check', text: this.#text(scene) });
  }

  async render(scene: SceneSource, channel: string, step: 1 | 2 = 1): Promise<Frame> {
    const size = resolutionOf(scene.camera);
    const height = Math.ceil(size[1] / step);
    const bands = bandsOf(height, this.#rendering.length);
    const text = this.#text(scene);
    const answers = await Promise.all(
      bands.map(([first, count], index) => {
        const client = this.#rendering[index % this.#rendering.length]!;
        return client.ask<BandAnswer>({ kind: 'render', scene: text, channel, first, count, step });
      }),
    );
    return joined(answers, step);
  }

  analyse(scene: SceneSource, { values, shapes, ...head }: Frame, levels: number | number[]): Promise<Analysis> {
    return this.#answering.ask({ kind: 'analyse', scene: this.#text(scene), head, values, shapes, levels });
  }

  probe(scene: SceneSource, requests: ProbeRequest[]): Promise<Probed[]> {
    return this.#answering.ask({ kind: 'probe', scene: this.#text(scene), requests });
  }

  explain(scene: SceneSource, request: ProbeRequest): Promise<Explanation> {
    return this.#ofLong().ask({ kind: 'explain', scene: this.#text(scene), request });
  }

  section(scene: SceneSource, lines: SectionRequest[], channels: string[]): Promise<Section[]> {
    return this.#ofLong().ask({ kind: 'section', scene: this.#text(scene), lines, channels });
  }

  areas(scene: SceneSource): Promise<AreaReading[]> {
    return this.#ofLong().ask({ kind: 'areas', scene: this.#text(scene) });
  }

  map(scene: SceneSource, channel: string): Promise<Frame> {
    const count = resolutionOf(scene.camera)[1];
    return this.#whole(this.#ofLong(), { kind: 'render', scene: this.#text(scene), channel, first: 0, count, step: 1 });
  }

  thumbnail(scene: SceneSource, channel: string): Promise<Frame> {
    return this.#whole(this.#ofMaps(), { kind: 'thumbnail', scene: this.#text(scene), channel });
  }

  surface(scene: SceneSource, request: SurfaceRequest, channel: string): Promise<Frame> {
    return this.#whole(this.#ofMaps(), { kind: 'surface', scene: this.#text(scene), request, channel });
  }

  grid(scene: SceneSource, grid: string, channel: string): Promise<Frame> {
    return this.#whole(this.#ofMaps(), { kind: 'grid', scene: this.#text(scene), grid, channel });
  }

  colormap(name: Colormap): Promise<Uint8Array> {
    return this.#answering.ask({ kind: 'colormap', name });
  }

  export(scene: SceneSource, request: ExportRequest): Promise<Uint8Array> {
    return this.#ofLong().ask({ kind: 'export', scene: this.#text(scene), request });
  }

  /** A map that is one band. */
  async #whole(client: CoreClient, question: Question): Promise<Frame> {
    const { head, values, shapes } = await client.ask<BandAnswer>(question);
    return { ...head, values, shapes, step: 1 };
  }

  /** A scene as JSON, made once. */
  #text(scene: SceneSource): string {
    let text = this.#texts.get(scene);
    if (text === undefined) {
      text = JSON.stringify(scene);
      this.#texts.set(scene, text);
    }
    return text;
  }
}

/** The first row and the number of rows of each band. */
export function bandsOf(height: number, workers: number): [number, number][] {
  const rows = workers === 1 ? height : Math.max(LEAST_ROWS, Math.ceil(height / (workers * BANDS_PER_WORKER)));
  const bands: [number, number][] = [];
  for (let first = 0; first < height; first += rows) bands.push([first, Math.min(rows, height - first)]);
  return bands;
}

/** The whole frame. */
export function joined(bands: BandAnswer[], step: 1 | 2): Frame {
  const first = bands[0]!;
  const { full, ...head } = first.head;
  const [width, height] = full;
  // The edges of the whole image: the upper edge of the first band, the lower one of the last.
  const last = bands.at(-1)!;
  const y: [number, number] = [last.head.window.y[0], first.head.window.y[1]];
  const window = { x: head.window.x, y };
  const lit = bands.reduce<number | null>(
    (sum, band) => (sum === null || band.head.lit === null ? null : sum + band.head.lit),
    0,
  );
  if (bands.length === 1) return { ...head, width, height, values: first.values, shapes: first.shapes, window, lit, step };
  const values = new Float64Array(width * height);
  const shapes = new Int32Array(width * height);
  let at = 0;
  for (const band of bands) {
    values.set(band.values, at);
    shapes.set(band.shapes, at);
    at += band.values.length;
  }
  return { ...head, width, height, values, shapes, window, lit, step };
}

/** Starts the engine with a module, on as many workers as the machine has processors to spare. */
export async function startEngine(
  module: CoreModule,
  language: Language,
  workers = Math.min(8, Math.max(1, (navigator.hardwareConcurrency || 2) - 1)),
): Promise<Engine> {
  const engine = new WorkerEngine(module, workers, language);
  await engine.start();
  return engine;
}
