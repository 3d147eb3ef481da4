// The eliminant's roots: theta = e^(i phi). Real modes stand on the unit circle, the others in pairs inside and outside of it.

import { set, svg } from "./svg.js";

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
    this.complex = svg("g", {}, this.element);
    this.real = svg("g", {}, this.element);
  }

  /** @param {ForwardReport} report @param {number | null} current @param {number[]} tones */
  draw(report, current, tones) {
    const at = (/** @type {[number, number]} */ [re, im]) => {
      const size = Math.hypot(re, im);
      const shrunk = size > FARTHEST ? FARTHEST / size : 1;
      return [SIZE / 2 + re * shrunk * RIM, HEIGHT / 2 - im * shrunk * RIM].map((v) => v.toFixed(1));
    };
    while (this.complex.children.length > report.complex.length) this.complex.lastChild?.remove();
    report.complex.forEach((root, k) => {
      const [x, y] = at(root.theta);
      set(this.complex.children[k] ?? svg("path", { class: "cross", d: "M-4 -4l8 8m0 -8l-8 8" }, this.complex), "transform", `translate(${x} ${y})`);
    });
    while (this.real.children.length > report.modes.length) this.real.lastChild?.remove();
    report.modes.forEach((mode, k) => {
      let dot = this.real.children[k];
      if (!dot) {
        dot = svg("circle", {}, this.real);
        svg("title", {}, dot).textContent = `mode ${k + 1}`;
      }
      const [x, y] = at([Math.cos(mode.pose[2]), Math.sin(mode.pose[2])]);
      set(dot, "class", `real${k === current ? " current" : ""}`);
      set(dot, "cx", x);
      set(dot, "cy", y);
      set(dot, "r", k === current ? "7" : "5.5");
      set(dot, "data-tone", String(tones[k]));
    });
    const [real, others] = [report.modes.length, report.complex.length];
    set(this.element, "aria-label", `${real} roots on the unit circle, ${others} off it`);
  }
}
