// The page of manipulators: all assembly modes of one, and what can be pulled.

import { Circle } from "./circle.js";
import { latest } from "./connection.js";
import { button, choice, facts, panel } from "./panels.js";
import { Plane } from "./plane.js";
import { degrees, html, number, radians } from "./svg.js";

/**
 * @typedef {import("./types.js").ManipulatorState} ManipulatorState
 * @typedef {import("./types.js").Moved} Moved
 * @typedef {import("./types.js").Point} Point
 * @typedef {import("./types.js").Held} Held
 * @typedef {import("./types.js").Model} Model
 * @typedef {import("./types.js").Region} Region
 * @typedef {import("./main.js").App} App
 * @typedef {{ model: Model, inputs: number[], mode: Held | null, tones: number[] }} Anchor
 */

const TONES = 6;
/** Cells along a side of the plane of actuators, at rest and while something is pulled. */
const CELLS = { still: 160, moving: 48 };
/** Slow questions while something is pulled come no more often than this, in milliseconds. */
const SLOW_PAUSE = 180;

/** The panels while something is pulled change no more often than this, in milliseconds. */
const PANEL_PAUSE = 80;

const HANDLES = /** @type {Record<string, string>} */ ({
  base: "base point of leg", base_axis: "slider direction of leg", platform: "platform point of leg", platform_axis: "platform slider of leg", pose: "platform", turn: "turn the platform",
});

const EVENTS = /** @type {Record<string, string>} */ ({
  meeting: "This mode meets another and both end. Pull back, or take another mode.",
  branch: "The mode cannot be told from another any more here. Pull back, or take another mode.",
  self_motion: "Here the platform moves with all actuators held: a self-motion.",
  lost: "The mode is lost in this change; take another.",
  crossing: "Singular: two modes meet, and the platform passes from one to the other.",
  stopped: "A limit, or the end of a leg's reach.",
});

const WORKSPACES = /** @type {[string, string][]} */ ([
  ["", "none"], ["constant", "this orientation"], ["maximal", "maximal"], ["inclusive", "inclusive"], ["total", "total"], ["dextrous", "dextrous"],
]);

