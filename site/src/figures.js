// The figures: each begins when it comes near, and alone, so that one that fails says so and leaves the others alive.

import {copy} from "./copy.js";
import {circle} from "./figures/circle.js";
import {location} from "./figures/location.js";
import {one} from "./figures/one.js";
import {play} from "./figures/play.js";
import {race} from "./figures/race.js";
import {steps} from "./figures/steps.js";
import {surface} from "./figures/surface.js";
import {voronoi} from "./figures/voronoi.js";
import {walls} from "./figures/walls.js";

const figures = {play, circle, one, voronoi, location, steps, walls, surface, race};

/** Begins a figure. */
function open(section, begin) {
  const status = section.querySelector("figcaption");
  const tell = (text, isError = false) => {
    status.textContent = text;
    status.classList.toggle("error", isError);
  };
  try {
    begin(section, tell);
  } catch (error) {
    tell(`This figure does not work here: ${error.message}`, true);
  }
  section.dataset.ready = "true";
}

// One after the other as they come near, so that none holds up the page for long.
const near = new IntersectionObserver(
  (entries) => {
    for (const {isIntersecting, target} of entries) {
      if (!isIntersecting) continue;
      near.unobserve(target);
      setTimeout(() => open(target, figures[target.id]));
    }
  },
  {rootMargin: "300px"},
);
for (const block of document.querySelectorAll(".code")) {
  const button = Object.assign(document.createElement("button"), {textContent: "Copy"});
  const told = Object.assign(document.createElement("span"), {role: "status"});
  button.addEventListener("click", () => copy(block.querySelector("code"), told));
  block.append(button, " ", told);
}
for (const name of Object.keys(figures)) near.observe(document.getElementById(name));
