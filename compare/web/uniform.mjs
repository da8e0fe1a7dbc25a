// Points for comparisons: the same for everybody.

/** Uniform numbers from 0 to 1 (Marsaglia's xorshift). */
export function uniformNumbers(state = 12345) {
  return () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return (state >>> 0) / 2 ** 32;
  };
}
