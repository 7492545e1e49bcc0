/** What a click on the picture does. */

import type { Vec2 } from '../engine/types';
import { addProbe } from '../scene/defaults';
import { namesBeside } from '../scene/edit';
import type { Session } from '../session.svelte';
import { text } from '../text/index.svelte';

export type ClickMode = 'look' | 'probe' | 'why';

export async function pick(session: Session, mode: ClickMode, screen: Vec2): Promise<void> {
  if (mode === 'look' || !session.good) return;
  const words = text.words.views;
  const [probed] = await session.engine.probe(session.good, [{ name: '', screen }]);
  const at = probed?.reading?.point;
  if (!at) {
    session.say(mode === 'probe' ? words.picture.noSurface : words.why.noPoint);
  } else if (mode === 'why') {
    session.explained = { at };
    session.tab = 'why';
  } else {
    session.store.edit((draft) => {
      addProbe(draft, session.info, newProbeName(session), at);
    });
    session.tab = 'values';
  }
}

/** "P1", or the first such name that is free. */
export function newProbeName(session: Session): string {
  const taken = new Set(namesBeside(session.scene, 'probe'));
  let number = 1;
  while (taken.has(text.words.views.picture.newProbe(number))) number += 1;
  return text.words.views.picture.newProbe(number);
}
