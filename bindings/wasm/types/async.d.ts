export * from "./index.js";
export {default} from "./index.js";

/** Makes the module ready, by default from the file beside the script. Until then nothing can be triangulated. */
export function init(
  source?: string | URL | BufferSource | WebAssembly.Module | Response | Promise<string | URL | BufferSource | WebAssembly.Module | Response>,
): Promise<void>;
