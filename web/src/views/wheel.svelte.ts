/** The wheel over something that zooms: it scrolls the page, as everywhere, unless Ctrl is held or what is under it has the focus. */

/** How long the hint stays, in ms. */
const SHOWN = 2000;

export class Wheel {
  /** Whether to say how to zoom. */
  isHinted = $state(false);
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** Whether a turn of the wheel is to zoom; the page then does not scroll. */
  takes(event: WheelEvent & { currentTarget: Element }): boolean {
    if (event.ctrlKey || event.metaKey || event.currentTarget.contains(document.activeElement)) {
      event.preventDefault();
      this.#show(false);
      return true;
    }
    this.#show(true);
    return false;
  }

  #show(isHinted: boolean): void {
    clearTimeout(this.#timer);
    this.isHinted = isHinted;
    if (isHinted) this.#timer = setTimeout(() => (this.isHinted = false), SHOWN);
  }
}

/** One finger on a handle, and two anywhere, move what is under them, not the page: an attachment. (`touch-action` says nothing of the
 * parts of an SVG, nor of two fingers that move the same way.) */
export function fingered(element: Element): () => void {
  const keep = (event: Event) => {
    const isHandle = event.target instanceof Element && event.target.closest('[role=slider], [role=button]') !== null;
    if ((isHandle || (event as TouchEvent).touches.length > 1) && event.cancelable) event.preventDefault();
  };
  element.addEventListener('touchmove', keep, { passive: false });
  return () => element.removeEventListener('touchmove', keep);
}
