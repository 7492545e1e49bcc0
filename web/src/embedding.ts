/** The page in a frame of another one, such as a notebook: it takes scenes from there, and hands them back when they change. */

import type { SceneSource } from './scene/model';

interface FromOutside {
  isophote: 'scene';
  scene: SceneSource;
}

/** Whether the page is in a frame whose owner may talk to it: one of the same origin. */
function isEmbedded(): boolean {
  return window.parent !== window && IS_ONE_FILE && location.protocol === 'blob:';
}

/** Listens for scenes from outside; returns what tells of a change. */
export function embed(onScene: (scene: SceneSource) => void): (scene: SceneSource) => void {
  if (!isEmbedded()) return () => {};
  let last = '';
  window.addEventListener('message', ({ source, data }: MessageEvent<FromOutside | undefined>) => {
    if (source !== window.parent || data?.isophote !== 'scene') return;
    last = JSON.stringify(data.scene);
    onScene(data.scene);
  });
  window.parent.postMessage({ isophote: 'ready' }, '*');
  return (scene) => {
    const text = JSON.stringify(scene);
    if (text === last) return;
    last = text;
    window.parent.postMessage({ isophote: 'changed', scene: JSON.parse(text) }, '*');
  };
}