export class ManipulatorPage {
  /** @param {App} app @param {ManipulatorState} state */
  constructor(app, state) {
    this.app = app;
    this.state = state;
    /** @type {Moved | null} */
    this.answer = null;
    /** @type {number[]} */
    this.tones = [];
    /** @type {Anchor} Where the next pull starts from: the last state in which a mode was held. */
    this.anchor = { model: state.model, inputs: state.inputs, mode: state.mode, tones: [] };
    /** @type {Region | null} */
    this.region = null;
    this.regionError = "";
    this.regionErrorShown = "";
    this.provedKey = "";
    /** @type {import("./types.js").Loci | null} */
    this.loci = null;
    this.lociKey = "";
    this.planeKey = "";
    this.pulling = false;
    this.lastSlow = 0;
    this.lastPanels = 0;
    this.moves = latest((/** @type {{ pull: object | null, pick?: boolean, fit?: boolean, book?: boolean }} */ wish) => this.move(wish));
    this.slow = latest((/** @type {null} */ _) => this.askSlowly());
    this.inputs = html("div");
    this.account = html("div", { class: "account", role: "img" });
    this.summary = html("p", { class: "quiet" });
    this.list = html("ul", { class: "modes" });
    this.poseNumbers = html("div", { class: "numbers" });
    this.circle = new Circle();
    this.plane = new Plane({
      pull: (pair, values) => {
        const inputs = [...this.anchor.inputs];
        pair.forEach((input, k) => { inputs[input] = values[k]; });
        this.pull({ handle: "inputs", values: inputs });
      },
      drop: () => this.drop(),
    });
    this.proof = html("div");
    this.pairs = choice([["0,1", "q1, q2"], ["0,2", "q1, q3"], ["1,2", "q2, q3"]], (pair) => {
      this.state.pair = /** @type {Point} */ (pair.split(",").map(Number));
      this.slow.push(null);
      this.app.book();
    }, "Which actuators");
    this.pairs.value = this.state.pair.join(",");
    this.kind = choice(WORKSPACES, (kind) => {
      this.state.workspace.kind = kind;
      this.refresh();
    }, "Kind of workspace");
    this.kind.id = "workspace";
    this.kind.value = this.state.workspace.kind;
    this.range = html("div", { class: "numbers" });
    for (const end of /** @type {("from" | "to")[]} */ (["from", "to"])) {
      const field = html("input", { type: "number", step: "any", "aria-label": `Orientation ${end}, degrees` });
      field.value = String(Number(degrees(this.state.workspace[end]).toFixed(6)));
      field.addEventListener("change", () => {
        if (!Number.isFinite(field.valueAsNumber)) return;
        this.state.workspace[end] = radians(field.valueAsNumber);
        this.refresh();
      });
      this.range.append(html("label", {}, [`${end} (°)`, field]));
    }
    this.regionFacts = html("div");
    this.lociButton = button("show", () => this.toggleLoci(), { id: "loci", "aria-pressed": String(this.state.loci) });
    this.facts = html("div");
    this.app.panels(
      panel("Actuators", [this.inputs]),
      panel("Assembly modes", [this.account, this.summary, this.list]),
      panel("Workspace", [this.range, this.regionFacts], [this.kind]),
      panel("Platform", [this.poseNumbers, this.facts]),
      panel("Orientations: roots of the eliminant", [this.circle.element]),
      panel("Modes over two actuators", [this.plane.element], [this.pairs]),
      panel("Singular positions", [html("p", { class: "quiet" }, ["Of this orientation and working mode: two assembly modes meet (line), a leg stretches or folds (dashes)."])], [this.lociButton]),
      panel("Proof", [this.proof], [button("prove", () => this.prove(), { id: "prove" })]),
      panel("Design", [button("Edit as text …", () => this.app.edit(), { id: "edit" })]),
    );
  }

  /** @param {boolean} pick whether a mode is taken where none is held @param {boolean} fit */
  begin(pick, fit) {
    this.moves.push({ pull: null, pick, fit });
    return this.moves.settled();
  }

  /** @param {{ pull: object | null, pick?: boolean, fit?: boolean, book?: boolean }} wish */
  async move({ pull, pick = false, fit = false, book = false }) {
    const { model, inputs, mode, tones } = this.anchor;
    const wish = this.workspaceWish();
    try {
      /** @type {Moved} */
      const answer = await this.app.connection.ask("move", { model, inputs, mode, pick, pull, workspace: wish });
      this.take(answer, mode !== null, tones);
      if (book) this.settle();
      if (fit) this.fit();
      this.app.schedule();
      this.app.say(changesLimits(pull) && answer.inputs.some((q, k) => q !== inputs[k]) ? "An actuator stood outside its new limits and has moved to their end." : "");
      this.slow.push(null);
      if (book) this.app.book();
    } catch (error) {
      // The last good state stays.
      this.app.fail(error);
    }
  }

  /** @param {Moved} answer @param {boolean} held whether a mode was held @param {number[]} tones */
  take(answer, held, tones) {
    const used = new Set(answer.came_from.flatMap((from) => (from === null ? [] : [tones[from]])));
    let free = 0;
    this.tones = answer.came_from.map((from) => {
      if (from !== null && tones[from] !== undefined) return tones[from];
      while (used.has(free)) free += 1;
      used.add(free);
      return free;
    });
    this.answer = answer;
    const current = answer.current === null ? null : answer.report.modes[answer.current];
    const mode = current ? { pose: current.pose, signs: current.signs ?? "" } : null;
    Object.assign(this.state, { model: answer.model, inputs: answer.inputs, mode });
    // A pull on which the mode ends is measured from where it last was, so that pulling back finds it again.
    if (mode || !held) this.anchor = { model: answer.model, inputs: answer.inputs, mode, tones: this.tones };
    if (answer.workspace !== undefined && answer.workspace !== null) {
      this.region = "error" in answer.workspace ? null : answer.workspace;
      this.regionError = "error" in answer.workspace ? answer.workspace.error : "";
    }
    if (answer.event) this.app.note(EVENTS[answer.event.kind], answer.event.kind === "stopped" || answer.event.kind === "crossing" ? "note" : "alarm");
    else this.app.note("");
  }

