// The frame: which page is shown, what the keys do, files, history, messages.

import { Connection, Refused, Unanswered } from "./connection.js";
import { download, fileName, picture, pixels } from "./exporting.js";
import { FIRST as FIRST_FOUR_BAR, FourBarPage } from "./fourbar.js";
import { History, decode } from "./history.js";
import { ManipulatorPage } from "./manipulator.js";
import { inOrder } from "./queue.js";
import { Stage } from "./stage.js";
import { byId, html, write } from "./svg.js";
import { FIRST as FIRST_TRUSS, TrussPage } from "./truss.js";

/**
 * @typedef {import("./types.js").State} State
 * @typedef {import("./types.js").ManipulatorState} ManipulatorState
 * @typedef {ManipulatorPage | FourBarPage | TrussPage} AnyPage
 * @typedef {{ kind: "manipulator", model: import("./types.js").Model, inputs: number[] } | { kind: "four_bar", file: object } | { kind: "truss", file: object }} Opened
 */

/** The time of answers is shown no more often than this, in milliseconds. */
const TIMING_PAUSE = 250;
/** An answer that takes longer than this, in milliseconds, is seen to be worked on. */
const LONG = 400;

export class App {
  constructor() {
    this.stage = new Stage(byId("stage"), {
      grab: (key) => {
        byId("hint").hidden = true;
        this.page?.grab(key);
      },
      pull: (key, to) => this.page?.pullHandle(key, to),
      drop: () => this.page?.drop(),
      take: (number) => this.page?.hold(number),
    });
    this.stage.redraw = () => this.schedule();
    this.scheduled = false;
    this.history = new History();
    /** @type {AnyPage | null} */
    this.page = null;
    /** @type {Map<string, State>} The last state of each page. */
    this.states = new Map();
    /** Ways from one page to another, and steps of undo: one after the other. */
    this.ways = inOrder((/** @type {() => Promise<unknown>} */ way) => this.go(way));
    this.title = "";
    /** Why the link that was followed last is not shown. */
    this.unread = "";
    /** What the file in the editor is called, for its ending. */
    this.editing = "model.toml";
    this.timed = 0;
    /** Whether the server has gone. */
    this.gone = false;
    /** @type {"connecting" | "open" | "closed"} */
    this.connected = "connecting";
    this.connection = new Connection((state, reason) => this.onConnection(state, reason));
    setInterval(() => this.showConnection(), TIMING_PAUSE);
    this.listen();
  }

  /** The first page: what the address holds, else what the server was started with. */
  async start() {
    const start = await this.connection.ask("start", {});
    this.connection.largest = start.largest_message;
    const families = start.families.map((/** @type {string} */ family) => html("option", { value: family }, [family]));
    byId("family").replaceChildren(byId("family").options[0], ...families);
    const linked = location.hash.length > 1;
    if (linked && (await this.follow())) return;
    await this.show(stateOf(start), { pick: true });
    // A link that cannot be shown stays as it is until the user does something else.
    this.book({ fresh: true, address: !linked });
    this.note(this.unread);
  }

  /** Shows what the address holds; what cannot be shown is said. @returns {Promise<boolean>} whether it is shown */
  async follow() {
    try {
      const state = decode(location.hash);
      if (!state) throw new Refused("it is damaged, or of another version");
      await this.show(state);
      this.book({ fresh: true });
      return true;
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      this.unread = `This link cannot be read: ${error.message}`;
      this.note(this.unread);
      return false;
    }
  }

  /** Leads elsewhere, once what was asked of this page is done. @param {() => Promise<unknown>} way */
  lead(way) {
    return this.ways.push(way).catch((error) => this.fail(error));
  }

  /** @param {() => Promise<unknown>} way */
  async go(way) {
    await this.page?.moves.settled();
    await way();
  }

  /** Opens what the server gives. @param {Opened} opened */
  async open(opened) {
    await this.show(stateOf(opened), { pick: true });
    this.book({ fresh: true });
  }

  /**
   * Shows a state. The server is asked first: where it refuses or is gone, everything stays as it is.
   * @param {State} state
   * @param {{ pick?: boolean, fit?: boolean }} [how] whether a mode is taken where none is held, and whether all of it is brought into view
   */
  async show(state, { pick = false, fit = true } = {}) {
    const own = JSON.parse(JSON.stringify(state));
    /** @type {AnyPage} */
    const page = own.page === "manipulator" ? new ManipulatorPage(this, own) : own.page === "four_bar" ? new FourBarPage(this, own) : new TrussPage(this, own);
    await page.begin(pick);
    this.page?.leave();
    this.page = page;
    this.states.set(own.page, own);
    for (const tab of document.querySelectorAll("[role=tab]")) tab.setAttribute("aria-selected", String(tab.getAttribute("data-page") === own.page));
    byId("family-field").hidden = own.page !== "manipulator";
    byId("panels").replaceChildren(...page.panels);
    this.note("");
    this.say("");
    if (fit) page.fit();
    page.tell();
    this.schedule();
  }

