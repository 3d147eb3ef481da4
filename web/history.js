// Undo, redo, and the state in the address, so that a link shows the same view.

/** @typedef {import("./types.js").State} State */

/** Steps kept. */
const MOST = 200;

export class History {
  constructor() {
    /** @type {State[]} */
    this.past = [];
    /** @type {State[]} */
    this.future = [];
    /** @type {State | null} */
    this.now = null;
  }

  /** Books a state that the user has arrived at. @param {State} state */
  book(state) {
    const text = JSON.stringify(state);
    if (this.now && JSON.stringify(this.now) === text) return;
    if (this.now) this.past.push(this.now);
    if (this.past.length > MOST) this.past.shift();
    this.future = [];
    this.now = JSON.parse(text);
    this.write();
  }

  undo() {
    return this.step(this.past, this.future);
  }

  redo() {
    return this.step(this.future, this.past);
  }

  /** @param {State[]} from @param {State[]} to @returns {State | null} */
  step(from, to) {
    const state = from.pop();
    if (!state || !this.now) return null;
    to.push(this.now);
    this.now = state;
    this.write();
    return JSON.parse(JSON.stringify(state));
  }

  write() {
    if (this.now) history.replaceState(null, "", `#${encode(this.now)}`);
  }
}

/** @param {State} state */
export function encode(state) {
  const bytes = new TextEncoder().encode(JSON.stringify(state));
  const letters = Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
  return btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/** The state in an address, or null where there is none. @param {string} hash @returns {State | null} */
export function decode(hash) {
  try {
    const letters = atob(hash.replace(/^#/, "").replaceAll("-", "+").replaceAll("_", "/"));
    const state = JSON.parse(new TextDecoder().decode(Uint8Array.from(letters, (letter) => letter.charCodeAt(0))));
    const known = ["manipulator", "four_bar", "truss"].includes(state.page);
    return known ? state : null;
  } catch {
    return null;
  }
}
