// The explorer in a browser: what a user does, held against what the library says.
//
// node explore.mjs [PICTURES]   needs the program (target/release/assur, or ASSUR) and Chromium (/usr/bin/chromium, or CHROMIUM); with a folder it leaves screenshots there.
// ONLY=words takes the tests with these words in their names; ALONE=1 holds the figures of a machine that does nothing else. With WEB=../../web the page's files are taken from there and not from the program: to try a change without building.

import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";

const PROGRAM = process.env.ASSUR ?? new URL("../../target/release/assur", import.meta.url).pathname;
const PICTURES = process.argv[2];
const folder = mkdtempSync(join(tmpdir(), "assur-web-"));

// Whatever ends the tests ends the servers as well.
const servers = new Set();
process.on("exit", () => servers.forEach((child) => child.kill("SIGKILL")));
for (const signal of ["SIGTERM", "SIGINT"]) process.on(signal, () => process.exit(1));

/** Starts an explorer; resolves with its address and how to stop it. */
function explorer(...given) {
  const child = spawn(PROGRAM, ["explore", "--no-open", ...given], { stdio: ["ignore", "pipe", "inherit"] });
  servers.add(child);
  return new Promise((resolve, reject) => {
    child.once("exit", () => reject(new Error("the explorer did not start")));
    child.stdout.once("data", (line) => resolve({ address: String(line).trim(), stop: () => new Promise((gone) => { child.once("exit", gone); child.kill("SIGKILL"); }) }));
  });
}

/** What the command line says of a model file and inputs, those in radians. */
function forwardFile(file, inputs, actuators) {
  const degrees = /"?angle_unit"? ?[=:] ?"deg"/.test(readFileSync(file, "utf8"));
  const given = inputs.map((q, k) => (degrees && actuators[k].angle ? (q * 180) / Math.PI : q));
  return JSON.parse(execFileSync(PROGRAM, ["forward", file, `--inputs=${given.join(",")}`, "--json"], { encoding: "utf8" }));
}
/** What it says of what a page shows. */
async function forward(page) {
  const { model, inputs } = await state(page);
  const file = join(folder, "held.json");
  writeFileSync(file, JSON.stringify(model));
  return forwardFile(file, inputs, (await answer(page)).actuators);
}

const flags = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"];
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: flags, timeout: 60_000 });
setTimeout(() => { console.log("FAIL  the tests take too long"); process.exit(1); }, 400_000).unref();
const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, acceptDownloads: true, colorScheme: "light" });
if (process.env.WEB) {
  // The page itself comes from the server, or the browser would not let it ask there.
  const kinds = { js: "text/javascript", css: "text/css" };
  await context.route(/\/[^/]*$/, (route) => {
    const name = new URL(route.request().url()).pathname.split("/").pop() ?? "";
    const kind = kinds[name.split(".").pop()];
    return kind ? route.fulfill({ path: join(process.env.WEB, name), contentType: kind }) : route.continue();
  });
}
let server = await explorer();

const errors = [];
async function open(address) {
  const page = await context.newPage();
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("console", (message) => message.type() === "error" && !/WebSocket|ERR_CONNECTION_REFUSED/.test(message.text()) && errors.push(message.text()));
  await page.goto(address);
  page.setDefaultTimeout(15_000);
  await page.waitForFunction(() => globalThis.assur?.page?.answer);
  await settled(page);
  return page;
}
const settled = (page) => page.evaluate(async () => {
  // A way to another page, or a step of undo, puts a new page in the old one's place.
  await globalThis.assur.ways.settled();
  await globalThis.assur.page.moves.settled();
  if (globalThis.assur.page.slow) await globalThis.assur.page.slow.settled();
  // Drawn with the frame after the answer.
  await new Promise((go) => requestAnimationFrame(() => requestAnimationFrame(go)));
});
const state = (page) => page.evaluate(() => JSON.parse(JSON.stringify(globalThis.assur.page.state)));
const answer = (page) => page.evaluate(() => JSON.parse(JSON.stringify(globalThis.assur.page.answer)));
const ghosts = (page) => page.locator("#stage .ghosts .ghost").count();
const solid = (page) => page.locator("#stage .front .held-mode").count();
const picture = (page, name) => (PICTURES ? page.screenshot({ path: join(PICTURES, `${name}.png`) }) : null);
const middle = async (page, key) => {
  const box = await page.locator(`#stage [data-key="${key}"] .reach`).boundingBox();
  return [box.x + box.width / 2, box.y + box.height / 2];
};
async function drag(page, key, dx, dy, steps = 12) {
  const [x, y] = await middle(page, key);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + dy, { steps });
  await page.mouse.up();
  await settled(page);
}

async function startFrom(page, family) {
  // A new page takes this one's place.
  await page.evaluate(() => { globalThis.assur.page.answer = null; });
  await page.selectOption("#family", family);
  await page.waitForFunction((name) => globalThis.assur.page.answer?.model?.name === `A ${name.replaceAll(",", ", ")} to start from`, family);
  await settled(page);
}

