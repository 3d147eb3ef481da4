// The eliminant's roots: theta = e^(i phi). Real modes stand on the unit circle, the others in pairs inside and outside of it.

import { svg } from "./svg.js";

/** @typedef {import("./types.js").ForwardReport} ForwardReport */

const SIZE = 300;
const HEIGHT = 214;
const RIM = 62;
/** Roots farther out than this, in radii, are drawn at it. */
const FARTHEST = 1.55;

export class Circle {
  constructor() {
    this.element = svg("svg", { class: "plot", viewBox: `0 0 ${SIZE} ${HEIGHT}`, role: "img" });
    const [x, y] = [SIZE / 2, HEIGHT / 2];
    svg("path", { class: "thin", d: `M${x - RIM * FARTHEST} ${y}H${x + RIM * FARTHEST}M${x} ${y - RIM * FARTHEST}V${y + RIM * FARTHEST}` }, this.element);
    svg("circle", { class: "rim", cx: x, cy: y, r: RIM }, this.element);
    for (const [text, dx, dy] of /** @type {[string, number, number][]} */ ([["0°", RIM + 6, -5], ["90°", 5, -RIM - 5], ["180°", -RIM - 32, -5], ["−90°", 5, RIM + 13]])) {
      svg("text", { x: x + dx, y: y + dy }, this.element).textContent = text;
    }
    this.roots = svg("g", {}, this.element);
  }

  /** @param {ForwardReport} report @param {number | null} current @param {number[]} tones */
  draw(report, current, tones) {
    this.roots.replaceChildren();
    const at = (/** @type {[number, number]} */ [re, im]) => {
      const size = Math.hypot(re, im);
      const shrunk = size > FARTHEST ? FARTHEST / size : 1;
      return [SIZE / 2 + re * shrunk * RIM, HEIGHT / 2 - im * shrunk * RIM];
    };
    for (const root of report.complex) {
      const [x, y] = at(root.theta);
      svg("path", { class: "cross", d: `M${x - 4} ${y - 4}l8 8m0 -8l-8 8` }, this.roots);
    }
    report.modes.forEach((mode, k) => {
      const [x, y] = at([Math.cos(mode.pose[2]), Math.sin(mode.pose[2])]);
      const dot = svg("circle", { class: `real${k === current ? " current" : ""}`, cx: x, cy: y, r: k === current ? 7 : 5.5, "data-tone": tones[k] }, this.roots);
      svg("title", {}, dot).textContent = `mode ${k + 1}`;
    });
    const [real, others] = [report.modes.length, report.complex.length];
    this.element.setAttribute("aria-label", `${real} roots on the unit circle, ${others} off it`);
  }
}
