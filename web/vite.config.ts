import { svelte } from '@sveltejs/vite-plugin-svelte';
import { defineConfig } from 'vite';
import { viteSingleFile } from 'vite-plugin-singlefile';
import { offline } from './offline.ts';

/** Two builds: a folder of static files, and, with `--mode one-file`, the same page as a single file. */
export default defineConfig(({ mode }) => {
  const isOneFile = mode === 'one-file';
  return {
    base: './',
    define: { IS_ONE_FILE: JSON.stringify(isOneFile) },
    plugins: [svelte(), ...(isOneFile ? [viteSingleFile({ removeViteModuleLoader: true })] : [offline()])],
    build: {
      target: 'es2022',
      outDir: isOneFile ? 'dist/one-file' : 'dist/site',
      emptyOutDir: true,
      assetsInlineLimit: isOneFile ? Number.MAX_SAFE_INTEGER : 0,
      chunkSizeWarningLimit: 1000,
      reportCompressedSize: false,
    },
    // Module workers do not start on a page that was opened from a disk.
    worker: { format: 'iife' },
  };
});
