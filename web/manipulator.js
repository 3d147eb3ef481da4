// The page of manipulators: all assembly modes of one, and what can be pulled.

import { Circle } from "./circle.js";
import { Refused, Unanswered } from "./connection.js";
import { Page } from "./page.js";
import { Cells, Facts, NumberField, Rows, button, choice, onSlide, panel } from "./panels.js";
import { Plane } from "./plane.js";
import { inOrder, seldom } from "./queue.js";
import { degrees, html, number, radians, set, write } from "./svg.js";

/**
 * @typedef {import("./types.js").ManipulatorState} ManipulatorState
 * @typedef {import("./types.js").Moved} Moved
 * @typedef {import("./types.js").Point} Point
 * @typedef {import("./types.js").Held} Held
 * @typedef {import("./types.js").Model} Model
 * @typedef {import("./types.js").Region} Region
 * @typedef {import("./main.js").App} App
 * @typedef {import("./types.js").Actuator} Actuator
 * @typedef {import("./types.js").Wish} Wish
 * @typedef {{ model: Model, inputs: number[], mode: Held | null, tones: number[] }} Anchor
 * @typedef {{ handle: string, leg?: number, number?: number, [more: string]: unknown }} Pull
 */

const TONES = 6;
/** Cells along a side of the plane of actuators, at rest and while something is pulled. */
const CELLS = { still: 160, moving: 48 };
/** Slow questions while something is pulled come no more often than this, in milliseconds. */
const SLOW_PAUSE = 180;

/** A workspace that takes longer than this, in milliseconds, is asked for beside a drag and not with each of its steps. */
const QUICK_REGION = 40;
/** The panels while something is pulled change no more often than this, in milliseconds. */
const PANEL_PAUSE = 80;

const HANDLES = /** @type {Record<string, string>} */ ({
  base: "base point of leg", base_axis: "slider direction of leg", middle_axis: "middle slider's direction of leg", platform: "platform point of leg", platform_axis: "platform slider of leg", pose: "platform", turn: "turn the platform",
});

const EVENTS = /** @type {Record<string, string>} */ ({
  meeting: "This mode meets another and both end.",
  branch: "The mode cannot be told from another any more here.",
  self_motion: "Here the platform moves with all actuators held: a self-motion.",
  lost: "The mode is lost in this change.",
  crossing: "Singular: two modes meet, and the platform passes from one to the other.",
  stopped: "A limit, or the end of a leg's reach.",
});

export const WORKSPACES = /** @type {[string, string][]} */ ([
  ["", "none"], ["constant", "this orientation"], ["maximal", "maximal"], ["inclusive", "inclusive"], ["total", "total"], ["dextrous", "dextrous"],
]);

