/** What the page shows of the scene: everything that is not part of the scene itself. One object, made once in main.ts and handed to
 * the parts of the page through `getSession()`. */

import { getContext, setContext } from 'svelte';
import type {
  Analysis,
  AreaReading,
  Checked,
  Engine,
  Explanation,
  Frame,
  Language,
  PictureStyle,
  Probed,
  Problem,
  SceneInfo,
  Section,
  SectionRequest,
  Vec2,
  Vec3,
} from './engine/types';
import type { SceneSource } from './scene/model';
import { EngineError } from './engine/types';
import { SceneStore } from './scene/store.svelte';
import { fill, reasonOf, text } from './text/index.svelte';

/** The part of the page beside the picture. */
export type Tab = 'values' | 'why' | 'sections' | 'more';

/** The point whose calculation is shown: a probe by its index, or any point. */
export type Explained = { probe: number } | { at: Vec3 };

export class Session {
  readonly store: SceneStore;
  readonly engine: Engine;
  /** The language of what the core says. */
  language = $state<Language>('en');

  /** What is known of the last valid scene, and that scene; the picture stays when the scene becomes invalid. */
  info = $state.raw<SceneInfo | null>(null);
  good = $state.raw<SceneSource | null>(null);
  problems = $state.raw<Problem[]>([]);
  /** The map of the last valid scene, its statistics and isophotes. */
  frame = $state.raw<Frame | null>(null);
  analysis = $state.raw<Analysis | null>(null);
  /** Values at the scene's probes and areas, and sections along `lines`. */
  probed = $state.raw<Probed[]>([]);
  areas = $state.raw<AreaReading[]>([]);
  sections = $state.raw<Section[]>([]);
  /** Why there are no sections, or no explanation. */
  sectionError = $state<string | null>(null);
  explanation = $state.raw<Explanation | null>(null);
  explanationError = $state<string | null>(null);

  /** The channel that the picture shows. */
  channel = $state('brightness');
  style = $state<PictureStyle>({ colormap: 'gray', range: null, normalization: 'max', isophotes: 8 });
  /** Whether a scene with colours is shown in them, where its brightness is shown; otherwise by its luminance. */
  inColor = $state(false);
  /** The picture in colours, and the scene that it is of. */
  colored = $state.raw<{ scene: SceneSource; bitmap: ImageBitmap } | null>(null);
  /** Lines whose sections are plotted, and the channels plotted. */
  lines = $state.raw<SectionRequest[]>([]);
  sectionChannels = $state.raw<string[]>(['brightness']);
  explained = $state.raw<Explained | null>(null);
  tab = $state<Tab>('values');
  /** The item of the scene that is being edited: "light[0]", "sphere[0]", "camera", "probe[2]". */
  selected = $state<string | null>(null);
  /** The screen point under the pointer, on the picture or along a section. */
  pointer = $state.raw<Vec2 | null>(null);
  /** Something that the page has to say. */
  notice = $state<string | null>(null);
  /** What "reset" goes back to: the example, file or link that the scene came from. */
  origin = $state.raw<SceneSource>() as SceneSource;
  /** Whether a handle is being dragged: previews may then be coarse. */
  dragging = $state(false);

  constructor(store: SceneStore, engine: Engine) {
    this.store = store;
    this.origin = store.scene;
    this.engine = engine;
  }

  get scene(): SceneSource {
    return this.store.scene;
  }

  /** Whether the picture is one in colours. */
  get isColored(): boolean {
    return this.inColor && this.channel === 'brightness' && (this.info?.hasColors ?? false);
  }

  /** What a picture as it is shown is made of. Colours have neither a colour map nor a normalisation of their own. */
  get shown(): { channel: string; style: PictureStyle } {
    // A copy without the page's reactivity: it goes to a worker.
    const style = $state.snapshot(this.style);
    if (!this.isColored) return { channel: this.channel, style };
    return { channel: 'color', style: { ...style, colormap: 'gray', normalization: 'max' } };
  }

  say(notice: string | null): void {
    this.notice = notice;
  }

  /** Says why something did not work; nothing where it was merely pointless. */
  fail(error: unknown): void {
    const kind = error instanceof EngineError ? error.kind : 'refused';
    if (kind === 'pointless') return;
    const { failed, lost } = text.words.app;
    this.notice = fill(kind === 'lost' ? lost : failed, { why: reasonOf(error) });
  }

  /** The shapes that the scene's probes are on, by name; of those that are on none, undefined. */
  get probedShapes(): (string | undefined)[] {
    return this.probed.map(({ reading }) => reading?.shape);
  }

  /** The problems of an item: of its keys as well, so "sphere[0]" has those of "sphere[0].radius". */
  problemsAt(path: string): Problem[] {
    return this.problems.filter(
      (problem) => problem.path === path || problem.path.startsWith(`${path}.`) || problem.path.startsWith(`${path}[`),
    );
  }

  /** Takes the answer to `check`. */
  take(scene: SceneSource, { info, problems }: Checked): void {
    this.problems = problems;
    if (info) {
      this.info = info;
      this.good = scene;
    }
  }
}

const KEY = Symbol('session');

export function setSession(session: Session): void {
  setContext(KEY, session);
}

export function getSession(): Session {
  return getContext<Session>(KEY);
}
