// The figures in a real browser: each shows something, reacts to pointer and keyboard, survives what is wrong, and says nothing on the console.

import assert from "node:assert/strict";
import {test} from "node:test";
import {open as openPage, useBrowser} from "./browser.mjs";

const sections = ["play", "circle", "one", "voronoi", "location", "steps", "walls", "surface", "race"];

useBrowser();

/** The page with all figures begun. */
async function open(t, options = {}) {
  const page = await openPage(t, options);
  for (const name of sections) {
    await page.locator(`#${name}`).scrollIntoViewIfNeeded();
    await page.waitForSelector(`#${name}[data-ready]`);
  }
  return page;
}

const status = (page, section) => page.locator(`#${section} figcaption`).textContent();

/** How many pixels of a section's canvases are drawn on. */
async function drawn(page, section) {
  const canvases = page.locator(`#${section} canvas`);
  await canvases.first().scrollIntoViewIfNeeded();
  await page.waitForTimeout(300);
  return canvases.evaluateAll((canvases) =>
    canvases.map((canvas) => {
      const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let i = 3; i < data.length; i += 4) count += data[i] > 0;
      return count;
    }),
  );
}

const still = async (page) => {
  if ((await page.getAttribute("#play-motion", "aria-pressed")) === "true") await page.click("#play-motion");
};

test("every figure shows something", async (t) => {
  const page = await open(t);
  for (const section of ["play", "circle", "one", "voronoi", "location", "steps", "walls", "surface"]) {
    for (const count of await drawn(page, section)) assert.ok(count > 2000, `${section}: ${count} pixels`);
    assert.ok((await page.locator(`#${section} .error`).count()) === 0, await status(page, section));
  }
  // A lattice has no wrong edge, and by the other library some when it is turned.
  await page.locator("#one-turn").fill("17");
  await page.waitForFunction(() => /delaunator: \d/.test(document.querySelector("#one figcaption").textContent));
  assert.match(await status(page, "one"), /^Delone: 0 wrong edges\. delaunator: [1-9]\d* wrong edges\.$/);
});

test("points come, go and move, by pointer and by keyboard", async (t) => {
  const page = await open(t);
  await still(page);
  assert.match(await status(page, "play"), /^60 points, \d+ triangles/);
  await page.locator("#play canvas").scrollIntoViewIfNeeded();
  const box = await page.locator("#play canvas").boundingBox();
  const free = [box.x + box.width - 6, box.y + 6];
  await page.mouse.click(...free);
  assert.match(await status(page, "play"), /^61 points/);
  // Dragged away, and then removed.
  await page.mouse.move(...free);
  await page.mouse.down();
  await page.mouse.move(free[0] - 30, free[1] + 4, {steps: 4});
  await page.mouse.up();
  assert.match(await status(page, "play"), /^61 points/);
  await page.keyboard.down("Shift");
  await page.mouse.click(free[0] - 30, free[1] + 4);
  await page.keyboard.up("Shift");
  assert.match(await status(page, "play"), /^60 points/);
  await page.focus("#play canvas");
  await page.keyboard.press("Enter");
  assert.match(await status(page, "play"), /^61 points/);
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("Delete");
  assert.match(await status(page, "play"), /^60 points/);
  await page.keyboard.press("n");
  await page.keyboard.press("Delete");
  assert.match(await status(page, "play"), /^59 points/);
});

test("a long press removes the point below one finger, two short ones remove none", async (t) => {
  const page = await open(t, {hasTouch: true});
  await still(page);
  await page.selectOption("#play-kind", "circle");
  await page.selectOption("#play-count", "3");
  await page.locator("#play canvas").scrollIntoViewIfNeeded();
  const box = await page.locator("#play canvas").boundingBox();
  const points = [0, 1].map((i) => {
    const [turn, radius] = [(2 * Math.PI * i) / 3, 0.45 * box.height];
    return {x: box.x + box.width / 2 + Math.cos(turn) * radius, y: box.y + box.height / 2 + Math.sin(turn) * radius, id: i};
  });
  const client = await page.context().newCDPSession(page);
  const press = async (touchPoints, ms) => {
    await client.send("Input.dispatchTouchEvent", {type: "touchStart", touchPoints});
    await page.waitForTimeout(ms);
    await client.send("Input.dispatchTouchEvent", {type: "touchEnd", touchPoints: []});
    await page.waitForTimeout(800);
    return status(page, "play");
  };
  assert.match(await press(points, 60), /^3 points/);
  assert.match(await press(points.slice(1), 800), /^2 points/);
});

