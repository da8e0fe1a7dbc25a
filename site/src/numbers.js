// Numbers in the text that can be dragged, and changed by keys: <span class="number" data-min="3" data-max="400" data-step="1">60</span>.

/** Pixels of a step. */
const STRIDE = 4;

/** Makes a number of the text one that changes; `change` hears of its value. */
export function draggable(element, label, change) {
  const [min, max, step] = ["min", "max", "step"].map((key) => Number(element.dataset[key]));
  let value = Number(element.textContent);
  let held;
  Object.assign(element, {role: "spinbutton", tabIndex: 0, ariaLabel: label, ariaValueMin: String(min), ariaValueMax: String(max)});

  function set(next) {
    next = Math.min(Math.max(Math.round(next / step) * step, min), max);
    if (next === value) return;
    value = next;
    show();
    change(value);
  }
  function show() {
    element.textContent = String(value);
    element.ariaValueNow = String(value);
  }
  element.addEventListener("pointerdown", (event) => {
    element.setPointerCapture(event.pointerId);
    held = {x: event.clientX, value};
  });
  element.addEventListener("pointermove", (event) => held && set(held.value + ((event.clientX - held.x) / STRIDE) * step));
  for (const end of ["pointerup", "pointercancel"]) element.addEventListener(end, () => (held = undefined));
  element.addEventListener("keydown", (event) => {
    const steps = {ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1, PageUp: 10, PageDown: -10}[event.key];
    if (!steps) return;
    event.preventDefault();
    set(value + steps * step);
  });
  show();
}
