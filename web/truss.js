// The page of trusses: all assemblies of an Assur group with its ground.

import { Page } from "./page.js";
import { Cells, Facts, Rows, button, panel } from "./panels.js";
import { number } from "./svg.js";

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

/** @extends {Page<TrussState, TrussAnswer>} */
export class TrussPage extends Page {
  /** @param {App} app @param {TrussState} state */
  constructor(app, state) {
    super(app, state);
    this.account = new Cells();
    this.facts = new Facts();
    this.list = new Rows((k) => this.hold(k));
    this.panels = [
      panel("Assemblies", [this.account.element, this.facts.element, this.list.element]),
      panel("Design", [button("Edit as text …", () => this.app.edit(), { id: "edit" })]),
    ];
  }

  /** @param {import("./types.js").Wish} wish */
  async ask({ pull = null, take }) {
    /** @type {TrussAnswer} */
    const answer = await this.app.connection.ask("truss", { file: this.state.file, pull, take });
    this.answer = answer;
    this.state.file = answer.file;
    return "";
  }

  /** @param {string} key @param {Point} to */
  pullHandle(key, to) {
    this.do({ pull: { joint: Number(key.split(":")[1]), to }, key, drag: true });
  }

  /** @param {number} index */
  hold(index) {
    if (this.answer && index < this.answer.drawings.length) this.do({ take: index, book: true });
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
    app.caption(answer.file.name || (report.truss ? `Baranov truss ${report.truss}` : "Assur group"), `${real} real of ${report.count} assemblies`);
    this.account.draw(Array.from({ length: report.count }, (_, k) => (k < real ? "real" : "complex")), `${real} real of ${report.count}`);
    const missing = report.missing === null ? "not known" : String(report.missing);
    const worst = report.assemblies.reduce((most, assembly) => Math.max(most, assembly.residual), 0);
    this.facts.draw([["real", String(real)], ["real and complex", String(report.count)], ["for general dimensions", String(report.expected ?? "not known")], ["not found", missing], ["worst residual", number(worst)]]);
    this.list.draw(drawings.map((_, k) => ({ tone: k % TONES, text: `assembly ${k + 1}`, held: k === current })));
  }
}