test("degenerate sets are shown, and said to be what they are", async (t) => {
  const page = await open(t);
  await still(page);
  await page.selectOption("#play-kind", "line");
  assert.match(await status(page, "play"), /on a line, which have no triangles/);
  for (const kind of ["grid", "circle"]) {
    await page.selectOption("#play-kind", kind);
    assert.match(await status(page, "play"), /^60 points, \d+ triangles/);
  }
  await page.check("#play-voronoi");
  await page.check("#play-circles");
  await page.selectOption("#play-count", "3");
  assert.match(await status(page, "play"), /^3 points, 1 triangles/);
  await page.focus("#play canvas");
  for (const left of [2, 1, 0]) {
    await page.keyboard.press("n");
    await page.keyboard.press("Delete");
    const text = await status(page, "play");
    assert.match(text, [/^No points/, /^1 point\. One alone/, /^2 points on a line, which have no triangles/][left]);
  }
});

test("a million points, and twenty thousand that move", async (t) => {
  const page = await open(t);
  await still(page);
  await page.selectOption("#play-count", "1000000");
  await page.waitForFunction(() => /^1,000,000 points, 1,99/.test(document.querySelector("#play figcaption").textContent), undefined, {timeout: 60_000});
  await page.selectOption("#play-count", "20000");
  await page.click("#play-motion");
  await page.waitForFunction(() => /frames a second/.test(document.querySelector("#play figcaption").textContent), undefined, {timeout: 60_000});
  t.diagnostic(await status(page, "play"));
  // With so many triangles every tenth pixel and more is covered by an edge.
  const [count] = await drawn(page, "play");
  const box = await page.locator("#play canvas").boundingBox();
  assert.ok(count > box.width * box.height / 10, `${count} pixels`);
  await page.click("#play-motion");
});

/** Draws a line from point to point with the keyboard. */
async function wall(page, ...ends) {
  const canvas = page.locator("#walls canvas");
  await canvas.focus();
  for (const end of ends) {
    for (let i = 0; i < 60; i++) {
      await canvas.press("ArrowRight");
      if ((await status(page, "walls")).startsWith(`Point ${end}.`)) break;
    }
    await canvas.press("Enter");
  }
}

test("cells, constraints, steps, surfaces and location react", async (t) => {
  const page = await open(t);
  const spread = async () => Number(/by (\d+) %/.exec(await status(page, "voronoi"))[1]);
  const first = await spread();
  for (let i = 0; i < 10; i++) await page.click("#voronoi-relax");
  assert.ok((await spread()) < first / 2);
  await page.click("#voronoi-clip");
  await page.locator("#voronoi canvas").scrollIntoViewIfNeeded();
  const box = await page.locator("#voronoi canvas").boundingBox();
  for (const [x, y] of [[0.2, 0.2], [0.8, 0.3], [0.5, 0.9]]) await page.mouse.click(box.x + x * box.width, box.y + y * box.height);
  await page.click("#voronoi-clip");
  assert.equal(await page.locator("#voronoi .error").count(), 0);
  await page.locator("#voronoi-weights").fill("80");
  await page.waitForFunction(() => /^Power cells/.test(document.querySelector("#voronoi figcaption").textContent));

  for (const ends of [[0, 30], [10, 40], [20, 50], [5, 55], [15, 45], [25, 35]]) await wall(page, ...ends);
  await page.check("#walls-split");
  assert.match(await status(page, "walls"), /^Lines: \d+/);
  const before = await status(page, "steps");
  await page.click("#steps-next");
  await page.waitForFunction((text) => document.querySelector("#steps figcaption").textContent !== text, before);
  await page.selectOption("#surface-method", "linear");
  assert.match(await status(page, "surface"), /cells in \d+ ms/);
  await page.locator("#surface canvas").focus();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("+");
  await page.click("#location-again");
  assert.match(await status(page, "location"), /All four found the same/);
});

test("lines that cross are refused alone, and stay split until they are undone", async (t) => {
  const page = await open(t);
  const picture = async () => {
    // Without the cursor of the keyboard.
    await page.evaluate(() => document.activeElement?.blur());
    await drawn(page, "walls");
    return page.locator("#walls canvas").evaluate((canvas) => canvas.toDataURL());
  };
  await page.click("#walls-clear");
  await page.check("#walls-split");
  await wall(page, 0, 30);
  await wall(page, 20, 50);
  const both = /^Lines: 2; edges of them: \d+, 1 new vertices/;
  assert.match(await status(page, "walls"), both);
  const split = await picture();
  // A third line that crosses none, so that the last one is not to blame.
  await wall(page, 10, 40);
  await page.click("#walls-split");
  assert.match(await status(page, "walls"), /^They stay split, for segments 0 and 1 cross near/);
  assert.ok(await page.isChecked("#walls-split"));
  await page.click("#walls-undo");
  assert.match(await status(page, "walls"), both);
  assert.equal(await picture(), split);
  await page.click("#walls-undo");
  const alone = await status(page, "walls");
  assert.match(alone, /^Lines: 1; edges of them: \d+\.$/);
  const one = await picture();
  await page.uncheck("#walls-split");
  assert.equal(await status(page, "walls"), alone);
  await wall(page, 20, 50);
  assert.match(await status(page, "walls"), /^Refused: segments 0 and 1 cross near/);
  assert.equal(await picture(), one);
  await page.click("#walls-undo");
  assert.match(await status(page, "walls"), /^Lines: 0;/);
});