  /** Draws the page with the next frame: answers may come faster than pictures. */
  schedule() {
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame(() => {
      this.scheduled = false;
      this.page?.draw();
    });
  }

  /** Books the page's state, for undo and for the address. @param {{ fresh?: boolean, address?: boolean }} [how] */
  book({ fresh = false, address = true } = {}) {
    if (!this.page?.answer) return;
    if (this.history.book(this.page.state, fresh) && address) this.history.write();
    this.showSteps();
  }

  /** @param {"undo" | "redo"} way */
  step(way) {
    return this.lead(async () => {
      const next = this.history.next(way);
      if (!next) return;
      await this.show(next.state, { fit: next.fresh });
      this.history.step(way);
      this.showSteps();
    });
  }

  showSteps() {
    byId("undo").disabled = this.history.past.length === 0;
    byId("redo").disabled = this.history.future.length === 0;
  }

  /** @param {"connecting" | "open" | "closed"} state @param {string} [reason] */
  onConnection(state, reason) {
    this.connected = state;
    if (state === "closed") {
      this.gone = false;
      this.note(reason ? `The explorer's server has ended the conversation: ${reason}. What you see stays.`
        : `The explorer's server has stopped. What you see stays; to go on, run: assur explore ${location.origin}${location.pathname}`);
      this.gone = true;
    }
    if (state === "open") {
      const again = this.gone;
      this.gone = false;
      this.note("");
      if (!this.page) this.lead(() => this.start());
      else if (again) {
        this.say("connected again");
        this.page.do({ quiet: true });
      }
    }
    this.showConnection();
  }

  showConnection() {
    const dot = byId("connection");
    dot.dataset.state = this.connected;
    const busy = this.connected === "open" && this.connection?.waits() > LONG;
    write(dot, busy ? "computing …" : { connecting: "connecting", open: "connected", closed: "no connection" }[this.connected]);
  }

  /** @param {unknown} error */
  fail(error) {
    if (error instanceof Unanswered) this.say("not done: there is no server to ask");
    else if (error instanceof Refused) this.say(error.message);
    else throw error;
  }

  /** A line below. @param {string} text */
  say(text) {
    write(byId("message"), text);
  }

  /** How long answers take. */
  timing() {
    const now = performance.now();
    if (now - this.timed < TIMING_PAUSE) return;
    this.timed = now;
    const timing = this.connection.timing();
    if (timing) write(byId("timing"), `${timing.last.toFixed(1)} ms, 95 % below ${timing.p95.toFixed(1)} ms`);
  }

  /** A note over the drawing. @param {string} text @param {"alarm" | "note"} [kind] */
  note(text, kind = "alarm") {
    // That there is no server is said until there is one.
    if (this.gone) return;
    const notice = byId("notice");
    notice.hidden = text === "";
    notice.dataset.kind = kind;
    write(notice, text);
  }

  /** @param {string} title @param {string} below */
  caption(title, below) {
    if (byId("caption").textContent === title + below) return;
    this.title = title;
    byId("caption").replaceChildren(title, html("small", {}, [below]));
    document.title = `${title} · assur`;
  }

  /** The problem's file: its text and ending. Without a server a model is given as JSON, which needs none. */
  async file() {
    const state = this.page?.state;
    if (state?.page === "manipulator") {
      try {
        return { text: (await this.connection.ask("write", { model: state.model })).text, ending: "toml" };
      } catch (error) {
        if (!(error instanceof Unanswered)) throw error;
      }
    }
    const shown = state?.page === "manipulator" ? state.model : state?.file;
    return { text: `${JSON.stringify(shown, null, 2)}\n`, ending: "json" };
  }

  async exportModel() {
    try {
      const { text, ending } = await this.file();
      download(new Blob([text], { type: "text/plain" }), `${fileName(this.title)}.${ending}`);
    } catch (error) {
      this.fail(error);
    }
  }

  async edit() {
    try {
      const { text, ending } = await this.file();
      this.editing = `model.${ending}`;
      byId("editor-text").value = text;
      byId("editor-error").textContent = "";
      byId("editor").showModal();
    } catch (error) {
      this.fail(error);
    }
  }

  /** Takes the editor's text; it stays open, with all that was typed, until that has succeeded. */
  async apply() {
    try {
      /** @type {Opened} */
      const opened = await this.connection.ask("open", { text: byId("editor-text").value, file: this.editing });
      const page = this.page;
      // The same kind of thing is a change of this one: its mode is followed.
      if (page instanceof ManipulatorPage && opened.kind === "manipulator") await page.moves.push(page.wish({ handle: "design", model: opened.model }, true));
      else await this.ways.push(() => this.open(opened));
      byId("editor").close();
    } catch (error) {
      byId("editor-error").textContent = error instanceof Error ? error.message : String(error);
    }
  }

  /** @param {File} file */
  read(file) {
    if (file.size > this.connection.largest) return this.say(`${file.name}: too large, ${file.size} of at most ${this.connection.largest} bytes`);
    return this.lead(async () => this.open(await this.connection.ask("open", { text: await file.text(), file: file.name })));
  }