const tests = {
  async "opens with all six modes, one of them held"(page) {
    assert.equal(await ghosts(page), 5);
    assert.equal(await solid(page), 1);
    await picture(page, "open");
  },

  async "a dragged pivot changes the modes as the library says"(page) {
    for (const [dx, dy] of [[60, -40], [-130, 30], [90, 70]]) {
      await drag(page, "base:2", dx, dy);
      const report = await forward(page);
      assert.equal((await ghosts(page)) + (await solid(page)), report.modes.length);
      const shown = (await answer(page)).report.modes.map((mode) => mode.pose);
      report.modes.forEach((mode, k) => mode.pose.forEach((v, axis) => assert.ok(Math.abs(v - shown[k][axis]) < 1e-9)));
    }
    await picture(page, "dragged");
  },

  async "undo and redo lead back and forth"(page) {
    const texts = [JSON.stringify((await state(page)).model)];
    for (let k = 0; k < 3; k++) {
      await page.keyboard.press("Control+z");
      await settled(page);
      await page.waitForFunction((old) => JSON.stringify(globalThis.assur.page.state.model) !== old, texts[texts.length - 1]);
      texts.push(JSON.stringify((await state(page)).model));
    }
    assert.equal(await ghosts(page), 5);
    await page.keyboard.press("Control+Shift+z");
    await settled(page);
    assert.equal(JSON.stringify((await state(page)).model), texts[2]);
    await page.keyboard.press("Control+z");
    await settled(page);
    assert.equal(JSON.stringify((await state(page)).model), texts[3]);
  },

  async "the platform is pulled by inverse kinematics, and stays one of the modes"(page) {
    await drag(page, "pose", 40, -25);
    const { mode } = await state(page);
    assert.ok((await forward(page)).modes.some((found) => found.pose.every((v, k) => Math.abs(v - mode.pose[k]) < 1e-6)));
    await drag(page, "turn", 10, 30);
    assert.notEqual((await state(page)).mode.pose[2], mode.pose[2]);
  },

  async "keys take another mode and move a handle"(page) {
    await page.keyboard.press("2");
    await settled(page);
    assert.equal((await answer(page)).current, 1);
    const before = (await state(page)).model.leg[1].base.at;
    await page.locator('#stage [data-key="base:1"]').focus();
    await page.keyboard.press("ArrowRight");
    await settled(page);
    const after = (await state(page)).model.leg[1].base.at;
    assert.ok(after[0] > before[0] && after[1] === before[1]);
  },

  async "an actuator's number is taken, and a wrong one keeps the last good state"(page) {
    const field = page.getByLabel("Actuator 1, number");
    await field.fill("15.2");
    await field.press("Enter");
    await settled(page);
    assert.equal((await state(page)).inputs[0], 15.2);
    await page.click("#edit");
    const text = await page.inputValue("#editor-text");
    await page.fill("#editor-text", text.replace('joints = "R_P_R"', 'joints = "R_Q_R"'));
    await page.click("#editor-apply");
    await page.waitForFunction(() => document.getElementById("editor-error").textContent.includes("unknown joint letter"));
    await page.click("#editor-close");
    assert.equal((await state(page)).inputs[0], 15.2);
  },

  async "where a mode ends it is said, and pulling back finds it again"(page) {
    await startFrom(page, "3-RPR");
    const pull = (value) => page.evaluate(async (value) => {
      const { page } = globalThis.assur;
      page.pull({ handle: "input", number: 0, value });
      await page.moves.settled();
      return { current: page.answer.current, event: page.answer.event?.kind, pose: page.state.mode?.pose, start: page.anchor.inputs[0] };
    }, value);
    const start = await page.evaluate(() => globalThis.assur.page.state.inputs[0]);
    const before = await pull(start);
    const beyond = await pull(start * 6);
    assert.equal(beyond.current, null);
    assert.equal(beyond.event, "meeting");
    await settled(page);
    assert.ok(await page.locator("#notice").isVisible());
    assert.ok((await page.locator("#stage .over .meeting").count()) > 0);
    await picture(page, "meeting");
    const back = await pull(start);
    back.pose.forEach((v, k) => assert.ok(Math.abs(v - before.pose[k]) < 1e-9));
    assert.ok(!(await page.locator("#notice").isVisible()));
    await page.evaluate(() => globalThis.assur.page.drop());
  },

  async "workspaces of all kinds, as the library says, redrawn while dragging"(page) {
    await startFrom(page, "3-RPR");
    await page.selectOption("#workspace", "maximal");
    await page.waitForSelector("#bound");
    assert.match(await page.textContent(".panel p.bad"), /no limits/);
    await page.click("#bound");
    await page.waitForSelector("#stage .region");
    // A strut's own limits, typed; its actuator stood beyond them.
    for (const [end, value] of [["lower", "4.5"], ["upper", "15"]]) {
      for (let k = 1; k <= 3; k++) await page.getByLabel(`Actuator ${k}, ${end} limit`).fill(value);
    }
    await page.getByLabel("Actuator 3, lower limit").press("Enter");
    await settled(page);
    const limited = await state(page);
    assert.deepEqual(limited.model.leg.map((leg) => Object.values(leg.limits).flat()), Array(3).fill([4.5, 15]));
    assert.equal(limited.inputs[2], 4.5);
    await page.setInputFiles("#file", new URL("../../examples/workspaces/five-kinds.toml", import.meta.url).pathname);
    await page.waitForFunction(() => globalThis.assur.page.answer?.model.name === "3-RPR with a small platform");
    await settled(page);
    const { model, mode } = await state(page);
    const range = [-Math.PI / 4, Math.PI / 4];
    await page.evaluate(([from, to]) => Object.assign(globalThis.assur.page.state.workspace, { from, to }), range);
    const degrees = (v) => (v * 180) / Math.PI;
    const given = { constant: [`--phi=${degrees(mode.pose[2])}`], inclusive: range.map((v, k) => `--${["from", "to"][k]}=${degrees(v)}`) };
    given.total = given.inclusive;
    const file = join(folder, "held.json");
    writeFileSync(file, JSON.stringify(model));
    for (const kind of ["constant", "inclusive", "total", "dextrous", "maximal"]) {
      await page.selectOption("#workspace", kind);
      await settled(page);
      const { workspace } = await answer(page);
      const report = JSON.parse(execFileSync(PROGRAM, ["workspace", file, kind, ...(given[kind] ?? []), "--json"], { encoding: "utf8" }));
      assert.equal(workspace.error, undefined, kind);
      assert.equal(workspace.kind, kind);
      assert.ok(Math.abs(report.area - workspace.area) <= 1e-9 * report.area, `${kind}: ${workspace.area}, not ${report.area}`);
      assert.ok(report.area > 1 && (await page.locator("#stage .region").count()) === 1, kind);
      // What is drawn has that area, but for the chords.
      const drawn = workspace.loops.flatMap((points) => points.map(([x, y], k) => { const [u, v] = points[(k + 1) % points.length]; return (x * v - u * y) / 2; })).reduce((sum, part) => sum + part, 0);
      assert.ok(Math.abs(drawn - report.area) <= 4e-3 * report.area, `${kind}: drawn ${drawn} of ${report.area}`);
      await picture(page, `workspace-${kind}`);
    }
    const before = (await answer(page)).workspace.area;
    const seen = await page.evaluate(() => document.querySelector("#stage .region").getAttribute("d"));
    await drag(page, "base:1", 30, 10);
    assert.notEqual((await answer(page)).workspace.area, before);
    assert.notEqual(await page.evaluate(() => document.querySelector("#stage .region").getAttribute("d")), seen);
    await page.evaluate(() => { document.documentElement.dataset.theme = "dark"; });
    await picture(page, "workspace-dark");
    await page.evaluate(() => { document.documentElement.dataset.theme = "light"; });
  },

  async "the roots, and the plane of two actuators"(page) {
    const { report, inputs } = await answer(page);
    assert.equal(await page.locator(".plot .real").count(), report.modes.length);
    assert.equal(await page.locator(".plot .cross").count(), report.complex.length);
    const plane = await page.evaluate(() => globalThis.assur.page.plane.plane);
    const cell = plane.pair.map((input, k) => Math.min(plane.size[k] - 1, Math.floor(((inputs[input] - plane.low[k]) / (plane.high[k] - plane.low[k])) * plane.size[k])));
    // Where the counts around are the same as in the cell, it is that of the point.
    const count = (column, row) => Number(plane.counts[row * plane.size[0] + column]);
    const around = [-1, 0, 1].flatMap((i) => [-1, 0, 1].map((j) => count(...[cell[0] + i, cell[1] + j].map((v, k) => Math.min(plane.size[k] - 1, Math.max(0, v))))));
    if (around.every((n) => n === around[0])) assert.equal(around[0], report.modes.length);
    assert.ok(await page.locator(".plane-area .here").isVisible());
    const canvas = page.locator(".plane-area canvas");
    await canvas.scrollIntoViewIfNeeded();
    const box = await canvas.boundingBox();
    await page.mouse.click(box.x + 0.5 * box.width, box.y + 0.5 * box.height, { button: "right" });
    await settled(page);
    assert.deepEqual((await state(page)).inputs, inputs);
    await page.mouse.click(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
    await settled(page);
    const after = (await state(page)).inputs;
    assert.ok(after[0] !== inputs[0] && after[1] !== inputs[1] && after[2] === inputs[2]);
    await picture(page, "plane");
  },

  async "slider axes and platform points are pulled"(page) {
    for (const [family, key] of [["3-PRR", "base_axis:0"], ["3-RRP", "platform_axis:1"], ["3-RPR", "platform:2"], ["3-PPR", "middle_axis:0"], ["3-RPP", "middle_axis:2"]]) {
      await startFrom(page, family);
      const before = (await state(page)).model.leg;
      await drag(page, key, 14, 9);
      const after = (await state(page)).model.leg;
      const leg = Number(key.at(-1));
      const part = key.startsWith("base") ? "base" : key.startsWith("middle") ? "links" : "platform";
      assert.notDeepEqual(after[leg][part], before[leg][part], key);
      if (part === "links") await picture(page, `middle-${family}`);
      after.forEach((other, k) => k !== leg && assert.deepEqual(other, before[k], key));
      const report = await forward(page);
      assert.deepEqual((await answer(page)).report.modes.map((mode) => mode.signs), report.modes.map((mode) => mode.signs));
    }
  },

  async "the platform keeps within limits"(page) {
    await startFrom(page, "3-RPR");
    await page.evaluate(async () => {
      const { page } = globalThis.assur;
      for (const [number, q] of page.state.inputs.entries()) {
        page.pull({ handle: "limits", number, range: [q - 0.5, q + 0.5] }, true);
        await page.moves.settled();
      }
    });
    const { model } = await state(page);
    await drag(page, "pose", 220, 40);
    const { inputs } = await state(page);
    model.leg.forEach(({ limits }, k) => {
      const [low, high] = Object.values(limits)[0];
      assert.ok(inputs[k] >= low - 1e-9 && inputs[k] <= high + 1e-9);
    });
    assert.match(await page.textContent("#notice"), /limit/);
  },

  async "singular positions and a proof"(page) {
    await startFrom(page, "3-RPR");
    await page.keyboard.press("l");
    await settled(page);
    await page.click("#prove");
    await page.waitForSelector(".panel .tag.good");
    assert.match(await page.textContent(".panel .tag.good"), /complete/);
    assert.ok((await page.locator("#stage .locus-2, #stage .locus-1").count()) > 0);
    await picture(page, "singular");
    await page.reload();
    await page.waitForFunction(() => globalThis.assur?.page?.answer);
    await settled(page);
    assert.equal(await page.textContent("#loci"), "hide");
    await page.keyboard.press("l");
    assert.equal(await page.textContent("#loci"), "show");
  },

  async "every family opens"(page) {
    const families = await page.locator("#family option").evaluateAll((options) => options.map((option) => option.value).filter(Boolean));
    assert.ok(families.length >= 8);
    for (const family of families) {
      await startFrom(page, family);
      assert.equal((await ghosts(page)) + (await solid(page)), (await forward(page)).modes.length, family);
      assert.equal(await solid(page), 1, family);
      if (["3-RRR", "3-PRR", "3-RRP"].includes(family)) await picture(page, `family-${family}`);
    }
  },

  async "no command is lost beside a drag, and each is done in its turn"(page) {
    await startFrom(page, "3-RPR");
    const done = await page.evaluate(async () => {
      const { page, history } = globalThis.assur;
      const [start, steps] = [page.state.inputs[0], history.past.length];
      const other = page.answer.report.modes.findIndex((_, k) => k !== page.answer.current);
      const tone = page.tones[other];
      let asked = 0;
      const ask = page.app.connection.ask;
      page.app.connection.ask = function (kind, question) { asked += kind === "move"; return ask.call(this, kind, question); };
      page.grab("base:2");
      const { at } = page.state.model.leg[2].base;
      for (let k = 1; k <= 20; k++) page.pull({ handle: "base", leg: 2, to: [at[0] + 0.001 * k, at[1]] });
      page.drop();
      page.hold(other);
      page.pull({ handle: "limits", number: 1, range: [1, 40] }, true);
      page.pull({ handle: "input", number: 0, value: start + 0.01 }, true);
      await page.moves.settled();
      page.app.connection.ask = ask;
      return { asked, base: page.state.model.leg[2].base.at[0] - at[0], tone, held: page.tones[page.answer.current], limits: Object.values(page.state.model.leg[1].limits ?? {})[0], input: page.state.inputs[0] - start, steps: history.past.length - steps };
    });
    assert.ok(Math.abs(done.base - 0.02) < 1e-12 && Math.abs(done.input - 0.01) < 1e-12, JSON.stringify(done));
    assert.deepEqual([done.limits, done.held, done.steps], [[1, 40], done.tone, 4]);
    // Of the twenty steps the first and the last were asked for.
    assert.equal(done.asked, 5);
  },

  async "a mode that has ended is found again when it is pulled back later"(page) {
    await startFrom(page, "3-RPR");
    const [before, start] = await page.evaluate(() => [globalThis.assur.page.state.mode, globalThis.assur.page.state.inputs[0]]);
    const field = page.getByLabel("Actuator 1, number");
    const type = async (value) => {
      await field.fill(String(value));
      await field.press("Enter");
      await settled(page);
    };
    await type(start * 6);
    assert.equal((await state(page)).mode, null);
    assert.match(await page.textContent("#notice"), /Pull back/);
    assert.match(await page.textContent("#panels"), /no mode is heldthere is none/);
    await type(start);
    const { mode } = await state(page);
    mode.pose.forEach((v, k) => assert.ok(Math.abs(v - before.pose[k]) < 1e-9));
  },

  async "numbers that are refused go back and are marked"(page) {
    await startFrom(page, "3-RPR");
    const limit = (end) => page.getByLabel(`Actuator 1, ${end} limit`);
    await limit("lower").fill("5");
    await limit("lower").press("Enter");
    assert.match(await page.textContent("#message"), /two ends/);
    await limit("upper").fill("30");
    await limit("upper").press("Enter");
    await settled(page);
    assert.deepEqual(Object.values((await state(page)).model.leg[0].limits)[0], [5, 30]);
    // What is typed while another number is asked for stays.
    const typed = await page.evaluate(async () => {
      const [lower, upper] = ["lower", "upper"].map((end) => document.querySelector(`[aria-label="Actuator 1, ${end} limit"]`));
      const type = (field, text) => {
        field.value = text;
        field.dispatchEvent(new Event("input"));
      };
      type(lower, "6");
      lower.dispatchEvent(new Event("change"));
      type(upper, "29");
      type(lower, "5");
      await globalThis.assur.page.moves.settled();
      await new Promise((go) => requestAnimationFrame(() => requestAnimationFrame(go)));
      const kept = [lower.value, upper.value];
      type(upper, "30");
      upper.dispatchEvent(new Event("change"));
      await globalThis.assur.page.moves.settled();
      return kept;
    });
    assert.deepEqual(typed, ["5", "29"]);
    assert.deepEqual(Object.values((await state(page)).model.leg[0].limits)[0], [5, 30]);
    await limit("lower").fill("31");
    await limit("lower").press("Enter");
    await page.waitForFunction(() => document.getElementById("message").textContent.includes("must not decrease"));
    assert.deepEqual([await limit("lower").inputValue(), await limit("lower").getAttribute("aria-invalid")], ["5", "true"]);
    const field = page.getByLabel("Actuator 1, number");
    const before = await field.inputValue();
    await field.fill("31");
    await field.press("Enter");
    await page.waitForFunction(() => document.getElementById("message").textContent.includes("outside limits"));
    assert.deepEqual([await field.inputValue(), await field.getAttribute("aria-invalid")], [before, "true"]);
    await picture(page, "refused");
    await field.fill("12");
    await field.press("Enter");
    await settled(page);
    assert.equal(await field.getAttribute("aria-invalid"), null);
    assert.equal((await state(page)).inputs[0], 12);
  },

  async "the plate is a handle, other buttons are none, and keys that repeat are one step"(page) {
    await startFrom(page, "3-RPR");
    const corners = await page.evaluate(() => globalThis.assur.page.answer.drawings[globalThis.assur.page.answer.current].find((mark) => mark.mark === "body").at.map((p) => globalThis.assur.stage.place(p)));
    const box = await page.locator("#stage").boundingBox();
    // Inside, off the middle and its handle.
    const [x, y] = [0, 1].map((k) => 0.6 * corners[0][k] + 0.2 * corners[1][k] + 0.2 * corners[2][k]);
    const before = await state(page);
    const centre = await page.evaluate(() => globalThis.assur.stage.centre);
    const pull = async (button) => {
      await page.mouse.move(box.x + x, box.y + y);
      await page.mouse.down({ button });
      await page.mouse.move(box.x + x + 8, box.y + y + 5, { steps: 3 });
      await page.mouse.up({ button });
      await settled(page);
    };
    await pull("right");
    assert.deepEqual([await state(page), await page.evaluate(() => globalThis.assur.stage.centre)], [before, centre]);
    await pull("left");
    assert.notDeepEqual((await state(page)).mode.pose, before.mode.pose);
    assert.deepEqual(await page.evaluate(() => globalThis.assur.stage.centre), centre);
    assert.equal(await page.locator("#hint").isVisible(), false);
    const steps = () => page.evaluate(() => globalThis.assur.history.past.length);
    const at = await steps();
    await page.locator('#stage [data-key="base:1"]').focus();
    for (let k = 0; k < 5; k++) await page.keyboard.down("ArrowRight");
    await page.keyboard.up("ArrowRight");
    await settled(page);
    assert.equal(await steps(), at + 1);
    await page.getByLabel("Actuator 1", { exact: true }).focus();
    for (let k = 0; k < 5; k++) await page.keyboard.down("ArrowRight");
    await page.keyboard.up("ArrowRight");
    await settled(page);
    assert.equal(await steps(), at + 2);
    // A button that has the focus keeps it.
    await page.locator("#panels .modes button").nth(1).focus();
    await page.keyboard.press("Enter");
    await settled(page);
    assert.ok(await page.evaluate(() => document.activeElement === document.querySelectorAll("#panels .modes button")[1]));
  },

  async "numbers follow when the hand holds still"(page) {
    await startFrom(page, "3-RPR");
    const value = await page.evaluate(async () => {
      const { page } = globalThis.assur;
      const start = page.state.inputs[0];
      const field = document.querySelector('[aria-label="Actuator 1, number"]');
      for (let k = 1; k <= 50; k++) {
        page.pull({ handle: "input", number: 0, value: start + 0.001 * k });
        await page.moves.settled();
        await new Promise((go) => requestAnimationFrame(() => requestAnimationFrame(go)));
        // Held still just when the numbers are behind.
        if (k > 1 && Math.abs(field.valueAsNumber - page.state.inputs[0]) > 5e-4) return page.state.inputs[0];
      }
      return null;
    });
    assert.notEqual(value, null);
    await page.waitForFunction((value) => Math.abs(document.querySelector('[aria-label="Actuator 1, number"]').valueAsNumber - value) < 1e-5, value, { timeout: 2000 });
    await page.evaluate(() => globalThis.assur.page.drop());
  },

  async "a proof is shown of what was proved only"(page) {
    await startFrom(page, "3-RPR");
    await page.evaluate(async () => {
      const { page, connection } = globalThis.assur;
      const { ask } = connection;
      // A proof that takes its time.
      connection.ask = async function (...asked) {
        const answer = await ask.apply(this, asked);
        if (asked[0] === "prove") await new Promise((go) => setTimeout(go, 300));
        return answer;
      };
      const proof = page.prove();
      connection.ask = ask;
      page.pull({ handle: "input", number: 0, value: page.state.inputs[0] + 0.1 }, true);
      await Promise.all([proof, page.moves.settled()]);
    });
    await settled(page);
    assert.equal(await page.evaluate(() => globalThis.assur.page.proof.textContent), "");
  },

  async "angles are shown within their range, single points and empty workspaces are named"(page) {
    await startFrom(page, "3-RRP");
    const slider = page.getByLabel("Actuator 2", { exact: true });
    assert.ok(Number(await slider.inputValue()) < -170);
    assert.ok(await page.locator(".plane-area .here").isVisible());
    await startFrom(page, "3-RPR");
    await page.evaluate(() => globalThis.assur.page.pull({ handle: "bound" }, true));
    await settled(page);
    await page.selectOption("#workspace", "dextrous");
    await settled(page);
    const { workspace } = await answer(page);
    if (workspace.loops.length === 0 && workspace.isolated.length === 0) assert.match(await page.textContent("#panels"), /Empty/);
    await page.evaluate(() => {
      const { page } = globalThis.assur;
      Object.assign(page.region, { loops: [], separating: [], isolated: [[1, 2]], area: 0, perimeter: 0, components: 0, holes: 0 });
      page.draw();
    });
    assert.match(await page.textContent("#panels"), /1 single point\./);
    assert.equal(await page.locator("#stage .region-point").count(), 1);
    await page.selectOption("#workspace", "");
    await settled(page);
  },

  async "a workspace that takes long keeps no drag waiting"(page) {
    await page.setInputFiles("#file", new URL("../../examples/workspaces/five-kinds.toml", import.meta.url).pathname);
    await page.waitForFunction(() => globalThis.assur.page.answer?.model?.name === "3-RPR with a small platform");
    await page.selectOption("#workspace", "maximal");
    await settled(page);
    const asked = await page.evaluate(async () => {
      const { page, connection } = globalThis.assur;
      const [ask, kinds] = [connection.ask, []];
      connection.ask = function (kind, question) {
        kinds.push(kind === "move" ? `move ${question.workspace?.kind ?? "alone"}` : kind);
        return ask.call(this, kind, question);
      };
      const { at } = page.state.model.leg[2].base;
      const step = async (k) => {
        page.pull({ handle: "base", leg: 2, to: [at[0] + 0.01 * k, at[1]] });
        await page.moves.settled();
      };
      await step(1);
      page.regionTime = 1000;
      await step(2);
      const without = page.region === null;
      await page.drop();
      await page.slow.settled();
      connection.ask = ask;
      return { kinds, without, again: page.region !== null, area: page.answer.workspace.area };
    });
    assert.deepEqual([asked.without, asked.again], [true, true]);
    assert.deepEqual(asked.kinds.filter((kind) => /move|workspace/.test(kind)), ["move maximal", "move alone", "workspace"]);
    const { model } = await state(page);
    const file = join(folder, "held.json");
    writeFileSync(file, JSON.stringify(model));
    const report = JSON.parse(execFileSync(PROGRAM, ["workspace", file, "maximal", "--json"], { encoding: "utf8" }));
    assert.ok(Math.abs(report.area - asked.area) <= 1e-9 * report.area);
    // All is shown with its workspace.
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press("f");
    assert.ok(await page.evaluate(() => {
      const { stage, page } = globalThis.assur;
      return page.region.loops.flat().every((point) => stage.place(point).every((v, axis) => v > 0 && v < stage.extent[axis]));
    }));
    await page.selectOption("#workspace", "");
    await settled(page);
  },

  async "what is refused leaves the page as it is"(page) {
    await startFrom(page, "3-RRR");
    const before = await state(page);
    const leg = (x, y) => `[[leg]]\njoints = "_R_PP"\nbase.at = [${x}, ${y}]\nplatform = { at = [${x / 4}, ${y / 4}], angle = 1 }\n`;
    const text = `schema = "assur/manipulator/1"\n${leg(0, 0)}${leg(9, 0)}${leg(0, 9)}`;
    await page.setInputFiles("#file", { name: "loose.toml", mimeType: "text/plain", buffer: Buffer.from(text) });
    await page.waitForFunction(() => document.getElementById("message").textContent.includes("both left with PP"));
    assert.deepEqual(await state(page), before);
    assert.ok(await page.locator("#panels .modes button").count());
    await page.click("#edit");
    await page.fill("#editor-text", text);
    await page.click("#editor-apply");
    await page.waitForFunction(() => document.getElementById("editor-error").textContent.includes("both left with PP"));
    assert.equal(await page.inputValue("#editor-text"), text);
    await page.click("#editor-close");
    assert.deepEqual(await state(page), before);
    // An answer without a number belongs to what waits.
    const refused = await page.evaluate(() => {
      const { connection } = globalThis.assur;
      const asked = connection.ask("move", {}).catch((error) => error.message);
      connection.take({ id: null, error: "the question cannot be read" });
      return asked;
    });
    assert.match(refused, /cannot be read/);
    await page.click("#export summary");
    assert.ok(await page.locator("#export .sheet").isVisible());
    await page.keyboard.press("Escape");
    assert.ok(!(await page.locator("#export .sheet").isVisible()));
  },

  async "links are followed, and one that cannot be read is named and stays"(page) {
    const wrong = [];
    const base = { page: "manipulator", ...(await state(page)) };
    const link = (it) => Buffer.from(JSON.stringify(it)).toString("base64url");
    wrong.push("nonsense", "eyJwYWdlIjoibWFuaXB1bGF0b3IifQ", link({ ...base, workspace: { ...base.workspace, kind: "nothing" } }));
    for (const hash of wrong) {
      const other = await open(`${server.address}#${hash}`);
      assert.match(await other.textContent("#notice"), /This link cannot be read/, hash);
      assert.equal(new URL(other.url()).hash, `#${hash}`);
      // From here a good one leads on, and back.
      const here = (await state(other)).model;
      await other.evaluate((hash) => { location.hash = hash; }, link(base));
      await other.waitForFunction((text) => JSON.stringify(globalThis.assur.page.state.model) === text, JSON.stringify(base.model));
      await settled(other);
      assert.ok(!(await other.locator("#notice").isVisible()));
      await other.keyboard.press("Control+z");
      await other.waitForFunction((text) => JSON.stringify(globalThis.assur.page.state.model) === text, JSON.stringify(here));
      await other.close();
    }
  },

  async "what was undone stays undone on other pages and back"(page) {
    await startFrom(page, "3-RPR");
    const before = (await state(page)).model;
    await drag(page, "base:0", 20, 10);
    await page.keyboard.press("Control+z");
    await page.waitForFunction((text) => JSON.stringify(globalThis.assur.page.state.model) === text, JSON.stringify(before));
    await page.click("#tab-truss");
    await page.waitForFunction(() => globalThis.assur.page.state.page === "truss");
    await page.click("#tab-manipulator");
    await page.waitForFunction(() => globalThis.assur.page.state.page === "manipulator");
    assert.deepEqual((await state(page)).model, before);
    // Steps of undo pressed in a row are all taken; one that leads to another page brings it into view.
    await page.evaluate(() => { globalThis.assur.stage.scale = 1e-3; });
    await page.keyboard.press("Control+z");
    await page.keyboard.press("Control+z");
    await page.waitForFunction(() => globalThis.assur.page.state.page === "manipulator" && globalThis.assur.history.future.length === 2);
    assert.ok(await page.evaluate(() => globalThis.assur.stage.scale) > 1);
    await page.keyboard.press("Control+Shift+z");
    await page.keyboard.press("Control+Shift+z");
    await page.waitForFunction(() => globalThis.assur.history.future.length === 0);
    assert.deepEqual((await state(page)).model, before);
  },

  async "files are opened; wrong and too large ones are refused, and what was there stays"(page) {
    const file = (name, text) => ({ name, mimeType: "text/plain", buffer: Buffer.from(text) });
    const examples = new URL("../../examples/", import.meta.url).pathname;
    await page.setInputFiles("#file", join(examples, "3-rrr.toml"));
    await page.waitForFunction(() => globalThis.assur.page.answer?.model?.name.includes("base cranks"));
    await settled(page);
    const before = await state(page);
    const said = (words) => page.waitForFunction((words) => document.getElementById("message").textContent.includes(words), words);
    await page.setInputFiles("#file", file("bad.toml", "schema = 'assur/manipulator/1'\nlegs = []\n"));
    await said('did you mean "leg"');
    await page.setInputFiles("#file", file("large.toml", "#".repeat(300_000)));
    await said("too large");
    // Measured as it is sent: letters of two bytes.
    const long = page.evaluate(() => globalThis.assur.connection.ask("write", { model: "é".repeat(0.6 * globalThis.assur.connection.largest) }).catch((error) => error.message));
    assert.match(await long, /too large/);
    assert.deepEqual(await state(page), before);
    await page.setInputFiles("#file", join(examples, "coupler.json"));
    await page.waitForFunction(() => globalThis.assur.page.answer?.circuits);
    await page.setInputFiles("#file", join(examples, "seven-link.json"));
    await page.waitForFunction(() => globalThis.assur.page.answer?.drawings && globalThis.assur.page.state.page === "truss");
    await page.click("#tab-manipulator");
    await page.waitForFunction(() => globalThis.assur.page.answer?.model);
    await settled(page);
  },

  async "reloading shows the same view"(page) {
    await page.evaluate(() => globalThis.assur.page.pull({ handle: "bound" }, true));
    await settled(page);
    await page.selectOption("#workspace", "maximal");
    await settled(page);
    const before = await state(page);
    await page.reload();
    await page.waitForFunction(() => globalThis.assur?.page?.answer);
    await settled(page);
    const after = await state(page);
    assert.deepEqual(after.model, before.model);
    assert.deepEqual(after.inputs, before.inputs);
    assert.deepEqual(after.workspace, before.workspace);
    assert.equal(await page.inputValue("#workspace"), "maximal");
    await page.selectOption("#workspace", "");
    await settled(page);
    after.mode.pose.forEach((v, k) => assert.ok(Math.abs(v - before.mode.pose[k]) < 1e-9));
    // A link that was sent shows it in another window.
    const other = await open(page.url());
    assert.deepEqual((await state(other)).model, after.model);
    assert.equal(await ghosts(other), await ghosts(page));
    await other.close();
  },

  async "model, SVG and PNG are exported"(page) {
    const save = async (button) => {
      await page.click("#export summary");
      const [file] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
      const path = join(folder, file.suggestedFilename());
      await file.saveAs(path);
      return path;
    };
    const model = await save("#export-model");
    const { inputs } = await state(page);
    const report = forwardFile(model, inputs, (await answer(page)).actuators);
    assert.equal(report.modes.length, (await answer(page)).report.modes.length);
    const drawing = readFileSync(await save("#export-svg"), "utf8");
    assert.match(drawing, /^<svg /);
    assert.ok(drawing.includes("<title>") && !drawing.includes("var(--"));
    const pixels = readFileSync(await save("#export-png"));
    assert.equal(pixels.subarray(1, 4).toString(), "PNG");
    assert.ok(pixels.length > 10_000);
    if (PICTURES) writeFileSync(join(PICTURES, "exported.png"), pixels);
  },

  async "two tabs do not disturb each other"(page) {
    const other = await open(server.address);
    const before = await state(page);
    await drag(other, "base:0", 30, 20);
    assert.deepEqual(await state(page), before);
    assert.equal((await state(other)).model.leg.length, 3);
    await other.close();
  },

  async "a page too many says so, and gets in when another is closed"(page) {
    await page.evaluate(async () => {
      globalThis.others = Array.from({ length: 32 }, () => new WebSocket(globalThis.assur.connection.socket.url));
      await Promise.all(globalThis.others.map((socket) => new Promise((go) => socket.addEventListener("open", go))));
    });
    const other = await context.newPage();
    await other.goto(server.address);
    await other.waitForFunction(() => document.getElementById("notice").textContent.includes("too many pages are open"));
    await page.evaluate(() => globalThis.others.forEach((socket) => socket.close()));
    await other.waitForFunction(() => globalThis.assur.page?.answer, null, { timeout: 15_000 });
    assert.ok(!(await other.locator("#notice").isVisible()));
    await other.close();
  },

  async "a closed socket is opened again, and nothing is lost"(page) {
    const before = await state(page);
    // Closing takes a moment, in which the old socket still counts as open.
    await page.evaluate(() => {
      globalThis.socketBefore = globalThis.assur.connection.socket;
      globalThis.socketBefore.close();
    });
    await page.waitForFunction(() => {
      const { socket } = globalThis.assur.connection;
      return socket && socket !== globalThis.socketBefore && socket.readyState === WebSocket.OPEN;
    });
    await page.waitForFunction(() => document.getElementById("connection").dataset.state === "open" && document.getElementById("notice").hidden);
    await settled(page);
    assert.deepEqual((await state(page)).model, before.model);
    await drag(page, "base:0", 10, 10);
    assert.notDeepEqual((await state(page)).model, before.model);
  },

  async "a killed server is named, what is seen stays, and a new one at its address goes on"(page) {
    const before = await state(page);
    const shown = await ghosts(page);
    await server.stop();
    await page.waitForFunction(() => document.getElementById("connection").dataset.state !== "open");
    await page.waitForSelector("#notice:not([hidden])");
    assert.match(await page.textContent("#notice"), /has stopped.*assur explore http/s);
    assert.equal(await ghosts(page), shown);
    await drag(page, "base:0", 20, 0, 3);
    assert.deepEqual((await state(page)).model, before.model);
    // Nor does anything else that would have to ask lead anywhere.
    const [steps, address] = [await page.evaluate(() => globalThis.assur.history.past.length), page.url()];
    await page.keyboard.press("Control+z");
    await page.click("#tab-truss");
    await page.selectOption("#family", "3-RRR");
    await page.waitForFunction(() => document.getElementById("message").textContent.includes("no server"));
    await page.evaluate(() => globalThis.assur.lead(async () => {}));
    assert.deepEqual([await state(page), await page.evaluate(() => globalThis.assur.history.past.length), page.url()], [before, steps, address]);
    assert.ok(await page.locator("#panels .modes button").count());
    await page.click("#export summary");
    const [file] = await Promise.all([page.waitForEvent("download"), page.click("#export-model")]);
    assert.match(file.suggestedFilename(), /json$/);
    await file.saveAs(join(folder, "offline.json"));
    assert.deepEqual(JSON.parse(readFileSync(join(folder, "offline.json"), "utf8")), before.model);
    server = await explorer(server.address);
    await page.waitForFunction(() => document.getElementById("connection").dataset.state === "open", null, { timeout: 15000 });
    await drag(page, "base:0", 25, 10);
    assert.notDeepEqual((await state(page)).model, before.model);
  },

  async "four-bar: circuits, dragging, running"(page) {
    await page.click("#tab-four_bar");
    await page.waitForFunction(() => globalThis.assur.page.answer?.circuits);
    assert.equal((await answer(page)).circuits.length, 2);
    await settled(page);
    await picture(page, "four-bar");
    await drag(page, "pivot:1", -20, 15);
    const { circuits, report, joints, pivots } = await answer(page);
    assert.equal(report.circuits.length, circuits.length);
    const length = ([a, b], [c, d]) => Math.hypot(a - c, b - d);
    const { fourbar } = (await state(page)).file;
    assert.ok(Math.abs(length(joints[0], pivots[0]) - fourbar.r) < 1e-9);
    await drag(page, "point", 15, -20);
    await page.click("#run");
    await page.waitForTimeout(400);
    // A circuit is taken while it runs, and what is said below stays.
    await page.evaluate(() => globalThis.assur.say("a word"));
    await page.locator("#panels .modes button").nth(1).click();
    await page.waitForFunction(() => globalThis.assur.page.state.place.circuit === 1);
    await page.evaluate(() => globalThis.assur.say("a word"));
    const tau = (await answer(page)).place.tau;
    await page.waitForTimeout(100);
    assert.equal(await page.textContent("#message"), "a word");
    assert.notEqual((await answer(page)).place.tau, tau);
    await picture(page, "four-bar-running");
    // Left, it stops.
    await page.click("#tab-truss");
    await page.waitForFunction(() => globalThis.assur.page.state.page === "truss");
    const asked = await page.evaluate(() => globalThis.assur.connection.next);
    await page.waitForTimeout(200);
    assert.equal(await page.evaluate(() => globalThis.assur.connection.next), asked);
    await page.click("#tab-four_bar");
    await page.waitForFunction(() => globalThis.assur.page.state.page === "four_bar");
  },

  async "truss: every real assembly, another one taken"(page) {
    await page.click("#tab-truss");
    await page.waitForFunction(() => globalThis.assur.page.answer?.drawings);
    const file = join(folder, "truss.json");
    const check = async () => {
      writeFileSync(file, JSON.stringify((await state(page)).file));
      const report = JSON.parse(execFileSync(PROGRAM, ["group", file, "--json"], { encoding: "utf8" }));
      assert.equal(await ghosts(page), report.assemblies.length - 1);
      assert.equal((await answer(page)).report.count, report.count);
    };
    await check();
    await picture(page, "truss");
    await page.keyboard.press("1");
    await settled(page);
    await check();
    await drag(page, "joint:4", 12, 8);
    await check();
  },

  async "dark"(page) {
    await page.click("#tab-manipulator");
    await startFrom(page, "3-RRR");
    await page.click("#theme");
    await settled(page);
    await picture(page, "dark");
    await page.click("#theme");
  },

  async "readable on a projector and on a small laptop"(page) {
    for (const [name, size] of Object.entries({ projector: { width: 1920, height: 1080 }, laptop: { width: 1280, height: 720 }, phone: { width: 420, height: 900 } })) {
      await page.setViewportSize(size);
      await startFrom(page, "3-PRR");
      await page.evaluate(() => globalThis.assur.page.pull({ handle: "bound" }, true));
      await settled(page);
      await page.selectOption("#workspace", "inclusive");
      await settled(page);
      await picture(page, name);
      // Nothing sticks out sideways.
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), name);
    }
    await page.setViewportSize({ width: 1440, height: 900 });
  },

  // The figures: round trips of a drag as the browser measures them.
  async "sixty answers a second while dragging"() {
    for (const kind of ["", "maximal"]) {
      const page = await open(server.address);
      const figures = await page.evaluate(async (kind) => {
        const { page, connection } = globalThis.assur;
        const frame = () => new Promise((go) => requestAnimationFrame(go));
        const model = JSON.parse(JSON.stringify(page.state.model));
        for (const leg of model.leg) leg.limits = [6, 22];
        page.state.workspace.kind = kind;
        page.pull({ handle: "design", model }, true);
        await page.moves.settled();
        const served = [];
        const take = connection.take.bind(connection);
        connection.take = (message) => {
          if (message.answer?.drawings) served.push(message.micros / 1000);
          take(message);
        };
        const { at } = page.state.model.leg[2].base;
        const counted = async (pulls, pace) => {
          connection.times.length = served.length = 0;
          page.grab();
          const began = performance.now();
          for (let k = 0; k < pulls; k++) {
            const turn = (k / pulls) * 2 * Math.PI;
            page.pull({ handle: "base", leg: 2, to: [at[0] + 0.6 * Math.sin(turn), at[1] + 0.6 - 0.6 * Math.cos(turn)] });
            await pace();
          }
          await page.moves.settled();
          const rate = (1000 * connection.times.length) / (performance.now() - began);
          const part = (times, share) => [...times].sort((a, b) => a - b)[Math.ceil(share * times.length) - 1];
          await page.drop();
          await page.slow.settled();
          return { answers: connection.times.length, rate, median: part(connection.times, 0.5), p95: part(connection.times, 0.95), served: part(served, 0.5), served95: part(served, 0.95) };
        };
        await counted(60, frame);
        // As a hand drags, a pull a frame; and as fast as answers come.
        const drag = await counted(300, frame);
        const flat = await counted(300, () => page.moves.settled());
        return { drag, flat, modes: page.answer.report.modes.length, loops: page.region?.loops.length ?? 0 };
      }, kind);
      const { drag, flat } = figures;
      const told = ({ rate, median, p95, served, served95 }) => `${rate.toFixed(0)} answers a second, round trip ${median.toFixed(1)} ms, 95 % below ${p95.toFixed(1)} ms (the server's part ${served.toFixed(1)}, ${served95.toFixed(1)})`;
      console.log(`  ${figures.modes} modes, ${kind || "no"} workspace, a pull a frame: ${told(drag)}`);
      console.log(`  ${figures.modes} modes, ${kind || "no"} workspace, without pause: ${told(flat)}`);
      assert.ok(figures.modes === 6 && (kind === "" || figures.loops > 0));
      // A machine that does other things as well may be slower; alone, a frame's 16 ms hold for 95 %.
      assert.ok(drag.median <= (process.env.ALONE ? 16 : 200), "a round trip takes longer than a frame");
      if (process.env.ALONE) assert.ok(drag.p95 <= 16 && drag.rate >= 58 && flat.rate >= 60, "not sixty answers a second, each within a frame");
      await page.close();
    }
  },

  async "2000 steps beside a singularity without a jump"() {
    const page = await open(server.address);
    const figures = await page.evaluate(async () => {
      const { page } = globalThis.assur;
      // Maps that change beside are another test's.
      page.slow.push = () => {};
      const pull = async (value) => {
        page.pull({ handle: "input", number: 2, value });
        await page.moves.settled();
        return page.answer.current === null ? null : { pose: page.state.mode.pose, det: page.answer.report.modes[page.answer.current].det_a };
      };
      const start = page.state.inputs[2];
      // Where the mode ends, to a thousandth.
      let [low, high] = [start, start * 4];
      for (let k = 0; k < 16; k++) {
        const value = (low + high) / 2;
        if (await pull(value)) low = value;
        else high = value;
      }
      const first = await pull(start);
      let [before, worst, home] = [first, 0, 0];
      const off = (p, q) => Math.hypot(p.pose[0] - q.pose[0], p.pose[1] - q.pose[1]);
      for (let k = 1; k <= 2000; k++) {
        const now = await pull(start + (low - start) * (0.5 - 0.5 * Math.cos((k / 2000) * 20 * Math.PI)));
        if (!now) return { lost: k };
        // Another mode has the other sign, or is somewhere else at the start of the next round.
        if (now.det * first.det < 0) return { turned: k };
        if (k % 200 === 0) home = Math.max(home, off(now, first));
        worst = Math.max(worst, off(now, before));
        before = now;
      }
      await page.drop();
      return { worst, home, gap: high - low };
    });
    console.log(`  ${JSON.stringify(figures)}`);
    assert.ok(figures.worst < 1 && figures.home < 1e-6, "the mode that is held has jumped");
    await page.close();
  },

  async "a page left open is still connected"() {
    // The server lets go of who says nothing for 65 seconds; the browser answers its pings.
    await idle.page.waitForTimeout(Math.max(0, 70_000 - (Date.now() - idle.since)));
    assert.equal(await idle.page.evaluate(() => globalThis.assur.connection.next), idle.next);
    assert.equal(await idle.page.getAttribute("#connection", "data-state"), "open");
    console.log(`  after ${((Date.now() - idle.since) / 1000).toFixed(0)} s without a word from it`);
    await drag(idle.page, "base:0", 15, 10);
    assert.equal((await ghosts(idle.page)) + (await solid(idle.page)), (await forward(idle.page)).modes.length);
    await idle.server.stop();
  },
};

let failed = 0;
// Nothing is asked of this one until the end: longer than the server bears with a page that is gone.
const idle = { server: await explorer(), since: Date.now() };
idle.page = await open(idle.server.address);
idle.next = await idle.page.evaluate(() => globalThis.assur.connection.next);
const page = await open(server.address);
for (const [name, test] of Object.entries(tests)) {
  if (process.env.ONLY && !name.includes(process.env.ONLY)) continue;
  const began = Date.now();
  try {
    await test(page);
    console.log(`ok    ${name}  (${((Date.now() - began) / 1000).toFixed(1)} s)`);
  } catch (error) {
    failed += 1;
    console.log(`FAIL  ${name}\n${error.stack}`);
    if (PICTURES) await page.screenshot({ path: join(PICTURES, `failed-${failed}.png`) });
  }
}
if (errors.length) {
  failed += 1;
  console.log(`FAIL  the page met errors:\n${[...new Set(errors)].join("\n")}`);
}
await browser.close();
await server.stop();
process.exit(failed ? 1 : 0);