test("a polygon that is being drawn is forgotten by a new beginning", async (t) => {
  const page = await open(t);
  await page.click("#voronoi-clip");
  await page.click("#voronoi-reset");
  assert.equal(await page.getAttribute("#voronoi-clip", "aria-pressed"), "false");
  await page.locator("#voronoi canvas").click();
  await page.click("#voronoi-clip");
  assert.match(await status(page, "voronoi"), /^Tap the corners/);
  await page.locator("#voronoi canvas").click();
  await page.click("#voronoi-clip");
  assert.match(await status(page, "voronoi"), /needs three corners/);
});

/** Presses a button, or chooses a value, in the very moment that a figure says something. */
const whenSaid = (page, section, pattern, control, value) =>
  page.evaluate(
    ([section, source, control, value]) => {
      const status = document.querySelector(`#${section} figcaption`);
      const observer = new MutationObserver(() => {
        if (!new RegExp(source).test(status.textContent)) return;
        observer.disconnect();
        const element = document.querySelector(control);
        if (value === undefined) return element.click();
        element.value = value;
        element.dispatchEvent(new Event("change"));
      });
      observer.observe(status, {childList: true});
    },
    [section, pattern.source, control, value],
  );

test("figures that work at the same time all come to their end", async (t) => {
  const page = await open(t);
  await still(page);
  const says = (section, pattern) =>
    page.waitForFunction(
      ([section, source]) => new RegExp(source).test(document.querySelector(`#${section} figcaption`).textContent),
      [section, pattern.source],
      {timeout: 60_000},
    );
  await page.selectOption("#race-count", "100000");
  await page.click("#race-start");
  await page.selectOption("#play-count", "1000000");
  await says("play", /^1,000,000 points, 1,99/);
  await says("race", /^\d+,\d+ triangles/);
  // Who changes his mind gives up his own work only.
  await page.click("#race-start");
  await page.selectOption("#play-count", "1000000");
  await whenSaid(page, "play", /triangulating/, "#play-count", "3");
  await page.selectOption("#play-count", "1000000");
  await says("play", /^3 points/);
  assert.ok(await page.isEnabled("#play-motion"));
  await says("race", /^\d+,\d+ triangles/);
});

test("the race is run, and can be cancelled", async (t) => {
  const page = await open(t);
  await page.selectOption("#race-count", "10000");
  await page.click("#race-start");
  await page.waitForSelector("#race-results tr", {timeout: 60_000});
  assert.match(await page.locator("#race-results tr").textContent(), /10,000.* ms.* ms.* x/);
  await page.selectOption("#race-count", "1000000");
  await page.click("#race-start");
  await page.click("#race-cancel");
  assert.equal(await status(page, "race"), "Cancelled.");
});

test("narrow, dark and calm", async (t) => {
  const page = await open(t, {viewport: {width: 320, height: 640}, colorScheme: "dark", reducedMotion: "reduce", hasTouch: true});
  assert.equal(await page.getAttribute("#play-motion", "aria-pressed"), "false");
  const [scroll, width] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
  assert.ok(scroll <= width, `${scroll} wide in a window of ${width}`);
  assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), "rgb(20, 23, 26)");
  for (const section of ["play", "voronoi", "surface"]) {
    for (const count of await drawn(page, section)) assert.ok(count > 1000, `${section}: ${count} pixels`);
  }
  const small = await page.locator("button, select, .button").evaluateAll((all) => all.filter((item) => item.checkVisibility() && item.getBoundingClientRect().height < 44).length);
  assert.equal(small, 0, "targets are 44 pixels high");
  // With three points there is room in one of the corners.
  await page.selectOption("#play-count", "3");
  for (const position of [{x: 3, y: 3}, {x: 280, y: 3}, {x: 3, y: 155}, {x: 280, y: 155}]) {
    await page.locator("#play canvas").tap({position});
  }
  assert.match(await status(page, "play"), /^[4-7] points/);
  await page.setViewportSize({width: 900, height: 700});
  for (const count of await drawn(page, "play")) assert.ok(count > 2000);
});

