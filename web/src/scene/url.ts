/**
 * A scene as the fragment of a link, which never reaches a server.
 *
 *     #s1.DATA.SUM
 *
 * - `s1`: a scene, version 1 of this format;
 * - DATA: the scene as JSON (the keys of docs/scene-file.md, UTF-8, no byte order mark), compressed as raw DEFLATE (RFC 1951), in
 *   base64url (RFC 4648, section 5) without padding;
 * - SUM: the CRC-32 of the JSON's bytes (that of zlib and PNG: polynomial 0xEDB88320, reflected, initial and final 0xFFFFFFFF), as
 *   8 lower-case hexadecimal digits.
 *
 * The JSON is at most 8 MB (8 × 2^20 bytes); a reader stops unpacking beyond that.
 */

import { deflateSync, Inflate } from 'fflate';
import type { SceneSource } from './model';

const MOST_BYTES = 8 << 20;
/** Unpacked at once: little enough that the most that it can become, some thousand times as much, is soon seen to be too much. */
const PIECE = 1024;

/** Why a link holds no scene: it is none at all, of a version to come, cut short, changed on its way, or too large. */
export type LinkFault = 'none' | 'version' | 'short' | 'damaged' | 'large';

export class LinkError extends Error {
  constructor(readonly fault: LinkFault) {
    super(`no scene in the link: ${fault}`);
    this.name = 'LinkError';
  }
}

/** The fragment, with its `#`, that holds a scene. */
export function linkOf(scene: SceneSource): string {
  const bytes = new TextEncoder().encode(JSON.stringify(scene));
  if (bytes.length > MOST_BYTES) throw new LinkError('large');
  return `#s1.${toBase64Url(deflateSync(bytes, { level: 9 }))}.${crc32(bytes).toString(16).padStart(8, '0')}`;
}

/** Whether a fragment is meant as a scene. */
export function isLink(fragment: string): boolean {
  return /^#s\d+\./.test(fragment);
}

/** The JSON of the scene in a fragment. It is text that anybody may have written: the core is to read it as it reads a file. */
export function jsonOfLink(fragment: string): string {
  if (!isLink(fragment)) throw new LinkError('none');
  if (!fragment.startsWith('#s1.')) throw new LinkError('version');
  const parts = /^#s1\.([A-Za-z0-9_-]*)(?:\.([0-9a-f]*))?$/.exec(fragment);
  if (!parts) throw new LinkError('damaged');
  const [, data = '', sum = ''] = parts;
  if (sum.length < 8) throw new LinkError('short');
  if (sum.length > 8 || data.length % 4 === 1) throw new LinkError('damaged');
  const bytes = inflate(fromBase64Url(data));
  if (crc32(bytes) !== Number.parseInt(sum, 16)) throw new LinkError('damaged');
  try {
    return new TextDecoder('utf-8', { fatal: true }).decode(bytes);
  } catch {
    throw new LinkError('damaged');
  }
}

function inflate(packed: Uint8Array): Uint8Array {
  const pieces: Uint8Array[] = [];
  let size = 0;
  let isComplete = false;
  const stream = new Inflate((piece, isLast) => {
    size += piece.length;
    if (size > MOST_BYTES) throw new LinkError('large');
    pieces.push(piece);
    isComplete = isLast;
  });
  try {
    for (let at = 0; at < packed.length; at += PIECE) {
      stream.push(packed.subarray(at, at + PIECE), at + PIECE >= packed.length);
    }
  } catch (error) {
    throw error instanceof LinkError ? error : new LinkError('damaged');
  }
  if (!isComplete) throw new LinkError('damaged');
  const bytes = new Uint8Array(size);
  let at = 0;
  for (const piece of pieces) {
    bytes.set(piece, at);
    at += piece.length;
  }
  return bytes;
}

function toBase64Url(bytes: Uint8Array): string {
  let binary = '';
  for (const byte of bytes) binary += String.fromCharCode(byte);
  return btoa(binary).replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '');
}

function fromBase64Url(text: string): Uint8Array {
  const binary = atob(text.replace(/-/g, '+').replace(/_/g, '/'));
  return Uint8Array.from(binary, (character) => character.charCodeAt(0));
}

export function crc32(bytes: Uint8Array): number {
  let sum = 0xffffffff;
  for (const byte of bytes) sum = (CRC_TABLE[(sum ^ byte) & 0xff] as number) ^ (sum >>> 8);
  return (sum ^ 0xffffffff) >>> 0;
}

const CRC_TABLE = Uint32Array.from({ length: 256 }, (_, byte) => {
  let entry = byte;
  for (let bit = 0; bit < 8; bit += 1) entry = entry & 1 ? 0xedb88320 ^ (entry >>> 1) : entry >>> 1;
  return entry;
});