  /** @param {string} family */
  family(family) {
    return this.lead(async () => this.open(await this.connection.ask("new", { family })));
  }

  /** @param {string} page */
  tab(page) {
    return this.lead(async () => {
      if (page === this.page?.state.page) return;
      const first = /** @type {Record<string, State | undefined>} */ ({
        four_bar: { page: "four_bar", file: FIRST_FOUR_BAR, place: { circuit: 0, tau: 0.8 } },
        truss: { page: "truss", file: FIRST_TRUSS },
      });
      const state = this.states.get(page) ?? first[page];
      if (!state) return this.open(await this.connection.ask("new", { family: "3-RPR" }));
      await this.show(state);
      this.book({ fresh: true });
    });
  }

  theme() {
    const root = document.documentElement;
    root.dataset.theme = root.dataset.theme === "dark" ? "light" : "dark";
    localStorage.setItem("assur-theme", root.dataset.theme);
    if (this.page instanceof ManipulatorPage) this.page.mapSoon(true);
  }

  listen() {
    const click = (/** @type {string} */ id, /** @type {() => unknown} */ act) => byId(id).addEventListener("click", act);
    const name = () => fileName(this.title);
    click("undo", () => this.step("undo"));
    click("redo", () => this.step("redo"));
    click("open", () => byId("file").click());
    byId("file").addEventListener("change", () => {
      const input = byId("file");
      if (input.files[0]) this.read(input.files[0]);
      input.value = "";
    });
    byId("family").addEventListener("change", () => {
      const select = byId("family");
      if (select.value) this.family(select.value);
      select.value = "";
      select.blur();
    });
    for (const tab of document.querySelectorAll("[role=tab]")) tab.addEventListener("click", () => this.tab(tab.getAttribute("data-page") ?? ""));
    click("export-model", () => this.exportModel());
    click("export-svg", () => download(new Blob([picture(byId("stage"), this.title)], { type: "image/svg+xml" }), `${name()}.svg`));
    click("export-png", async () => download(await pixels(byId("stage"), this.title), `${name()}.png`));
    click("export-link", async () => {
      this.book();
      this.history.write();
      await navigator.clipboard.writeText(location.href).then(() => this.say("address copied"), () => this.say("the address of this page shows this view"));
    });
    // A menu closes with a choice, and with a press elsewhere.
    byId("export").addEventListener("click", (/** @type {Event} */ event) => {
      if (event.target instanceof HTMLButtonElement) byId("export").open = false;
    });
    document.addEventListener("pointerdown", (event) => {
      if (event.target instanceof Node && !byId("export").contains(event.target)) byId("export").open = false;
    });
    addEventListener("hashchange", () => location.hash.length > 1 && this.lead(() => this.follow()));
    click("theme", () => this.theme());
    click("help", () => byId("keys").showModal());
    click("zoom-in", () => this.stage.zoom(1.25));
    click("zoom-out", () => this.stage.zoom(0.8));
    click("fit", () => this.fit());
    click("editor-apply", () => this.apply());
    click("editor-close", () => byId("editor").close());
    document.addEventListener("keydown", (event) => this.key(event));
    document.body.addEventListener("dragover", (event) => event.preventDefault());
    document.body.addEventListener("drop", (event) => {
      event.preventDefault();
      const file = event.dataTransfer?.files[0];
      if (file) this.read(file);
    });
  }

  fit() {
    this.page?.fit();
    this.schedule();
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const typing = event.target instanceof HTMLElement && event.target.matches("input[type=number], textarea, select");
    const key = event.key.toLowerCase();
    if ((event.ctrlKey || event.metaKey) && !typing && (key === "z" || key === "y")) {
      event.preventDefault();
      this.step(key === "z" && !event.shiftKey ? "undo" : "redo");
      return;
    }
    if (typing || event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
    const manipulator = this.page instanceof ManipulatorPage ? this.page : null;
    /** @type {Record<string, () => void>} */
    const keys = {
      f: () => this.fit(), "+": () => this.stage.zoom(1.25), "=": () => this.stage.zoom(1.25), "-": () => this.stage.zoom(0.8), o: () => byId("file").click(), d: () => this.theme(),
      escape: () => { byId("export").open = false; }, "?": () => byId("keys").showModal(), p: () => manipulator?.prove(), l: () => manipulator?.toggleLoci(),
    };
    if (/^[1-9]$/.test(key)) this.page?.hold(Number(key) - 1);
    else keys[key]?.();
  }
}

/** @param {Opened} opened @returns {State} */
function stateOf(opened) {
  if (opened.kind === "four_bar") return { page: "four_bar", file: opened.file, place: { circuit: 0, tau: 0.8 } };
  if (opened.kind === "truss") return { page: "truss", file: opened.file };
  return { page: "manipulator", model: opened.model, inputs: opened.inputs, mode: null, workspace: { kind: "", from: -Math.PI / 6, to: Math.PI / 6 }, loci: false, pair: [0, 1] };
}

document.documentElement.dataset.theme = localStorage.getItem("assur-theme") ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
/** For tests and for the curious. */
Object.assign(globalThis, { assur: new App() });