test("numbers in the text change figures by dragging and by keys", async (t) => {
  const page = await open(t);
  const number = page.locator("#circle .number");
  await number.scrollIntoViewIfNeeded();
  const of = async () => Number(/of (\d+):/.exec(await status(page, "circle"))[1]);
  const before = await of();
  await number.focus();
  await page.keyboard.press("PageUp");
  assert.equal(await number.textContent(), "50");
  assert.equal((await of()) - before, 20 - ((await number.getAttribute("aria-valuenow")) - 50));
  const box = await number.boundingBox();
  await page.mouse.move(box.x + 5, box.y + 5);
  await page.mouse.down();
  await page.mouse.move(box.x + 405, box.y + 5, {steps: 3});
  await page.mouse.up();
  assert.equal(await number.textContent(), "150");
});

test("all figures can be used by touch, and by keys", async (t) => {
  const page = await open(t, {viewport: {width: 390, height: 844}, hasTouch: true, reducedMotion: "reduce"});
  const changes = async (section, act) => {
    const before = await status(page, section);
    await act();
    await page.waitForFunction(([section, before]) => document.querySelector(`#${section} figcaption`).textContent !== before, [section, before]);
  };
  const tap = (section, x, y) => page.locator(`#${section} canvas`).first().tap({position: {x, y}});
  await changes("circle", () => tap("circle", 120, 90));
  await changes("location", () => tap("location", 60, 50).then(() => page.locator("#location canvas").first().press("Enter")).then(() => tap("location", 1, 1)));
  await tap("surface", 100, 80);
  const surface = () => page.locator("#surface canvas").evaluate((canvas) => canvas.toDataURL());
  for (const button of ["raise", "lower"]) {
    const before = await surface();
    await page.tap(`#surface-${button}`);
    await page.waitForTimeout(300);
    assert.notEqual(await surface(), before);
  }
  // On a telephone most places between sixty points take a new one.
  await page.selectOption("#play-kind", "grid");
  await page.locator("#play canvas").scrollIntoViewIfNeeded();
  for (let k = 0; k < 24; k++) await tap("play", 15 + ((k * 83) % 320), 12 + ((k * 47) % 170));
  const inserted = Number(/^(\d+) points/.exec(await status(page, "play"))[1]) - 60;
  assert.ok(inserted >= 14, `${inserted} of 24 taps insert`);
  // A line that is begun and left, and a polygon by keys.
  const walls = page.locator("#walls canvas");
  await walls.focus();
  for (const [key, pattern] of [["ArrowRight", /^Point \d+\. Enter begins/], ["Enter", /^A line begins at point \d+/], ["Escape", /^No line was drawn/]]) {
    await page.keyboard.press(key);
    assert.match(await status(page, "walls"), pattern);
  }
  await page.click("#voronoi-clip");
  await page.locator("#voronoi canvas").focus();
  for (const key of ["Enter", "ArrowRight", "ArrowRight", "Enter", "ArrowDown", "ArrowDown", "Enter"]) await page.keyboard.press(key);
  await page.click("#voronoi-clip");
  assert.match(await status(page, "voronoi"), /^Cells are cut by your polygon of 3 corners/);
});

test("more points than are changed one by one in motion are changed at rest, and cells are drawn or said not to be", async (t) => {
  const page = await open(t);
  await still(page);
  await page.selectOption("#play-count", "20000");
  const box = await page.locator("#play canvas").boundingBox();
  await page.locator("#play canvas").scrollIntoViewIfNeeded();
  await page.locator("#play canvas").click({position: {x: box.width - 3, y: 3}});
  assert.match(await status(page, "play"), /^20,001 points/);
  await page.locator("#play-delaunay").uncheck();
  await page.locator("#play-hull").uncheck();
  await page.check("#play-voronoi");
  assert.match(await status(page, "play"), /Voronoi cells are drawn at rest, of at most 20,000 points/);
  await page.selectOption("#play-count", "1000");
  const [count] = await drawn(page, "play");
  assert.ok(count > 5000, `${count} pixels`);
});

test("the points of the workbench are compared, and code is copied", async (t) => {
  const page = await open(t, {hash: "#set=tenth-grid&n=400&seed=1&views=triangles"});
  await page.waitForSelector("#one-yours:enabled");
  assert.match(await status(page, "one"), /^Delone: 0 wrong edges\. delaunator: [1-9]\d* wrong edges/);
  await page.click("#one-yours");
  assert.match(await status(page, "one"), /^Delone: 0 wrong edges\. delaunator: \d+ wrong edges/);
  await page.click("#one .code summary");
  await page.click("#one .code button");
  await page.waitForFunction(() => document.querySelector("#one .code [role=status]").textContent === "Copied.");
});
