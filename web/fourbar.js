// The page of four-bars: the coupler curve with its circuits, and the linkage that draws it.

import { Page } from "./page.js";
import { Facts, Rows, button, onSlide, panel } from "./panels.js";
import { html, write } from "./svg.js";

/**
 * @typedef {import("./types.js").FourBarState} FourBarState
 * @typedef {import("./types.js").FourBarAnswer} FourBarAnswer
 * @typedef {import("./types.js").Point} Point
 * @typedef {import("./types.js").Mark} Mark
 * @typedef {import("./main.js").App} App
 */

/** A crank-rocker with a curve of two circuits, one of them with a double point. */
export const FIRST = { schema: "assur/coupler/1", fourbar: { a: [0, 0], b: [4, 0], p: [-1, -1.4], q: [2, -1.4], r: 1.2, s: 3 } };

const TURN = 2 * Math.PI;
/** A tour of one circuit takes so many seconds. */
const TOUR = 6;
const LABELS = /** @type {Record<string, string>} */ ({ "pivot:0": "left pivot", "pivot:1": "right pivot", "joint:0": "left joint", "joint:1": "right joint", point: "coupler point" });

/** @extends {Page<FourBarState, FourBarAnswer>} */
export class FourBarPage extends Page {
  /** @param {App} app @param {FourBarState} state */
  constructor(app, state) {
    super(app, state);
    this.playing = false;
    this.facts = new Facts();
    this.slider = html("input", { type: "range", min: 0, max: TURN, step: TURN / 2000, "aria-label": "Place on the circuit" });
    onSlide(this.slider, () => {
      this.stop();
      this.pulling = true;
      this.do({ place: { tau: this.slider.valueAsNumber }, key: "tau", drag: true });
    }, () => this.drop());
    this.circuits = new Rows((k) => this.hold(k));
    this.playButton = button("run", () => this.play(), { id: "run" });
    this.panels = [
      panel("Place on the circuit", [html("div", { class: "actuator one" }, [html("span", {}, ["τ"]), this.slider])], [this.playButton]),
      panel("Circuits", [this.circuits.element]),
      panel("Curve", [this.facts.element]),
      panel("Design", [button("Edit as text …", () => this.app.edit(), { id: "edit" })]),
    ];
  }

  leave() {
    super.leave();
    this.stop();
  }

  /** @param {import("./types.js").Wish} wish */
  async ask({ pull = null, place }) {
    /** @type {FourBarAnswer} */
    const answer = await this.app.connection.ask("four_bar", { file: this.state.file, place: { ...this.state.place, ...place }, pull });
    this.answer = answer;
    this.state.file = answer.file;
    this.state.place = answer.place;
    return "";
  }

  /** @param {string} key */
  grab(key) {
    super.grab(key);
    this.stop();
  }

  /** @param {string} key @param {Point} to */
  pullHandle(key, to) {
    const [handle, side] = key.split(":");
    this.do({ pull: side === undefined ? { handle, to } : { handle, side: Number(side), to }, key, drag: true });
  }

  /** @param {number} index a circuit */
  hold(index) {
    if (this.answer && index < this.answer.circuits.length) this.do({ place: { circuit: index }, book: true });
  }

  play() {
    if (this.playing) {
      this.stop();
      this.drop();
      return;
    }
    this.playing = true;
    write(this.playButton, "stop");
    let before = performance.now();
    const step = (/** @type {number} */ now) => {
      if (!this.playing) return;
      const tau = (this.state.place.tau + ((now - before) / 1000 / TOUR) * TURN) % TURN;
      before = now;
      this.do({ place: { tau }, key: "tau", drag: true, quiet: true });
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  stop() {
    this.playing = false;
    write(this.playButton, "run");
  }

  fit() {
    const { answer } = this;
    if (answer) this.app.stage.fit([...answer.circuits.flat(), ...answer.pivots, ...(answer.joints ?? [])]);
  }

  draw() {
    const { answer, app } = this;
    if (!answer) return;
    const { joints, point, pivots, place } = answer;
    /** @type {Mark[]} */
    const marks = pivots.map((at) => ({ mark: "ground", at: [at] }));
    const look = { actuated: false, violated: false };
    if (joints && point) {
      marks.push({ mark: "body", at: [...joints, point] });
      pivots.forEach((pivot, k) => marks.push({ mark: "bar", at: [pivot, joints[k]] }));
      for (const at of [...joints, point]) marks.push({ mark: "pin", at: [at], look });
    }
    pivots.forEach((at, k) => marks.push({ mark: "pin", at: [at], look: { actuated: k === 0, violated: false } }));
    app.stage.draw([{ tone: 0, label: "", ghost: false, marks, name: null }]);
    app.stage.background(answer.circuits.map((points, k) => ({ class: `curve@${(k + 1) % 6}`, points, closed: true })));
    app.stage.rings([]);
    const grips = [
      ...pivots.map((at, k) => ({ key: `pivot:${k}`, at })), ...(joints ?? []).map((at, k) => ({ key: `joint:${k}`, at })), ...(point ? [{ key: "point", at: point }] : []),
    ];
    app.stage.handles(grips.map(({ key, at }) => ({ key, at, label: LABELS[key] })));
    const n = answer.circuits.length;
    app.caption(answer.file.name || "Coupler curve", `${answer.report.grashof ?? "slider"}, ${n} circuit${n === 1 ? "" : "s"}`);
    if (!(this.pulling && document.activeElement === this.slider)) this.slider.value = String(place.tau);
    this.circuits.draw(answer.circuits.map((_, k) => ({ tone: (k + 1) % 6, text: `circuit ${k + 1}`, held: k === place.circuit })));
    const real = answer.report.double_points?.filter((double) => double.point) ?? [];
    this.facts.draw([
      ["class", answer.report.grashof ?? "with a slider"],
      ["degree", "6"],
      ["real double points", answer.report.double_points ? String(real.length) : "every point"],
      ["cognates", String(answer.report.cognates.length)],
    ]);
  }
}