/** @extends {Page<ManipulatorState, Moved>} */
export class ManipulatorPage extends Page {
  /** @param {App} app @param {ManipulatorState} state */
  constructor(app, state) {
    super(app, state);
    /** @type {number[]} For each mode a number that stays with it through a change. */
    this.tones = [];
    /** @type {Anchor} The last state in which a mode was held. */
    this.anchor = this.present();
    /** What was pulled last. */
    this.pulled = "";
    /** @type {Region | null} */
    this.region = null;
    this.regionError = "";
    /** What the workspace is of, where it was asked for by itself. */
    this.regionKey = "";
    /** What the last workspace of this kind took, in milliseconds. */
    this.regionTime = Infinity;
    this.provedKey = "";
    /** @type {import("./types.js").Loci | null} */
    this.loci = null;
    /** @type {Map<string, string>} What the maps and curves at hand were asked about. */
    this.known = new Map();
    this.slow = inOrder((/** @type {null} */ _) => this.askSlowly(), () => true);
    this.mapSoon = seldom(SLOW_PAUSE, () => this.slow.push(null));
    this.numbersSoon = seldom(PANEL_PAUSE, () => this.drawPanels());
    /** @type {{ slider: HTMLInputElement, field: NumberField, ends: NumberField[], draw: (actuator: Actuator, q: number) => void }[]} */
    this.actuators = [];
    this.inputs = html("div");
    this.account = new Cells();
    this.summary = html("p", { class: "quiet" });
    this.list = new Rows((k) => this.hold(k));
    this.place = ["x", "y", "φ (°)"].map((name, k) => new NumberField(`Platform ${name}`, (value) => this.moveTo(k, value)));
    this.poseFacts = new Facts();
    this.circle = new Circle();
    this.plane = new Plane({
      pull: (pair, values) => {
        const inputs = [...this.state.inputs];
        pair.forEach((input, k) => { inputs[input] = values[k]; });
        this.pull({ handle: "inputs", values: inputs });
      },
      drop: () => this.drop(),
    });
    this.proof = html("div");
    this.pairs = choice([["0,1", "q1, q2"], ["0,2", "q1, q3"], ["1,2", "q2, q3"]], (pair) => {
      this.state.pair = /** @type {Point} */ (pair.split(",").map(Number));
      this.mapSoon(true);
      this.app.book();
    }, "Which actuators");
    this.pairs.value = this.state.pair.join(",");
    this.kind = choice(WORKSPACES, (kind) => {
      this.state.workspace.kind = kind;
      this.takeRegion(null, "");
      this.regionTime = Infinity;
      this.do({ book: true });
    }, "Kind of workspace");
    this.kind.id = "workspace";
    this.kind.value = this.state.workspace.kind;
    const ends = /** @type {("from" | "to")[]} */ (["from", "to"]).map((end) => {
      const field = new NumberField(`Orientation ${end}, degrees`, (value) => {
        if (!Number.isFinite(value)) return Promise.reject();
        this.state.workspace[end] = radians(value);
        return this.do({ book: true });
      });
      field.show(String(Number(degrees(this.state.workspace[end]).toFixed(6))));
      return html("label", {}, [`${end} (°)`, field.element]);
    });
    this.range = html("div", { class: "numbers" }, ends);
    this.regionFacts = new Facts();
    this.regionWord = html("p", { class: "tag bad" });
    this.bound = html("p", {}, [button("Limit every actuator to its slider", () => this.pull({ handle: "bound" }, true), { id: "bound" })]);
    this.lociButton = button("", () => this.toggleLoci(), { id: "loci" });
    this.showLoci();
    this.panels = [
      panel("Actuators", [this.inputs]),
      panel("Assembly modes", [this.account.element, this.summary, this.list.element]),
      panel("Workspace", [this.range, this.regionFacts.element, this.regionWord, this.bound], [this.kind]),
      panel("Platform", [html("div", { class: "numbers" }, this.place.map((field, k) => html("label", {}, [["x", "y", "φ (°)"][k], field.element]))), this.poseFacts.element]),
      panel("Orientations: roots of the eliminant", [this.circle.element]),
      panel("Modes over two actuators", [this.plane.element], [this.pairs]),
      panel("Singular positions", [html("p", { class: "quiet" }, ["Of this orientation and working mode: two assembly modes meet (line), a leg stretches or folds (dashes)."])], [this.lociButton]),
      panel("Proof", [this.proof], [button("prove", () => this.prove(), { id: "prove" })]),
      panel("Design", [button("Edit as text …", () => this.app.edit(), { id: "edit" })]),
    ];
  }

  /** What is shown. @returns {Anchor} */
  present() {
    const { model, inputs, mode } = this.state;
    return { model, inputs, mode, tones: this.tones };
  }

  /** Where a wish starts from. While the same thing is pulled on, from where a mode was held last, so that pulling back finds one that has ended. @param {Wish} wish @returns {Anchor} */
  start({ key, take }) {
    if (take !== undefined) {
      const mode = this.answer?.report.modes[this.tones.indexOf(take)];
      if (!mode) throw new Refused("that mode has ended meanwhile");
      return { ...this.present(), mode: { pose: mode.pose, signs: mode.signs ?? "" } };
    }
    return key && key === this.pulled ? this.anchor : this.present();
  }

  /** @param {Wish} wish */
  async ask(wish) {
    const { pull = null, pick = false } = wish;
    const from = this.start(wish);
    const { model, inputs, mode } = from;
    const workspace = this.regionTime <= QUICK_REGION ? this.workspaceWish() : null;
    /** @type {Moved} */
    const answer = await this.app.connection.ask("move", { model, inputs, mode, pick, pull, workspace });
    this.pulled = wish.key ?? "";
    this.take(answer, from);
    return changesLimits(pull) && answer.inputs.some((q, k) => !same(q, inputs[k], answer.actuators[k].angle)) ? "An actuator stood outside its new limits and has moved to their end." : "";
  }

