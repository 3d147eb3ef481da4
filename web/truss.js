// The page of trusses: all assemblies of an Assur group with its ground.

import { latest } from "./connection.js";
import { button, facts, panel } from "./panels.js";
import { html, number } from "./svg.js";

/**
 * @typedef {import("./types.js").TrussState} TrussState
 * @typedef {import("./types.js").TrussAnswer} TrussAnswer
 * @typedef {import("./types.js").Point} Point
 * @typedef {import("./main.js").App} App
 */

/** The seven-link truss 7#0 in general dimensions; 18 assemblies, many of them real. */
export const FIRST = {
  schema: "assur/group/1", links: 7, edges: [[0, 4], [1, 4], [2, 5], [3, 5], [4, 5], [0, 6], [1, 6], [2, 6], [3, 6]],
  joint_xy: [[3.50390625, 1.060546875], [2.44140625, -3.318359375], [0.30859375, -3.87890625], [2.802734375, -0.740234375], [1.798828125, -2.70703125], [3.392578125, -0.83203125], [3.40234375, -3.1796875], [1.71875, -1.935546875], [-0.546875, -1.427734375]],
  ground: 0,
};

const TONES = 6;

export class TrussPage {
  /** @param {App} app @param {TrussState} state */
  constructor(app, state) {
    this.app = app;
    this.state = state;
    /** @type {TrussAnswer | null} */
    this.answer = null;
    this.moves = latest((/** @type {{ pull: object | null, take?: number, fit?: boolean, book?: boolean }} */ wish) => this.move(wish));
    this.account = html("div", { class: "account", role: "img" });
    this.facts = html("div");
    this.list = html("ul", { class: "modes" });
    this.app.panels(
      panel("Assemblies", [this.account, this.facts, this.list]),
      panel("Design", [button("Edit as text …", () => this.app.edit(), { id: "edit" })]),
    );
  }

  /** @param {boolean} _pick @param {boolean} fit */
  begin(_pick, fit) {
    this.moves.push({ pull: null, fit });
    return this.moves.settled();
  }

  /** @param {{ pull: object | null, take?: number, fit?: boolean, book?: boolean }} wish */
  async move({ pull, take, fit = false, book = false }) {
    try {
      /** @type {TrussAnswer} */
      const answer = await this.app.connection.ask("truss", { file: this.state.file, pull, take });
      this.answer = answer;
      this.state.file = answer.file;
      if (fit) this.fit();
      this.app.schedule();
      this.app.say("");
      if (book) this.app.book();
    } catch (error) {
      this.app.fail(error);
    }
  }

  grab() {}

  /** @param {string} key @param {Point} to */
  pullHandle(key, to) {
    this.moves.push({ pull: { joint: Number(key.split(":")[1]), to } });
  }

  async drop() {
    await this.moves.settled();
    this.app.book();
  }

  /** @param {number} index */
  hold(index) {
    if (this.answer && index < this.answer.drawings.length) this.moves.push({ pull: null, take: index, book: true });
  }

  fit() {
    const { answer } = this;
    if (answer) this.app.stage.fit(answer.drawings.flat().flatMap((mark) => mark.at));
  }

  draw() {
    const { answer, app } = this;
    if (!answer) return;
    const { report, drawings, current } = answer;
    app.stage.draw(drawings.map((marks, k) => ({ tone: k % TONES, label: String(k + 1), ghost: k !== current, marks, name: null })));
    app.stage.background([]);
    app.stage.rings([]);
    app.stage.handles(answer.joints.map((at, k) => ({ key: `joint:${k}`, at, label: `joint ${k + 1}` })));
    const real = drawings.length;
    app.caption(report.truss ? `Baranov truss ${report.truss}` : "Assur group", `${real} real of ${report.count} assemblies`);
    this.account.replaceChildren(...Array.from({ length: report.count }, (_, k) => html("span", { class: k < real ? "real" : "complex" })));
    this.account.setAttribute("aria-label", `${real} real of ${report.count}`);
    const missing = report.missing === null ? "not known" : String(report.missing);
    const worst = report.assemblies.reduce((most, assembly) => Math.max(most, assembly.residual), 0);
    this.facts.replaceChildren(facts([["real", String(real)], ["real and complex", String(report.count)], ["for general dimensions", String(report.expected ?? "not known")], ["not found", missing], ["worst residual", number(worst)]]));
    this.list.replaceChildren(...drawings.map((_, k) => {
      const row = html("button", { "data-tone": k % TONES, "aria-pressed": String(k === current) }, [
        html("span", { class: "swatch" }, [html("b", {}, [String(k + 1)])]), html("span", { class: "text" }, [`assembly ${k + 1}`]),
      ]);
      row.addEventListener("click", () => this.hold(k));
      return html("li", {}, [row]);
    }));
  }
}
