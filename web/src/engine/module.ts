/** The core as a WebAssembly module. */

import type { CoreModule } from './messages';
import url from './wasm/isophote_web_bg.wasm?url';

export async function loadCore(): Promise<CoreModule> {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${response.status} ${response.statusText}`);
  // A page without an address of its own, opened from a disk, cannot hand a module to its workers.
  if (IS_ONE_FILE) return response.arrayBuffer();
  // Some servers do not know the type, which streaming needs.
  const isTyped = response.headers.get('content-type')?.startsWith('application/wasm') ?? false;
  return isTyped ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}