  /** Takes hold of another mode. @param {number} index */
  hold(index) {
    const mode = this.answer?.report.modes[index];
    if (!mode) return;
    this.anchor = { model: this.state.model, inputs: this.state.inputs, mode: { pose: mode.pose, signs: mode.signs ?? "" }, tones: this.tones };
    this.moves.push({ pull: null, book: true });
  }

  /** @param {object} pull @param {boolean} [done] whether this ends the pull */
  pull(pull, done = false) {
    this.pulling = !done;
    this.moves.push({ pull, book: done });
  }

  grab() {
    this.pulling = true;
  }

  /** @param {string} key @param {Point} to */
  pullHandle(key, to) {
    const [handle, leg] = key.split(":");
    this.pull(leg === undefined ? { handle, to } : { handle, leg: Number(leg), to });
  }

  /** A pull has ended: if the mode has ended in it, nothing is held from here on. */
  settle() {
    if (this.answer && this.answer.current === null) this.anchor = { model: this.state.model, inputs: this.state.inputs, mode: null, tones: this.tones };
  }

  async drop() {
    this.pulling = false;
    await this.moves.settled();
    this.settle();
    this.app.schedule();
    this.app.book();
    this.slow.push(null);
  }

  // Slow answers: curves and maps, only where something they depend on has changed.

  async askSlowly() {
    const now = performance.now();
    if (this.pulling && now - this.lastSlow < SLOW_PAUSE) return;
    this.lastSlow = now;
    const { model, inputs, mode, pair } = this.state;
    const others = inputs.filter((_, k) => !pair.includes(k));
    const size = this.pulling ? CELLS.moving : CELLS.still;
    const planeKey = JSON.stringify([model, others, pair, size, document.documentElement.dataset.theme]);
    try {
      if (planeKey !== this.planeKey) {
        const plane = await this.app.connection.ask("plane", { model, inputs, pair, size: [size, size] });
        this.planeKey = planeKey;
        this.plane.draw(plane, this.answer?.actuators ?? []);
        this.plane.point(this.state.inputs);
      }
      const lociKey = JSON.stringify([model, mode?.pose[2], mode?.signs]);
      if (this.state.loci && mode && lociKey !== this.lociKey) {
        this.loci = await this.app.connection.ask("loci", { model, phi: mode.pose[2], signs: mode.signs });
        this.lociKey = lociKey;
        this.app.schedule();
      }
    } catch (error) {
      this.app.fail(error);
    }
    // What changed meanwhile asks again by itself; at rest the map is asked for in full.
    if (!this.pulling && size === CELLS.moving) this.slow.push(null);
  }

  async prove() {
    this.proof.replaceChildren(html("p", { class: "quiet" }, ["proving …"]));
    const { model, inputs } = this.state;
    try {
      const { report } = await this.app.connection.ask("prove", { model, inputs });
      const verdicts = report.modes.map((/** @type {import("./types.js").Mode} */ mode, /** @type {number} */ k) => `${k + 1} ${mode.proof}`).join(", ");
      this.proof.replaceChildren(
        html("p", { class: report.certificate.complete ? "tag good" : "tag bad" }, [report.certificate.summary]),
        html("p", { class: "tag" }, [verdicts || "no mode"]),
      );
      this.provedKey = JSON.stringify([model, inputs]);
    } catch (error) {
      this.proof.replaceChildren();
      this.app.fail(error);
    }
  }

  // Drawing.

