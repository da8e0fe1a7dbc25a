// What is below the pointer, in words: beside it while it moves, below the stage once something is chosen.

const short = (number) => String(Number(number.toPrecision(10)));

function angles(corners) {
  const side = (k) => Math.hypot(corners[k][0] - corners[(k + 1) % 3][0], corners[k][1] - corners[(k + 1) % 3][1]);
  const [a, b, c] = [side(0), side(1), side(2)];
  const angle = (opposite, p, q) => (Math.acos(Math.min(Math.max((p * p + q * q - opposite * opposite) / (2 * p * q), -1), 1)) * 180) / Math.PI;
  return Math.min(angle(a, b, c), angle(b, c, a), angle(c, a, b));
}

/** The area of a triangle of shares in units of the coordinates. */
function areaOf([[ax, ay], [bx, by], [cx, cy]], {extent, part}) {
  return (Math.abs((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2) * (extent / part) ** 2;
}

/** What is told last is the last that was asked for: rows may come late. */
let turn = 0;

/** Shows what was found; without anything nothing. */
export async function tellOf(section, loaded, found, pixel, isChosen) {
  const of = (name) => section.querySelector(`#bench-${name}`);
  const tip = of("tip");
  const lines = [];
  const mine = ++turn;
  // In a cell its point is meant, however far away.
  const isCell = found?.area?.name === "cells";
  if (found?.point && (found.isNear || isCell)) {
    const {i, place, height} = found.point;
    lines.push(`point ${i}: ${place.map(short).join(", ")}${height === undefined ? "" : `, height ${short(height)}`}`);
    if (loaded?.names.length === 1) for (const [name, cell] of await loaded.row(i)) lines.push(`${name}: ${cell}`);
  } else if (found?.triangle) {
    const {number, indices} = found.triangle;
    // Degrees are as wide as they are high in the plane of the program.
    const corners = found.triangle.corners.map(([x, y]) => [x / loaded.about.frame.aspect, y]);
    lines.push(`triangle ${number}: ${indices.join(", ")}`, `least angle ${angles(corners).toFixed(1)}°, area ${short(areaOf(corners, loaded.about.frame))}`);
  }
  if (found?.area?.name === "alpha" && !found.isNear) lines.push("inside of the alpha shape");
  if (mine !== turn) return;
  tip.hidden = !lines.length;
  tip.textContent = lines.join("\n");
  if (pixel) {
    const {clientWidth, clientHeight} = of("picture");
    tip.style.left = `${Math.min(pixel[0] + 14, clientWidth - Math.min(220, clientWidth))}px`;
    tip.style.top = `${Math.min(pixel[1] + 14, clientHeight - 60)}px`;
  }
  if (isChosen) of("chosen").textContent = lines.join(" · ");
}
