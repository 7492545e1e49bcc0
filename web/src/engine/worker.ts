/** A worker: one core, which answers one question after another. */

import { initSync, Core, version } from './wasm/isophote_web.js';
import type { Answer, Question } from './messages';

let core: Core | null = null;
/** The scene that the core holds, as its text; another one is loaded first. */
let loaded = '';

function answer(question: Question): { value: unknown; transfer: Transferable[] } {
  if (question.kind === 'start') {
    initSync({ module: question.module });
    core = new Core();
    return { value: version(), transfer: [] };
  }
  if (!core) throw new Error('the core is not there yet');
  if ('scene' in question && question.scene !== loaded) {
    const checked = core.load(question.scene);
    if (JSON.parse(checked).info === null) {
      loaded = '';
      return { value: { invalid: JSON.parse(checked).problems }, transfer: [] };
    }
    loaded = question.scene;
  }
  switch (question.kind) {
    case 'language':
      core.set_language(question.language);
      return { value: null, transfer: [] };
    case 'file':
      core.add_file(question.name, question.content);
      // What a scene says may be another one with it.
      loaded = '';
      return { value: null, transfer: [] };
    case 'read':
      return { value: JSON.parse(core.read(question.text, question.syntax)), transfer: [] };
    case 'starter':
      return { value: core.starter(question.name), transfer: [] };
    case 'toml':
      return { value: core.to_toml(question.text), transfer: [] };
    case 'check': {
      const checked = JSON.parse(core.load(question.text));
      if (checked.info) loaded = question.text;
      return { value: checked, transfer: [] };
    }
    case 'render':
      return band(core.render(question.channel, question.first, question.count, question.step));
    case 'thumbnail':
      return band(core.thumbnail(question.channel));
    case 'surface':
      return band(core.surface(JSON.stringify(question.request), question.channel));
    case 'grid':
      return band(core.grid(question.grid, question.channel));
    case 'analyse': {
      const { head, values, shapes, levels } = question;
      return {
        value: JSON.parse(core.analyse(JSON.stringify(head), values, shapes, JSON.stringify(levels))),
        transfer: [],
      };
    }
    case 'probe':
      return { value: JSON.parse(core.probe(JSON.stringify(question.requests))), transfer: [] };
    case 'explain':
      return { value: JSON.parse(core.explain(JSON.stringify(question.request))), transfer: [] };
    case 'section': {
      const { lines, channels } = question;
      return { value: JSON.parse(core.section(JSON.stringify(lines), JSON.stringify(channels))), transfer: [] };
    }
    case 'areas':
      return { value: JSON.parse(core.areas()), transfer: [] };
    case 'export': {
      const bytes = core.export(JSON.stringify(question.request));
      return { value: bytes, transfer: [bytes.buffer] };
    }
    case 'colormap':
      return { value: core.colormap(question.name), transfer: [] };
  }
}

function band(rows: ReturnType<Core['render']>): { value: unknown; transfer: Transferable[] } {
  const value = { head: JSON.parse(rows.head), values: rows.take_values(), shapes: rows.take_shapes() };
  rows.free();
  return { value, transfer: [value.values.buffer, value.shapes.buffer] };
}

self.onmessage = ({ data: { id, question } }: MessageEvent<{ id: number; question: Question }>) => {
  let reply: Answer;
  let transfer: Transferable[] = [];
  try {
    const answered = answer(question);
    transfer = answered.transfer;
    reply = { id, value: answered.value, error: null, fatal: false };
  } catch (error) {
    // The core refuses with a text. Anything else is a fault, after which its memory is not to be trusted.
    const fatal = typeof error !== 'string';
    reply = { id, value: null, error: String(error), fatal };
  }
  self.postMessage(reply, { transfer });
};
