/** Files that the browser saves. */

/** Offers bytes or a text as a file. */
export function download(name: string, content: Uint8Array | string | Blob, type = 'application/octet-stream'): void {
  const blob = content instanceof Blob ? content : new Blob([content as BlobPart], { type });
  const address = URL.createObjectURL(blob);
  const link = document.createElement('a');
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}

/** A file name made of a scene's title: letters and digits of any language, joined by hyphens. */
export function fileName(title: string | undefined, suffix: string): string {
  const words = (title ?? '').toLowerCase().match(/[\p{L}\p{N}]+/gu) ?? [];
  return `${words.slice(0, 6).join('-') || 'scene'}${suffix}`;
}

/** Puts a text into the clipboard; false where the browser does not allow it. */
export async function copy(content: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(content);
    return true;
  } catch {
    return false;
  }
}
