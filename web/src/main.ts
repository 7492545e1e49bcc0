import './app.css';
import { mount } from 'svelte';
import App from './App.svelte';
import Failed from './Failed.svelte';
import { loadCore } from './engine/module';
import { startEngine } from './engine';
import { firstScene } from './opening';
import { SceneKeeper } from './scene/storage';
import { reasonOf, text } from './text/index.svelte';

const target = document.getElementById('app')!;

try {
  if (typeof WebAssembly !== 'object') throw new Error('WebAssembly');
  const engine = await startEngine(await loadCore(), text.language);
  const keeper = new SceneKeeper((fault) => fault && page.say(text.words.app.notKept[fault]));
  const opened = await firstScene(engine, location.hash, keeper.last());
  const page = mount(App, { target, props: { engine, opened, keeper } });
} catch (error) {
  console.warn(error);
  mount(Failed, { target, props: { reason: reasonOf(error) } });
}

if (!IS_ONE_FILE && 'serviceWorker' in navigator && import.meta.env.PROD && window.isSecureContext) {
  navigator.serviceWorker.register('./offline.js').catch(() => {
    // Without it the page works as long as there is a network.
  });
}
