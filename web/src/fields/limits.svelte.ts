/** Whether fields keep to the ranges that the course sets. */
export const limits = $state({ course: false });
