// The figures: each alone, so that one that fails says so and leaves the others alive.

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

for (const [name, begin] of Object.entries(figures)) {
  const section = document.getElementById(name);
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
}
document.documentElement.dataset.ready = "true";