  /** @param {Moved} answer @param {Anchor} from what was asked about */
  take(answer, from) {
    const used = new Set(answer.came_from.flatMap((before) => (before === null ? [] : [from.tones[before]])));
    let free = 0;
    this.tones = answer.came_from.map((before) => {
      if (before !== null && from.tones[before] !== undefined) return from.tones[before];
      while (used.has(free)) free += 1;
      used.add(free);
      return free;
    });
    this.answer = answer;
    const current = answer.current === null ? null : answer.report.modes[answer.current];
    const mode = current ? { pose: current.pose, signs: current.signs ?? "" } : null;
    Object.assign(this.state, { model: answer.model, inputs: answer.inputs, mode });
    this.anchor = mode ? this.present() : from;
    if (answer.workspace) this.takeRegion(answer.workspace, "");
    // One of another mechanism is not shown.
    else if (!this.state.workspace.kind || this.regionKey !== this.regionAbout()) this.takeRegion(null, "");
  }

  /** @param {Region | { error: string } | null} workspace @param {string} key what it is of, where it was asked for by itself */
  takeRegion(workspace, key) {
    this.regionKey = key;
    this.region = workspace && !("error" in workspace) ? workspace : null;
    this.regionError = workspace && "error" in workspace ? workspace.error : "";
    if (workspace) this.regionTime = (this.region?.micros ?? 0) / 1000;
  }

  /** What a workspace depends on. */
  regionAbout() {
    const { model, mode, workspace } = this.state;
    return JSON.stringify([model, workspace, workspace.kind === "constant" ? mode?.pose[2] : null]);
  }

  tell() {
    const { event, current, report } = this.answer ?? { event: null };
    const on = !event || current !== null ? "" : report?.modes.length ? " Pull back, or take another mode." : " Pull back.";
    this.app.note(event ? EVENTS[event.kind] + on : "", event?.kind === "stopped" || event?.kind === "crossing" ? "note" : "alarm");
    this.mapSoon(!this.pulling);
  }

  /** Takes hold of another mode. @param {number} index */
  hold(index) {
    if (index < this.tones.length) this.do({ take: this.tones[index], book: true });
  }

  /** @param {Pull} pull @param {boolean} done whether this is all of it @returns {Wish} */
  wish(pull, done) {
    return { pull, key: `${pull.handle} ${pull.leg ?? pull.number ?? ""}`, drag: !done, book: done };
  }

  /** @param {Pull} pull @param {boolean} [done] whether this is all of it */
  pull(pull, done = false) {
    this.pulling = !done;
    return this.do(this.wish(pull, done));
  }

  /** A number that was typed; whoever typed it learns of a refusal. @param {Pull} pull */
  async give(pull) {
    this.pulling = false;
    try {
      await this.moves.push(this.wish(pull, true));
    } catch (error) {
      this.app.fail(error);
      throw error;
    }
  }

  /** @param {string} key @param {Point} to */
  pullHandle(key, to) {
    const [handle, leg] = key.split(":");
    if (leg === undefined) return this.pull({ handle, to });
    const number = Number(leg);
    const from = this.answer?.handles.find((other) => other.handle === handle && other.leg === number)?.from;
    return this.pull({ handle, leg: number, to, from });
  }

  /** Takes the platform to a number typed. @param {number} axis of the pose @param {number} value */
  moveTo(axis, value) {
    const { mode } = this.state;
    if (!mode || !Number.isFinite(value)) return Promise.reject();
    const to = [...mode.pose];
    to[axis] = axis === 2 ? radians(value) : value;
    return this.give({ handle: "place", to });
  }

  // Slow answers: curves and maps, only where something they depend on has changed.

