/** Keeps what the session shows up to date with its scene: checked, rendered, read at its probes. Whatever takes long is asked of the
 * newest scene only. */

import { untrack } from 'svelte';
import { EngineError, type Engine, type PictureStyle, type ProbeRequest, type SectionRequest } from './engine/types';
import { Latest } from './latest';
import type { SceneSource } from './scene/model';
import type { Session } from './session.svelte';

/** A frame that takes longer than this, in ms, is drawn at half its resolution while something is dragged. */
const SLOW = 40;

interface Picture {
  scene: SceneSource;
  channel: string;
  isophotes: number;
  coarse: boolean;
}

/** Starts the effects; call it while a component is set up. */
export function keepComputing(session: Session): void {
  const { engine } = session;
  let lastFull = 0;
  let changedAt = 0;
  /** How many kinds of work there are at the moment. */
  let working = $state(0);

  /** Work on the newest input, which the page's state tells of. */
  const latest = <T>(work: (input: T, isNewest: () => boolean) => Promise<void>, stop?: Parameters<Engine['abandon']>[0]) =>
    new Latest(
      guarded(work),
      (isWorking) => untrack(() => (working += isWorking ? 1 : -1)),
      () => stop && engine.abandon(stop),
    );

  /** An invalid scene is no failure: its problems are shown already. Nor is what became pointless. */
  const guarded =
    <T>(work: (input: T, isNewest: () => boolean) => Promise<void>) =>
    async (input: T, isNewest: () => boolean): Promise<void> => {
      try {
        await work(input, isNewest);
      } catch (error) {
        if (!(error instanceof EngineError && error.problems.length > 0)) session.fail(error);
      }
    };

  const checking = latest(async (scene: SceneSource) => {
    const checked = await engine.check(scene);
    session.take(scene, checked);
  });

  const rendering = latest(async ({ scene, channel, isophotes, coarse }: Picture, isNewest) => {
    const started = performance.now();
    const frame = await engine.render(scene, channel, coarse ? 2 : 1);
    if (!coarse) lastFull = performance.now() - started;
    session.frame = frame;
    // For `make bench-app`, and for whoever looks into the browser's own tools.
    performance.measure('isophote: from change to map', { start: changedAt, end: performance.now() });
    if (coarse || !isNewest()) return;
    // Shown before it is analysed.
    const analysis = await engine.analyse(scene, frame, isophotes);
    session.analysis = analysis;
  }, 'render');

  const coloring = latest(async ({ scene, style }: { scene: SceneSource; style: PictureStyle }) => {
    const png = await engine.export(scene, { kind: 'png', channel: 'color', style });
    const bitmap = await createImageBitmap(new Blob([png as BlobPart], { type: 'image/png' }));
    session.colored?.bitmap.close();
    session.colored = { scene, bitmap };
  });

  const probing = latest(async (scene: SceneSource) => {
    session.probed = await engine.probe(scene, probesOf(scene));
  });

  const measuring = latest(async (scene: SceneSource) => {
    session.areas = scene.area?.length ? await engine.areas(scene) : [];
  }, 'areas');

  const sectioning = latest(
    async ({ scene, lines, channels }: { scene: SceneSource; lines: SectionRequest[]; channels: string[] }) => {
      const { answer, refusal } = await orRefusal(lines.length > 0 ? engine.section(scene, lines, channels) : []);
      [session.sections, session.sectionError] = [answer ?? [], refusal];
    },
    'section',
  );

  const explaining = latest(async ({ scene, request }: { scene: SceneSource; request: ProbeRequest }) => {
    const { answer, refusal } = await orRefusal(engine.explain(scene, request));
    [session.explanation, session.explanationError] = [answer, refusal];
  }, 'explain');

  $effect(() => {
    void session.language;
    changedAt = performance.now();
    checking.take(session.scene);
  });

  $effect(() => {
    document.documentElement.dataset['state'] = working === 0 ? 'ready' : 'busy';
  });

  $effect(() => {
    const { good: scene, info } = session;
    if (!scene || !info) return;
    const known = info.channels.includes(session.channel) ? session.channel : 'brightness';
    const coarse = session.dragging && lastFull > SLOW;
    rendering.take({ scene, channel: known, isophotes: session.style.isophotes, coarse });
  });

  $effect(() => {
    const { good: scene, isColored, dragging, shown } = session;
    if (scene && isColored && !dragging) coloring.take({ scene, style: shown.style });
  });

  $effect(() => {
    if (!session.good) return;
    void session.language;
    probing.take(session.good);
    measuring.take(session.good);
  });

  $effect(() => {
    void session.language;
    if (session.good) sectioning.take({ scene: session.good, lines: session.lines, channels: session.sectionChannels });
  });

  $effect(() => {
    void session.language;
    const { good: scene, explained, tab } = session;
    if (!scene || !explained || tab !== 'why') return;
    if ('at' in explained) {
      explaining.take({ scene, request: { name: 'P', at: explained.at, snap: true } });
    } else {
      const request = probesOf(scene)[explained.probe];
      if (request) explaining.take({ scene, request });
    }
  });
}

/** An answer, or why the core gives none. */
async function orRefusal<T>(asked: Promise<T> | T): Promise<{ answer: T | null; refusal: string | null }> {
  try {
    return { answer: await asked, refusal: null };
  } catch (error) {
    if (!(error instanceof EngineError) || error.kind !== 'refused') throw error;
    return { answer: null, refusal: error.message };
  }
}

/** The probes of a scene as questions. */
export function probesOf(scene: SceneSource): ProbeRequest[] {
  return (scene.probe ?? []).map(({ name, at }, index) => ({ name: name ?? `probe[${index}]`, at }));
}