  assemblies() {
    const { answer } = this;
    if (!answer) return [];
    const all = answer.drawings.map((marks, k) => {
      const body = marks.find((mark) => mark.mark === "body");
      const name = body ? /** @type {Point} */ ([0, 1].map((axis) => body.at.reduce((sum, p) => sum + p[axis], 0) / body.at.length)) : null;
      return { tone: this.tones[k] % TONES, label: String(k + 1), ghost: k !== answer.current, marks, name };
    });
    if (all.length > 0) return all;
    // Without a mode the ground is what is left to take hold of.
    const bases = answer.handles.filter(({ handle }) => handle === "base");
    const look = { actuated: false, violated: false };
    const marks = bases.flatMap(({ at, leg }) => /** @type {import("./types.js").Mark[]} */ ([{ mark: "ground", at: [at] }, { mark: "pin", at: [at], look }, { mark: "number", at: [at], leg: (leg ?? 0) + 1 }]));
    return [{ tone: 0, label: "", ghost: false, marks, name: null }];
  }

  draw() {
    const { answer, app } = this;
    if (!answer) return;
    const { stage } = app;
    stage.draw(this.assemblies());
    /** @type {{ class: string, points: Point[], closed: boolean }[]} */
    const shapes = [];
    if (this.region && this.state.workspace.kind) {
      for (const points of this.region.loops) shapes.push({ class: "region", points, closed: true });
      for (const points of this.region.separating) shapes.push({ class: "separating", points, closed: false });
    }
    if (this.loci && this.state.loci && this.state.mode) {
      for (const mode of this.loci.report.type_2.modes) for (const points of mode.pieces) shapes.push({ class: "locus-2", points, closed: false });
      for (const points of this.loci.type_1.flat()) shapes.push({ class: "locus-1", points, closed: false });
    }
    stage.background(shapes);
    const held = answer.event && answer.event.kind !== "stopped" ? [answer.event.pose] : [];
    stage.rings([...held, ...answer.ended].map((pose) => [pose[0], pose[1]]));
    stage.handles(answer.handles.map(({ handle, leg, at, origin }) => ({
      key: leg === undefined ? handle : `${handle}:${leg}`, label: leg === undefined ? HANDLES[handle] : `${HANDLES[handle]} ${leg + 1}`, at, origin, axis: handle.endsWith("axis") || handle === "turn",
    })));
    const { account } = answer.report;
    app.caption(answer.model.name || answer.family, `${answer.family}, ${count(answer)}, degree ${account.degree}`);
    // Numbers that change sixty times a second cannot be read.
    const now = performance.now();
    if (this.pulling && now - this.lastPanels < PANEL_PAUSE) return;
    this.lastPanels = now;
    this.drawPanels(answer);
  }

  /** Everything of ordinary size: modes that run far away are left out. */
  fit() {
    const { answer } = this;
    if (!answer) return;
    const bases = answer.drawings.flatMap((marks) => marks.filter((mark) => mark.mark === "number").flatMap((mark) => mark.at));
    const handles = answer.handles.map((handle) => handle.at);
    const reach = 6 * answer.size;
    const middle = handles[0] ?? [0, 0];
    const near = answer.drawings.flatMap((marks) => marks.filter((mark) => mark.mark !== "frame").flatMap((mark) => mark.at)).filter((p) => Math.hypot(p[0] - middle[0], p[1] - middle[1]) < reach);
    this.app.stage.fit([...bases, ...handles, ...near]);
  }

  refresh() {
    this.moves.push({ pull: null, book: true });
  }

  toggleLoci() {
    this.state.loci = !this.state.loci;
    this.lociButton.setAttribute("aria-pressed", String(this.state.loci));
    this.lociButton.textContent = this.state.loci ? "hide" : "show";
    this.slow.push(null);
    this.app.schedule();
    this.app.book();
  }

  workspaceWish() {
    const { kind, from, to } = this.state.workspace;
    return kind ? { kind, from, to } : null;
  }

