/** Words of fields. */

export const en = {};

export const ru: typeof en = {};