  async askSlowly() {
    if (!this.shown) return;
    const { model, inputs, mode, pair } = this.state;
    const others = inputs.filter((_, k) => !pair.includes(k));
    const size = this.pulling ? CELLS.moving : CELLS.still;
    const plane = await this.renewed("plane", [model, others, pair, size, document.documentElement.dataset.theme], { model, inputs, pair, size: [size, size] });
    if (plane !== undefined) {
      this.plane.draw(plane, this.answer?.actuators ?? []);
      this.plane.point(this.state.inputs);
    }
    const phi = mode?.pose[2];
    const loci = this.state.loci && mode ? await this.renewed("loci", [model, phi, mode.signs], { model, phi, signs: mode.signs }) : undefined;
    if (loci !== undefined) {
      this.loci = loci;
      this.app.schedule();
    }
    await this.askRegion();
    // What changed meanwhile asks again by itself; at rest the map is asked for in full.
    if (this.shown && !this.pulling && size === CELLS.moving) this.slow.push(null);
  }

  /** A workspace that is not asked for with each move. */
  async askRegion() {
    const wish = this.workspaceWish();
    if (!this.shown || !wish || this.region || this.regionError) return;
    const about = this.regionAbout();
    const { model, mode } = this.state;
    /** @type {Region | { error: string }} */
    let region;
    try {
      region = await this.app.connection.ask("workspace", { model, pose: mode?.pose, workspace: wish });
    } catch (error) {
      // Without a server there is none yet; refused, there is a reason.
      if (error instanceof Unanswered) return;
      if (!(error instanceof Refused)) throw error;
      region = { error: error.message };
    }
    if (!this.answer || about !== this.regionAbout()) return;
    this.answer.workspace = region;
    this.takeRegion(region, about);
    if (this.shown) this.app.schedule();
  }

  /** The answer where it may have changed; undefined where it has not, null where there is none. @param {string} kind @param {unknown} about @param {object} question */
  async renewed(kind, about, question) {
    const key = JSON.stringify(about);
    if (this.known.get(kind) === key) return undefined;
    try {
      const answer = await this.app.connection.ask(kind, question);
      this.known.set(kind, key);
      return this.shown ? answer : undefined;
    } catch (error) {
      if (!this.shown) return undefined;
      this.app.fail(error);
      if (!(error instanceof Refused)) return undefined;
      this.known.set(kind, key);
      return null;
    }
  }

  async prove() {
    const { model, inputs } = this.state;
    const key = this.proofKey();
    this.provedKey = key;
    this.proof.replaceChildren(html("p", { class: "quiet" }, ["proving …"]));
    try {
      const { report } = await this.app.connection.ask("prove", { model, inputs });
      // What was pulled meanwhile is not what was proved.
      if (!this.shown || !this.stillProved(key)) return;
      const verdicts = report.modes.map((/** @type {import("./types.js").Mode} */ mode, /** @type {number} */ k) => `${k + 1} ${mode.proof}`).join(", ");
      this.proof.replaceChildren(
        html("p", { class: report.certificate.complete ? "tag good" : "tag bad" }, [report.certificate.summary]),
        html("p", { class: "tag" }, [verdicts || "no mode"]),
      );
    } catch (error) {
      if (!this.shown) return;
      if (this.provedKey === key) this.proof.replaceChildren();
      this.app.fail(error);
    }
  }

  proofKey() {
    return JSON.stringify([this.state.model, this.state.inputs]);
  }