  /** @param {Moved} answer */
  drawPanels(answer) {
    if (this.inputs.children.length !== answer.actuators.length) {
      this.inputs.replaceChildren(...answer.actuators.map((actuator, k) => this.actuator(actuator, k)));
    }
    answer.actuators.forEach((actuator, k) => {
      const shown = actuator.angle ? degrees(answer.inputs[k]) : answer.inputs[k];
      const [low, high] = actuator.range.map((v) => (actuator.angle ? degrees(v) : v));
      const row = this.inputs.children[k];
      const [slider, field] = row.querySelectorAll("input");
      slider.min = String(low);
      slider.max = String(high);
      slider.step = String((high - low) / 2000);
      if (document.activeElement !== slider) slider.value = String(shown);
      if (document.activeElement !== field) field.value = String(Number(shown.toPrecision(7)));
      row.querySelector("span")?.replaceChildren(`q${k + 1}  ${actuator.angle ? "turn" : "slide"}`);
      const ends = [.../** @type {NodeListOf<HTMLInputElement>} */ (row.querySelectorAll(".ends input"))];
      ends.forEach((end, side) => {
        const bound = Number((side === 0 ? low : high).toPrecision(7));
        end.placeholder = "none";
        if (document.activeElement !== end) end.value = actuator.limited ? String(bound) : "";
      });
    });
    const { account, modes } = answer.report;
    const cells = [...Array(account.real).fill("real"), ...Array(account.complex).fill("complex"), ...Array(Math.max(0, account.degree - account.real - account.complex)).fill("other")];
    this.account.replaceChildren(...cells.map((kind) => html("span", { class: kind })));
    this.account.setAttribute("aria-label", `of degree ${account.degree}: ${account.real} real, ${account.complex} complex`);
    const rest = [[account.complex, "complex"], [account.at_infinity, "at infinity"], [account.rejected, "rejected"], [account.self_motion, "on a self-motion"], [account.undecided, "undecided"]];
    const parts = rest.filter(([n]) => n).map(([n, name]) => `${n} ${name}`);
    this.summary.replaceChildren(`${account.real} real${parts.length ? `, ${parts.join(", ")}` : ""}, of degree ${account.degree}`);
    this.list.replaceChildren(...modes.map((mode, k) => {
      const tags = [mode.multiplicity > 1 ? `${mode.multiplicity}-fold` : "", mode.violations.length ? "outside limits" : ""].filter(Boolean).join(", ");
      const row = html("button", { "data-tone": this.tones[k] % TONES, "aria-pressed": String(k === answer.current), title: `det A = ${mode.det_a.toExponential(3)}` }, [
        html("span", { class: "swatch" }, [html("b", {}, [String(k + 1)])]),
        html("span", { class: "text" }, [`φ ${number(Number(degrees(mode.pose[2]).toFixed(2)))}°`]),
        html("span", { class: "tag bad" }, [tags]),
        html("span", { class: "tag" }, [(mode.signs ?? "").replaceAll("-", "−")]),
      ]);
      row.addEventListener("click", () => this.hold(k));
      return html("li", {}, [row]);
    }));
    this.drawPose(answer);
    this.circle.draw(answer.report, answer.current, this.tones.map((tone) => tone % TONES));
    this.plane.point(answer.inputs);
    this.range.hidden = !["inclusive", "total"].includes(this.state.workspace.kind);
    if (!this.state.workspace.kind) this.regionFacts.replaceChildren();
    else if (this.region) {
      const { area, perimeter, components, holes } = this.region;
      this.regionFacts.replaceChildren(facts([["area", number(area)], ["perimeter", number(perimeter)], ["pieces, holes", `${components}, ${holes}`]]));
    } else if (this.regionError !== this.regionErrorShown || !this.regionFacts.querySelector(".bad")) {
      // Not redrawn while it stands, so that its button can be pressed.
      this.regionFacts.replaceChildren(html("p", { class: "tag bad" }, [this.regionError]));
      if (answer.actuators.some((actuator) => !actuator.limited)) {
        this.regionFacts.append(html("p", {}, [button("Limit every actuator to its slider", () => this.pull({ handle: "bound" }, true), { id: "bound" })]));
      }
    }
    this.regionErrorShown = this.regionError;
    if (this.provedKey && this.provedKey !== JSON.stringify([answer.model, answer.inputs])) {
      this.proof.replaceChildren();
      this.provedKey = "";
    }
  }

