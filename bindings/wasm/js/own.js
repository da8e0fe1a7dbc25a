// Copies. `structuredClone`, messages between threads, a spread and `JSON.stringify` take what an object has of its own. Arrays that are made
// when first read belong to the class, and so would be missing, where d3's objects have them: each object gets the getters as its own.

/** Getters of a class as properties to be defined on its objects. */
export function own(Class, names) {
  const all = Object.getOwnPropertyDescriptors(Class.prototype);
  return Object.fromEntries(names.map((name) => [name, {...all[name], enumerable: true}]));
}

/** What an object has by such getters, as plain arrays: of typed arrays JSON makes objects. */
export function shared(object, properties) {
  const arrays = Object.keys(properties).map((name) => [name, object[name]]);
  return Object.fromEntries(arrays.filter(([, array]) => array).map(([name, array]) => [name, Array.from(array)]));
}
