// What the pages have in common: one queue of wishes, and that a page which is not shown says and draws nothing.

import { inOrder } from "./queue.js";

/**
 * @typedef {import("./types.js").Point} Point
 * @typedef {import("./types.js").Wish} Wish
 */

/**
 * @template {import("./types.js").State} S
 * @template A
 */
export class Page {
  /** @param {import("./main.js").App} app @param {S} state */
  constructor(app, state) {
    this.app = app;
    this.state = state;
    /** @type {A | null} */
    this.answer = null;
    /** @type {Node[]} */
    this.panels = [];
    this.pulling = false;
    this.moves = inOrder((/** @type {Wish} */ wish) => this.carryOut(wish), (wish, before) => Boolean(wish.drag && before.drag && wish.key === before.key));
  }

  get shown() {
    return /** @type {unknown} */ (this.app.page) === this;
  }

  /** The first question, before the page is shown. Refused, it throws, and nothing has happened. @param {boolean} pick whether a mode is taken where none is held */
  async begin(pick) {
    await this.ask({ pick });
  }

  /** Another page has taken its place. */
  leave() {
    this.pulling = false;
  }

  /** Asks, and takes the answer in; gives what there is to say about it. @param {Wish} _wish @returns {Promise<string>} */
  async ask(_wish) {
    throw new Error("each page asks its own questions");
  }

  /** After an answer, or the end of a pull, on the page that is shown. */
  tell() {}

  /** @param {Wish} wish */
  async carryOut(wish) {
    if (!this.shown) return;
    if (!wish.end) {
      const said = await this.ask(wish);
      if (!this.shown) return;
      this.app.timing();
      // What runs by itself leaves the line to the user's own doings.
      if (!wish.quiet) this.app.say(said);
    }
    this.tell();
    this.app.schedule();
    if (wish.book || wish.end) this.app.book();
  }

  /** Has a wish carried out after those before it, and says why if it cannot be. @param {Wish} wish */
  do(wish) {
    return this.moves.push(wish).catch((error) => this.app.fail(error));
  }

  /** @param {string} _key */
  grab(_key) {
    this.pulling = true;
  }

  /** A pull has ended. */
  drop() {
    this.pulling = false;
    return this.do({ end: true });
  }
}
