/** The page without a network: a service worker that keeps the files of one build, made when the build is. */

import { createHash } from 'node:crypto';
import type { Plugin } from 'vite';

const worker = (name: string, files: string[]) => `const NAME = ${JSON.stringify(name)};
const FILES = ${JSON.stringify(files)};
self.addEventListener('install', (event) => {
  event.waitUntil(caches.open(NAME).then((cache) => cache.addAll(FILES)).then(() => self.skipWaiting()));
});
self.addEventListener('activate', (event) => {
  const isOld = (key) => key.startsWith('isophote-') && key !== NAME;
  const clean = caches.keys().then((keys) => Promise.all(keys.filter(isOld).map((key) => caches.delete(key))));
  event.waitUntil(clean.then(() => self.clients.claim()));
});
self.addEventListener('fetch', (event) => {
  if (event.request.method !== 'GET') return;
  event.respondWith(caches.match(event.request, { ignoreSearch: true, ignoreVary: true }).then((kept) => kept ?? fetch(event.request)));
});
`;

export function offline(): Plugin {
  return {
    name: 'isophote-offline',
    apply: 'build',
    enforce: 'post',
    generateBundle(_options, bundle) {
      const files = Object.keys(bundle).sort();
      const hash = createHash('sha256');
      for (const file of files) {
        const item = bundle[file]!;
        hash.update(file).update(item.type === 'chunk' ? item.code : item.source);
      }
      const name = `isophote-${hash.digest('hex').slice(0, 16)}`;
      const kept = ['./', ...files.filter((file) => file !== 'index.html').map((file) => `./${file}`)];
      this.emitFile({ type: 'asset', fileName: 'offline.js', source: worker(name, kept) });
    },
  };
}
