// What only Node has, by names that bundlers for browsers do not follow.

export const isNode = typeof process !== "undefined" && !!process.versions?.node;

/** A module of Node. */
export const builtin = (name) => import(/* webpackIgnore: true */ /* @vite-ignore */ `node:${name}`);