  /** Whether a proof is of what is shown; one that is not is taken away. @param {string} key */
  stillProved(key) {
    if (this.provedKey !== key) return false;
    if (key === this.proofKey()) return true;
    this.provedKey = "";
    this.proof.replaceChildren();
    return false;
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
      for (const point of this.region.isolated) shapes.push({ class: "region-point", points: [point], closed: true });
    }
    if (this.loci && this.state.loci && this.state.mode) {
      for (const mode of this.loci.report.type_2.modes) for (const points of mode.pieces) shapes.push({ class: "locus-2", points, closed: false });
      for (const points of this.loci.type_1.flat()) shapes.push({ class: "locus-1", points, closed: false });
    }
    stage.background(shapes);
    const held = answer.event && answer.event.kind !== "stopped" ? [answer.event.pose] : [];
    stage.rings([...held, ...answer.ended].map((pose) => [pose[0], pose[1]]));
    stage.handles(answer.handles.map(({ handle, leg, at, origin, from }) => ({
      key: leg === undefined ? handle : `${handle}:${leg}`, label: leg === undefined ? HANDLES[handle] : `${HANDLES[handle]} ${leg + 1}`, at, origin, from, axis: handle.endsWith("axis") || handle === "turn",
      body: handle === "pose",
    })));
    const { account } = answer.report;
    app.caption(answer.model.name || answer.family, `${answer.family}, ${count(answer)}, degree ${account.degree}`);
    // Numbers that change sixty times a second cannot be read.
    this.numbersSoon(!this.pulling);
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
    const region = this.region ? [...this.region.loops.flat(), ...this.region.separating.flat(), ...this.region.isolated] : [];
    this.app.stage.fit([...bases, ...handles, ...near, ...region]);
  }

  toggleLoci() {
    this.state.loci = !this.state.loci;
    this.showLoci();
    if (this.state.loci && !this.state.mode) this.app.say("No mode is held, so there is no orientation to show singular positions of.");
    this.mapSoon(true);
    this.app.schedule();
    this.app.book();
  }

  showLoci() {
    this.lociButton.setAttribute("aria-pressed", String(this.state.loci));
    this.lociButton.textContent = this.state.loci ? "hide" : "show";
  }

  workspaceWish() {
    const { kind, from, to } = this.state.workspace;
    return kind ? { kind, from, to } : null;
  }

  drawPanels() {
    const { answer } = this;
    if (!answer || !this.shown) return;
    if (this.actuators.length !== answer.actuators.length) {
      this.inputs.replaceChildren();
      this.actuators = answer.actuators.map((actuator, k) => this.actuator(actuator, k));
    }
    this.actuators.forEach(({ draw }, k) => draw(answer.actuators[k], answer.inputs[k]));
    const { account, modes } = answer.report;
    const others = Math.max(0, account.degree - account.real - account.complex);
    this.account.draw(
      [...Array(account.real).fill("real"), ...Array(account.complex).fill("complex"), ...Array(others).fill("other")],
      `of degree ${account.degree}: ${account.real} real, ${account.complex} complex`,
    );
    const rest = [[account.complex, "complex"], [account.at_infinity, "at infinity"], [account.rejected, "rejected"], [account.self_motion, "on a self-motion"], [account.undecided, "undecided"]];
    const parts = rest.filter(([n]) => n).map(([n, name]) => `${n} ${name}`);
    write(this.summary, `${account.real} real${parts.length ? `, ${parts.join(", ")}` : ""}, of degree ${account.degree}`);
    this.list.draw(modes.map((mode, k) => ({
      tone: this.tones[k] % TONES, text: `φ ${number(Number(degrees(mode.pose[2]).toFixed(2)))}°`, held: k === answer.current,
      warning: [mode.multiplicity > 1 ? `${mode.multiplicity}-fold` : "", mode.violations.length ? "outside limits" : ""].filter(Boolean).join(", "),
      tag: (mode.signs ?? "").replaceAll("-", "−"), title: `det A = ${mode.det_a.toExponential(3)}`,
    })));
    this.drawPose(answer);
    this.circle.draw(answer.report, answer.current, this.tones.map((tone) => tone % TONES));
    this.plane.point(answer.inputs);
    this.drawRegion(answer);
    if (this.provedKey) this.stillProved(this.provedKey);
  }

  /** @param {Moved} answer */
  drawRegion(answer) {
    const { kind } = this.state.workspace;
    const region = kind ? this.region : null;
    this.range.hidden = !["inclusive", "total"].includes(kind);
    this.regionFacts.element.hidden = !region;
    if (region) this.regionFacts.draw([["area", number(region.area)], ["perimeter", number(region.perimeter)], ["pieces, holes", `${region.components}, ${region.holes}`]]);
    const alone = region ? region.isolated.length : 0;
    const points = `${alone} single point${alone === 1 ? "" : "s"}`;
    const empty = alone ? `No area, ${points}.` : "Empty: no place is reached so.";
    const word = !kind ? "" : !region ? this.regionError || "computing …"
      : region.unclosed > 0 ? "Undecided: the digits do not suffice to close its boundary, so the numbers lack a part."
      : region.loops.length === 0 ? (region.separating.length ? "No area, lines only." : empty) : alone ? `And ${points}.` : "";
    write(this.regionWord, word);
    set(this.regionWord, "class", this.regionError || region?.unclosed ? "tag bad" : "tag");
    this.regionWord.hidden = word === "";
    this.bound.hidden = !kind || !this.regionError || answer.actuators.every((actuator) => actuator.limited);
  }

  /** @param {Moved} answer */
  drawPose(answer) {
    const mode = answer.current === null ? null : answer.report.modes[answer.current];
    this.place.forEach((field, k) => {
      field.element.disabled = !mode;
      field.show(mode ? String(Number((k === 2 ? degrees(mode.pose[2]) : mode.pose[k]).toPrecision(8))) : "");
    });
    const without = answer.report.modes.length ? "take one above" : "there is none";
    this.poseFacts.draw(mode ? [["working mode", (mode.signs ?? "").replaceAll("-", "−")], ["det A, zero where modes meet", number(mode.det_a)]] : [["no mode is held", without]]);
  }

  /** The row of an actuator. @param {Actuator} actuator @param {number} k */
  actuator(actuator, k) {
    const value = (/** @type {number} */ shown) => (actuator.angle ? radians(shown) : shown);
    const shown = (/** @type {number} */ q) => (actuator.angle ? degrees(q) : q);
    const slider = html("input", { type: "range", "aria-label": `Actuator ${k + 1}` });
    onSlide(slider, () => this.pull({ handle: "input", number: k, value: value(slider.valueAsNumber) }), () => this.drop());
    const field = new NumberField(`Actuator ${k + 1}, number`, (given) => (Number.isFinite(given) ? this.give({ handle: "input", number: k, value: value(given) }) : Promise.reject()));
    /** @type {NumberField[]} */
    const ends = ["lower", "upper"].map((end, side) => new NumberField(`Actuator ${k + 1}, ${end} limit`, () => {
      const range = ends.map(({ element }) => element.valueAsNumber);
      const free = ends.every(({ element }) => element.value === "");
      if (!free && !range.every(Number.isFinite)) {
        this.app.say(`A limit has two ends: give the ${side === 0 ? "upper" : "lower"} one too, or empty both for none.`);
        return "more";
      }
      const given = this.give({ handle: "limits", number: k, range: free ? null : range.map(value) });
      // With this end the other is answered as well.
      const other = ends[1 - side];
      const text = other.element.value;
      given.then(() => other.answered(text), () => other.answered(text) && other.show(other.shown));
      return given;
    }));
    ends.forEach(({ element }) => Object.assign(element, { title: "Limits; empty both for none", placeholder: "none" }));
    this.inputs.append(html("div", { class: "actuator", title: `leg ${actuator.leg}, joint ${actuator.joint}` }, [
      html("span", {}, [`q${k + 1}  ${actuator.angle ? "turn" : "slide"}`]), slider, field.element, html("span", { class: "quiet" }, [actuator.angle ? "°" : ""]),
      html("div", { class: "ends" }, ["from ", ends[0].element, " to ", ends[1].element]),
    ]));
    const draw = (/** @type {Actuator} */ now, /** @type {number} */ q) => {
      const [low, high] = now.range.map(shown);
      set(slider, "min", String(low));
      set(slider, "max", String(high));
      set(slider, "step", String((high - low) / 2000));
      const text = String(shown(q));
      // Under the pointer it is where the pointer has it.
      if (!(this.pulling && document.activeElement === slider)) slider.value = text;
      field.show(String(Number(shown(q).toPrecision(7))));
      ends.forEach((end, side) => end.show(now.limited ? String(Number([low, high][side].toPrecision(7))) : ""));
    };
    return { slider, field, ends, draw };
  }
}

/** Whether two inputs are one, angles but for whole turns. @param {number} p @param {number} q @param {boolean} angle */
const same = (p, q, angle) => p === q || (angle && Math.abs(Math.sin((p - q) / 2)) < 1e-12);

/** @param {object | null} pull */
const changesLimits = (pull) => pull !== null && "handle" in pull && ["limits", "bound", "design"].includes(String(pull.handle));

/** @param {Moved} answer */
function count(answer) {
  const n = answer.report.modes.length;
  if (answer.report.status === "self_motion") return "a self-motion";
  return n === 0 ? "no assembly mode" : n === 1 ? "1 assembly mode" : `${n} assembly modes`;
}
