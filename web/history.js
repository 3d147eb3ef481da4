// Undo, redo, and the state in the address, so that a link shows the same mechanism.

import { WORKSPACES } from "./manipulator.js";

/** @typedef {import("./types.js").State} State @typedef {"undo" | "redo"} Way */
/** @typedef {{ state: State, fresh: boolean }} Step A state, and whether it began anew: from a file, a family or another page. */

/** Steps kept. */
const MOST = 200;
/** Browsers refuse a page that changes its address too often; then it is tried again, in milliseconds. */
const AGAIN = 1000;

export class History {
  constructor() {
    /** @type {Step[]} */
    this.past = [];
    /** @type {Step[]} */
    this.future = [];
    /** @type {Step | null} */
    this.now = null;
    this.timer = 0;
  }

  /** Books a state that the user has arrived at. @param {State} state @param {boolean} fresh @returns {boolean} whether it is another one */
  book(state, fresh) {
    const text = JSON.stringify(state);
    if (this.now && JSON.stringify(this.now.state) === text) return false;
    if (this.now) this.past.push(this.now);
    if (this.past.length > MOST) this.past.shift();
    this.future = [];
    this.now = { state: JSON.parse(text), fresh };
    return true;
  }

  /** Where a step would lead, and whether to something else altogether. @param {Way} way @returns {Step | null} */
  next(way) {
    const next = this[way === "undo" ? "past" : "future"].at(-1);
    if (!next || !this.now) return null;
    return { state: next.state, fresh: way === "undo" ? this.now.fresh : next.fresh };
  }

  /** Takes the step, once what it leads to is shown. @param {Way} way */
  step(way) {
    const [from, to] = way === "undo" ? [this.past, this.future] : [this.future, this.past];
    const next = from.pop();
    if (!next || !this.now) return;
    to.push(this.now);
    this.now = next;
    this.write();
  }

  /** Puts the state into the address. */
  write() {
    clearTimeout(this.timer);
    if (!this.now) return;
    try {
      history.replaceState(null, "", `#${encode(this.now.state)}`);
    } catch {
      this.timer = setTimeout(() => this.write(), AGAIN);
    }
  }
}

/** @param {State} state */
export function encode(state) {
  const bytes = new TextEncoder().encode(JSON.stringify(state));
  const letters = Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
  return btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/** The state in an address; null where it is none. @param {string} hash @returns {State | null} */
export function decode(hash) {
  try {
    const letters = atob(hash.replace(/^#/, "").replaceAll("-", "+").replaceAll("_", "/"));
    const state = JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(Uint8Array.from(letters, (letter) => letter.charCodeAt(0))));
    return isState(state) ? state : null;
  } catch {
    return null;
  }
}

/** Whether it has the parts of a state; what they mean, the server judges. @param {any} state @returns {state is State} */
function isState(state) {
  const table = (/** @type {unknown} */ value) => typeof value === "object" && value !== null && !Array.isArray(value);
  const numbers = (/** @type {unknown} */ list, /** @type {number} */ count) => Array.isArray(list) && list.length === count && list.every(Number.isFinite);
  if (!table(state)) return false;
  const { page, file, place, model, inputs, mode, workspace, loci, pair } = state;
  if (page === "truss") return table(file);
  if (page === "four_bar") return table(file) && table(place) && Number.isInteger(place.circuit) && place.circuit >= 0 && Number.isFinite(place.tau);
  return page === "manipulator" && table(model) && Array.isArray(inputs) && numbers(inputs, inputs.length)
    && (mode === null || (table(mode) && numbers(mode.pose, 3) && typeof mode.signs === "string"))
    && table(workspace) && WORKSPACES.some(([kind]) => kind === workspace.kind) && numbers([workspace.from, workspace.to], 2) && typeof loci === "boolean"
    && ["0,1", "0,2", "1,2"].includes(String(pair));
}
