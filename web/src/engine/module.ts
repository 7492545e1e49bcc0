/** The core as a WebAssembly module, compiled once for all workers. */

import url from './wasm/isophote_web_bg.wasm?url';

export async function compileCore(): Promise<WebAssembly.Module> {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${response.status} ${response.statusText}`);
  // Some servers do not know the type, which streaming needs.
  const isTyped = response.headers.get('content-type')?.startsWith('application/wasm') ?? false;
  return isTyped ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}
