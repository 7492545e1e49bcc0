/** What part of a window is looked at, and where its points are in pixels of the page. */

import type { Vec2 } from '../engine/types';

/** Edges in coordinates: x to the right, y up. */
export interface Window {
  x: Vec2;
  y: Vec2;
}

export interface Size {
  width: number;
  height: number;
}

/** A magnification, and the place in the middle as fractions of the window from its left and its top. */
export interface View {
  zoom: number;
  middle: Vec2;
}

export const WHOLE: View = { zoom: 1, middle: [0.5, 0.5] };

/** At most this many times larger. */
export const MAX_ZOOM = 40;

/** The largest size of a box of this aspect (width over height) inside another. */
export function fit(aspect: number, into: Size): Size {
  const width = Math.max(1, Math.min(into.width, into.height * aspect));
  return { width, height: width / aspect };
}

/** The view that is nearest to one and shows nothing outside the window. */
export function within({ zoom, middle }: View): View {
  const magnification = Math.min(MAX_ZOOM, Math.max(1, zoom));
  const half = 0.5 / magnification;
  const clamp = (place: number) => Math.min(1 - half, Math.max(half, place));
  return { zoom: magnification, middle: [clamp(middle[0]), clamp(middle[1])] };
}

/** Zooms so that the point at these fractions of the box (from its left and its top) stays where it is. */
export function zoomAbout(view: View, factor: number, [across, down]: Vec2): View {
  const zoom = Math.min(MAX_ZOOM, Math.max(1, view.zoom * factor));
  const shift = 1 / view.zoom - 1 / zoom;
  return within({
    zoom,
    middle: [view.middle[0] + (across - 0.5) * shift, view.middle[1] + (down - 0.5) * shift],
  });
}

/** Moves what is seen by these fractions of the box, to the right and down. */
export function pan(view: View, [right, down]: Vec2): View {
  return within({ ...view, middle: [view.middle[0] - right / view.zoom, view.middle[1] - down / view.zoom] });
}

/** Coordinates ↔ pixels of a box that shows a view of a window. */
export class Projection {
  readonly #window: Window;
  readonly #box: Size;
  readonly #view: View;

  constructor(window: Window, box: Size, view: View = WHOLE) {
    this.#window = window;
    this.#box = box;
    this.#view = view;
  }

  /** Where the left upper corner of the window is, and the size of the whole of it. */
  get placement(): { left: number; top: number } & Size {
    const { zoom, middle } = this.#view;
    const width = this.#box.width * zoom;
    const height = this.#box.height * zoom;
    return { left: this.#box.width / 2 - middle[0] * width, top: this.#box.height / 2 - middle[1] * height, width, height };
  }

  toBox([x, y]: Vec2): Vec2 {
    const { left, top, width, height } = this.placement;
    const [x0, x1] = this.#window.x;
    const [y0, y1] = this.#window.y;
    return [left + ((x - x0) / (x1 - x0)) * width, top + ((y1 - y) / (y1 - y0)) * height];
  }

  fromBox([across, down]: Vec2): Vec2 {
    const { left, top, width, height } = this.placement;
    const [x0, x1] = this.#window.x;
    const [y0, y1] = this.#window.y;
    return [x0 + ((across - left) / width) * (x1 - x0), y1 - ((down - top) / height) * (y1 - y0)];
  }

  /** The edges of what is seen. */
  get seen(): Window {
    const [left, top] = this.fromBox([0, 0]);
    const [right, bottom] = this.fromBox([this.#box.width, this.#box.height]);
    return { x: [left, right], y: [bottom, top] };
  }

  isSeen(point: Vec2): boolean {
    const [across, down] = this.toBox(point);
    return across >= 0 && down >= 0 && across <= this.#box.width && down <= this.#box.height;
  }
}

/** The column and row of a map's pixel that holds a point; null outside. */
export function pixelAt(window: Window, size: Size, [x, y]: Vec2): Vec2 | null {
  const column = Math.floor(((x - window.x[0]) / (window.x[1] - window.x[0])) * size.width);
  const row = Math.floor(((window.y[1] - y) / (window.y[1] - window.y[0])) * size.height);
  return column >= 0 && row >= 0 && column < size.width && row < size.height ? [column, row] : null;
}
