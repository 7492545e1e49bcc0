/** Where scenes come from: a link, the last visit, a file. Each is a text that the core reads. */

import type { Engine, Problem } from './engine/types';
import type { SceneSource } from './scene/model';
import type { Session } from './session.svelte';
import { isLink, jsonOfLink, linkOf, LinkError } from './scene/url';
import { fill, text } from './text/index.svelte';

/** The limit of the core for scene files, in bytes. */
const LARGEST_FILE = 64 << 20;
/** Larger ones are not opened at once: the page says that it is at it. */
const LARGE_FILE = 1 << 20;
/** Longer links do not pass through mail and messengers. */
const LONGEST_LINK = 32_000;

export interface Opened {
  scene: SceneSource;
  /** What the page has to say about it. */
  notice: string | null;
}

/** The scene that the page begins with: that of the link, else the last one, else the first example. */
export async function firstScene(engine: Engine, fragment: string, last: string | null): Promise<Opened> {
  const words = text.words.app;
  let notice: string | null = null;
  if (isLink(fragment)) {
    try {
      const read = await engine.read(jsonOfLink(fragment), 'json');
      if (isComplete(read.scene)) return { scene: read.scene, notice: null };
      notice = fill(words.linkBroken, { why: words.linkFaults.damaged });
    } catch (error) {
      const fault = error instanceof LinkError ? error.fault : 'damaged';
      notice = fill(words.linkBroken, { why: words.linkFaults[fault] });
    }
  }
  if (last !== null) {
    const { scene } = await engine.read(last, 'json');
    if (isComplete(scene)) return { scene, notice };
  }
  const { scene } = await engine.read(await engine.starter('lab'), 'toml');
  if (!isComplete(scene)) throw new Error('the first example is no scene');
  return { scene, notice };
}

/** The address of the page with a scene in it; null if that would be too long. */
export function linkTo(scene: SceneSource, address: string): string | null {
  try {
    const link = linkOf(scene);
    return link.length > LONGEST_LINK ? null : address.replace(/#.*$/s, '') + link;
  } catch (error) {
    if (error instanceof LinkError) return null;
    throw error;
  }
}

/** Shows another scene, as one step that can be undone; "reset" comes back to it. */
export function openScene(session: Session, scene: SceneSource): void {
  session.store.set(scene);
  session.origin = scene;
  session.selected = null;
  session.explained = null;
  session.lines = [];
}

/** Opens a file that was chosen or dropped. What is on the page stays where it holds no scene. */
export async function openFile(session: Session, file: File): Promise<void> {
  const words = text.words.app;
  if (file.size > LARGEST_FILE) {
    session.say(words.fileTooLarge);
    return;
  }
  if (file.size > LARGE_FILE) session.say(fill(words.opening, { name: file.name }));
  const content = await file.text();
  const syntax = /^\s*\{/.test(content) ? 'json' : 'toml';
  const { scene, problems } = await session.engine.read(content, syntax);
  const mistakes = problems.filter((problem) => problem.kind !== 'warning');
  if (!isComplete(scene)) {
    session.say(`${words.fileBroken} ${told(mistakes)}`);
    return;
  }
  openScene(session, scene);
  session.say(mistakes.length > 0 ? `${words.fileProblems} ${told(mistakes)}` : null);
}

/** The first few problems, in a line. */
function told(problems: Problem[]): string {
  return problems
    .slice(0, 3)
    .map(({ line, message, help }) => `${line === null ? '' : `${line}: `}${message}${help ? ` (${help})` : ''}`)
    .join('; ');
}

/** Whether a scene has what the page cannot do without: even a wrong scene can be edited, but not one without an observer. */
function isComplete(scene: SceneSource | null): scene is SceneSource {
  return scene !== null && typeof scene.camera === 'object' && scene.length !== undefined;
}