  /** @param {Moved} answer @returns {void} */
  drawPose(answer) {
    const mode = answer.current === null ? null : answer.report.modes[answer.current];
    const fields = [...this.poseNumbers.querySelectorAll("input")];
    if (fields.length === 0) {
      for (const name of ["x", "y", "φ (°)"]) {
        const field = html("input", { type: "number", step: "any", "aria-label": `Platform ${name}` });
        field.addEventListener("change", () => {
          const [x, y, phi] = [...this.poseNumbers.querySelectorAll("input")].map((input) => input.valueAsNumber);
          if ([x, y, phi].every(Number.isFinite)) this.pull({ handle: "place", to: [x, y, radians(phi)] }, true);
        });
        this.poseNumbers.append(html("label", {}, [name, field]));
      }
      return this.drawPose(answer);
    }
    fields.forEach((field, k) => {
      field.disabled = !mode;
      if (document.activeElement === field) return;
      field.value = mode ? String(Number((k === 2 ? degrees(mode.pose[2]) : mode.pose[k]).toPrecision(8))) : "";
    });
    const rows = /** @type {[string, string][]} */ (mode ? [["working mode", (mode.signs ?? "").replaceAll("-", "−")], ["det A, zero where modes meet", number(mode.det_a)]] : [["no mode is held", "take one above"]]);
    this.facts.replaceChildren(facts(rows));
  }

  /** @param {import("./types.js").Actuator} actuator @param {number} k */
  actuator(actuator, k) {
    const value = (/** @type {number} */ shown) => (actuator.angle ? radians(shown) : shown);
    const slider = html("input", { type: "range", "aria-label": `Actuator ${k + 1}` });
    const field = html("input", { type: "number", step: "any", "aria-label": `Actuator ${k + 1}, number` });
    slider.addEventListener("input", () => this.pull({ handle: "input", number: k, value: value(slider.valueAsNumber) }));
    slider.addEventListener("change", () => this.drop());
    field.addEventListener("change", () => Number.isFinite(field.valueAsNumber) && this.pull({ handle: "input", number: k, value: value(field.valueAsNumber) }, true));
    const ends = ["lower", "upper"].map((end) => html("input", { type: "number", step: "any", "aria-label": `Actuator ${k + 1}, ${end} limit`, title: "Limits; empty both for none" }));
    for (const end of ends) {
      end.addEventListener("change", () => {
        const range = ends.map((input) => input.valueAsNumber);
        // One end alone says nothing yet.
        if (range.every(Number.isFinite)) this.pull({ handle: "limits", number: k, range: range.map(value) }, true);
        else if (ends.every((input) => input.value === "")) this.pull({ handle: "limits", number: k, range: null }, true);
      });
    }
    const unit = html("span", { class: "quiet" }, [actuator.angle ? "°" : ""]);
    return html("div", { class: "actuator", title: `leg ${actuator.leg}, joint ${actuator.joint}` }, [html("span", {}), slider, field, unit, html("div", { class: "ends" }, ["from ", ends[0], " to ", ends[1]])]);
  }
}

/** @param {object | null} pull */
const changesLimits = (pull) => pull !== null && "handle" in pull && ["limits", "bound", "design"].includes(String(pull.handle));

/** @param {Moved} answer */
function count(answer) {
  const n = answer.report.modes.length;
  if (answer.report.status === "self_motion") return "a self-motion";
  return n === 0 ? "no assembly mode" : n === 1 ? "1 assembly mode" : `${n} assembly modes`;
}
