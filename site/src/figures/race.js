// Ours against delaunator, in a worker.

import source from "worker:worker.js";
import {background} from "../background.js";
import {scatter} from "../random.js";

export function race(section, tell) {
  const of = (name) => section.querySelector(`#race-${name}`);
  const worker = background(source);
  const busy = (is) => {
    of("start").disabled = is;
    of("cancel").disabled = !is;
  };
  of("start").addEventListener("click", async () => {
    const count = Number(of("count").value);
    busy(true);
    tell(`${count.toLocaleString("en")} points …`);
    try {
      const coords = scatter(count, 540, count);
      const {ours, theirs, counts} = await worker.run({task: "race", coords, runs: count > 200_000 ? 3 : 7}, [coords.buffer]);
      const row = document.createElement("tr");
      for (const text of [count.toLocaleString("en"), `${ours.toFixed(1)} ms`, `${theirs.toFixed(1)} ms`, `${(theirs / ours).toFixed(1)} x`]) {
        row.append(Object.assign(document.createElement("td"), {textContent: text}));
      }
      of("results").append(row);
      tell(`${counts.ours.toLocaleString("en")} triangles; ${navigator.hardwareConcurrency ?? "?"} cores here, one of them used.`);
    } catch (error) {
      if (error.message === "cancelled") tell("Cancelled.");
      else tell(`That did not work: ${error.message}`, true);
    }
    busy(false);
  });
  of("cancel").addEventListener("click", () => worker.giveUp());
}
