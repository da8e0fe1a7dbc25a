// Scripts that come when they are needed, each once. A page from a disk may not import modules, but may have scripts.

const scripts = new Map();

export function load(name) {
  if (!scripts.has(name)) {
    const loaded = new Promise((resolve, reject) => {
      const script = document.createElement("script");
      script.src = name;
      script.addEventListener("load", resolve);
      script.addEventListener("error", () => {
        scripts.delete(name);
        reject(new Error(`${name} could not be loaded`));
      });
      document.head.append(script);
    });
    scripts.set(name, loaded);
  }
  return scripts.get(name);
}
