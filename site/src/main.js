// The page: the workbench at once, the figures below it when they come near.

import {load} from "./load.js";
import {workbench} from "./workbench/bench.js";

const bench = document.getElementById("bench");
try {
  workbench(bench);
} catch (error) {
  const status = bench.querySelector("#bench-status");
  status.textContent = `The workbench does not work here: ${error.message}`;
  status.className = "error";
}
document.documentElement.dataset.bench = "true";

const figures = () => load("figures.js").catch(({message}) => {
  for (const caption of document.querySelectorAll("figcaption")) caption.textContent = `The figures do not work here: ${message}`;
});
const near = new IntersectionObserver(
  (entries) => {
    if (!entries.some(({isIntersecting}) => isIntersecting)) return;
    near.disconnect();
    figures();
  },
  {rootMargin: "300px"},
);
near.observe(document.getElementById("play"));
