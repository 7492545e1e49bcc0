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
      if (isComplete(read.scene)) return { scene: read.scene, notice: needsFiles(read.scene) ? words.openTogether : null };
      notice = fill(words.linkBroken, { why: words.linkFaults.damaged });
    } catch (error) {
      const fault = error instanceof LinkError ? error.fault : 'damaged';
      notice = fill(words.linkBroken, { why: words.linkFaults[fault] });
    }
  }
  if (last !== null) {
    const { scene } = await engine.read(last, 'json');
    if (isComplete(scene)) return { scene, notice: notice ?? (needsFiles(scene) ? words.openTogether : null) };
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

/** Opens files that were chosen or dropped: a scene, with the files that it names perhaps, or only those. What is on the page stays where
 * there is no scene in them. */
export async function openFiles(session: Session, chosen: Iterable<File>): Promise<void> {
  const words = text.words.app;
  const files = [...chosen];
  if (files.some((file) => file.size > LARGEST_FILE)) {
    session.say(words.fileTooLarge);
    return;
  }
  const file = files.find(({ name }) => /\.(toml|json)$/i.test(name)) ?? (files.length === 1 ? files[0] : undefined);
  if (!file) {
    session.say(words.noSceneAmong);
    return;
  }
  if (file.size > LARGE_FILE) session.say(fill(words.opening, { name: file.name }));
  const content = await file.text();
  const syntax = /^\s*\{/.test(content) ? 'json' : 'toml';
  let read = await session.engine.read(content, syntax);
  const named = namedFiles(read.scene).flatMap((name) => {
    const found = files.find((one) => one.name === name.replace(/^.*[/\\]/, ''));
    return found ? [{ name, file: found }] : [];
  });
  for (const one of named) await session.engine.addFile(one.name, new Uint8Array(await one.file.arrayBuffer()));
  if (named.length > 0) read = await session.engine.read(content, syntax);
  const { scene, problems } = read;
  const mistakes = problems.filter((problem) => problem.kind !== 'warning');
  if (!isComplete(scene)) {
    session.say(`${words.fileBroken} ${told(mistakes)}`);
    return;
  }
  openScene(session, scene);
  const missing = namedFiles(scene).length > named.length ? ` ${words.openTogether}` : '';
  if (mistakes.length > 0) session.say(`${words.fileProblems} ${told(mistakes)}${missing}`);
  else session.say(named.length > 0 ? words.filesStay : null);
}

/** The files that the shapes of a scene come from, by the names that the scene has for them. */
function namedFiles(scene: SceneSource | null): string[] {
  const shapes = [...(scene?.mesh ?? []), ...(scene?.spheres ?? [])];
  return [...new Set(shapes.flatMap(({ file }) => (typeof file === 'string' ? [file] : [])))];
}

/** Whether a link and the next visit would be without a part of the scene. */
export function needsFiles(scene: SceneSource): boolean {
  return namedFiles(scene).length > 0;
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
