// The page of four-bars: the coupler curve with its circuits, and the linkage that draws it.

import { latest } from "./connection.js";
import { button, facts, panel } from "./panels.js";
import { html } from "./svg.js";

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

export class FourBarPage {
  /** @param {App} app @param {FourBarState} state */
  constructor(app, state) {
    this.app = app;
    this.state = state;
    /** @type {FourBarAnswer | null} */
    this.answer = null;
    this.playing = false;
    this.moves = latest((/** @type {{ pull: object | null, fit?: boolean, book?: boolean }} */ wish) => this.move(wish));
    this.facts = html("div");
    this.slider = html("input", { type: "range", min: 0, max: TURN, step: TURN / 2000, "aria-label": "Place on the circuit" });
    this.slider.addEventListener("input", () => {
      this.playing = false;
      this.state.place = { circuit: this.state.place.circuit, tau: this.slider.valueAsNumber };
      this.moves.push({ pull: null });
    });
    this.slider.addEventListener("change", () => this.drop());
    this.circuits = html("ul", { class: "modes" });
    this.playButton = button("run", () => this.play(), { id: "run" });
    this.app.panels(
      panel("Place on the circuit", [html("div", { class: "actuator one" }, [html("span", {}, ["τ"]), this.slider])], [this.playButton]),
      panel("Circuits", [this.circuits]),
      panel("Curve", [this.facts]),
      panel("Design", [button("Edit as text …", () => this.app.edit(), { id: "edit" })]),
    );
  }

  /** @param {boolean} _pick @param {boolean} fit */
  begin(_pick, fit) {
    this.moves.push({ pull: null, fit });
    return this.moves.settled();
  }

  /** @param {{ pull: object | null, fit?: boolean, book?: boolean }} wish */
  async move({ pull, fit = false, book = false }) {
    try {
      /** @type {FourBarAnswer} */
      const answer = await this.app.connection.ask("four_bar", { file: this.state.file, place: this.state.place, pull });
      this.answer = answer;
      this.state.file = answer.file;
      this.state.place = answer.place;
      if (fit) this.fit();
      this.app.schedule();
      this.app.say("");
      if (book) this.app.book();
    } catch (error) {
      this.app.fail(error);
    }
  }

  grab() {
    this.playing = false;
  }

  /** @param {string} key @param {Point} to */
  pullHandle(key, to) {
    const [handle, side] = key.split(":");
    this.moves.push({ pull: side === undefined ? { handle, to } : { handle, side: Number(side), to } });
  }

  async drop() {
    await this.moves.settled();
    this.app.book();
  }

  /** @param {number} index a circuit */
  hold(index) {
    if (!this.answer || index >= this.answer.circuits.length) return;
    this.state.place = { circuit: index, tau: this.state.place.tau };
    this.moves.push({ pull: null, book: true });
  }

  play() {
    this.playing = !this.playing;
    let before = performance.now();
    const step = (/** @type {number} */ now) => {
      this.playButton.textContent = this.playing ? "stop" : "run";
      if (!this.playing) return;
      const { circuit, tau } = this.state.place;
      this.state.place = { circuit, tau: (tau + ((now - before) / 1000 / TOUR) * TURN) % TURN };
      before = now;
      this.moves.push({ pull: null });
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
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
    app.caption("Coupler curve", `${answer.report.grashof ?? "slider"}, ${n} circuit${n === 1 ? "" : "s"}`);
    if (document.activeElement !== this.slider) this.slider.value = String(place.tau);
    this.circuits.replaceChildren(...answer.circuits.map((_, k) => {
      const row = html("button", { "data-tone": (k + 1) % 6, "aria-pressed": String(k === place.circuit) }, [
        html("span", { class: "swatch" }, [html("b", {}, [String(k + 1)])]), html("span", { class: "text" }, [`circuit ${k + 1}`]),
      ]);
      row.addEventListener("click", () => this.hold(k));
      return html("li", {}, [row]);
    }));
    const real = answer.report.double_points?.filter((double) => double.point) ?? [];
    this.facts.replaceChildren(facts([
      ["class", answer.report.grashof ?? "with a slider"],
      ["degree", "6"],
      ["real double points", answer.report.double_points ? String(real.length) : "every point"],
      ["cognates", String(answer.report.cognates.length)],
    ]));
  }
}
