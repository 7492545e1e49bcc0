/** Words of views. */

export const en = {};

export const ru: typeof en = {};
