// The frame: which page is shown, what the keys do, files, history, messages.

import { Connection, Refused, Unanswered } from "./connection.js";
import { download, fileName, picture, pixels } from "./exporting.js";
import { FIRST as FIRST_FOUR_BAR, FourBarPage } from "./fourbar.js";
import { History, decode } from "./history.js";
import { ManipulatorPage } from "./manipulator.js";
import { Stage } from "./stage.js";
import { byId, html } from "./svg.js";
import { FIRST as FIRST_TRUSS, TrussPage } from "./truss.js";

/**
 * @typedef {import("./types.js").State} State
 * @typedef {import("./types.js").ManipulatorState} ManipulatorState
 * @typedef {ManipulatorPage | FourBarPage | TrussPage} Page
 * @typedef {{ kind: "manipulator", model: import("./types.js").Model, inputs: number[] } | { kind: "four_bar", file: object } | { kind: "truss", file: object }} Opened
 */

/** The time of answers is shown no more often than this, in milliseconds. */
const TIMING_PAUSE = 250;

export class App {
  constructor() {
    this.stage = new Stage(byId("stage"), {
      grab: () => this.page?.grab(),
      pull: (key, to) => this.page?.pullHandle(key, to),
      drop: () => this.page?.drop(),
      take: (number) => this.page?.hold(number),
    });
    this.stage.redraw = () => this.schedule();
    this.scheduled = false;
    this.history = new History();
    /** @type {Page | null} */
    this.page = null;
    /** @type {Map<string, State>} The last state of each page. */
    this.states = new Map();
    this.title = "";
    this.timed = 0;
    this.connection = new Connection((state) => this.connected(state));
    this.listen();
    this.start();
  }

  async start() {
    await this.connection.opened();
    const given = decode(location.hash);
    const start = await this.connection.ask("start", {});
    this.connection.largest = start.largest_message;
    byId("family").append(...start.families.map((/** @type {string} */ family) => html("option", { value: family }, [family])));
    if (given) await this.show(given, false, true);
    else await this.open(start);
    this.book();
  }

  /** @param {Opened} opened */
  open(opened) {
    return this.show(stateOf(opened), true, true);
  }

  /** @param {State} state @param {boolean} pick @param {boolean} fit */
  async show(state, pick, fit) {
    this.note("");
    for (const tab of document.querySelectorAll("[role=tab]")) tab.setAttribute("aria-selected", String(tab.getAttribute("data-page") === state.page));
    byId("family-field").hidden = state.page !== "manipulator";
    const own = JSON.parse(JSON.stringify(state));
    this.page = own.page === "manipulator" ? new ManipulatorPage(this, own) : own.page === "four_bar" ? new FourBarPage(this, own) : new TrussPage(this, own);
    await this.page.begin(pick, fit);
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

  /** Books the page's state, for undo and for the address. */
  book() {
    if (!this.page?.answer) return;
    this.states.set(this.page.state.page, this.page.state);
    this.history.book(this.page.state);
    byId("undo").disabled = this.history.past.length === 0;
    byId("redo").disabled = this.history.future.length === 0;
  }

  /** @param {State | null} state */
  async restore(state) {
    if (!state) return;
    await this.show(state, false, false);
    byId("undo").disabled = this.history.past.length === 0;
    byId("redo").disabled = this.history.future.length === 0;
  }

  /** @param {"connecting" | "open" | "closed"} state */
  connected(state) {
    const dot = byId("connection");
    dot.dataset.state = state;
    dot.textContent = { connecting: "connecting", open: "connected", closed: "no connection" }[state];
    if (state === "closed") {
      this.gone = true;
      this.note(`The explorer's server has stopped. What you see stays; to go on, run: assur explore ${location.origin}${location.pathname}`);
    }
    if (state === "open" && this.gone) {
      this.gone = false;
      this.note("");
      this.say("connected again");
      this.page?.begin(false, false);
    }
  }

  /** @param {unknown} error */
  fail(error) {
    if (error instanceof Unanswered) return;
    if (error instanceof Refused) this.say(error.message);
    else throw error;
  }

  /** A line below. @param {string} text */
  say(text) {
    const line = byId("message");
    if (line.textContent !== text) line.textContent = text;
    const now = performance.now();
    if (now - this.timed < TIMING_PAUSE) return;
    this.timed = now;
    const timing = this.connection.timing();
    if (timing) byId("timing").textContent = `${timing.last.toFixed(1)} ms, 95 % below ${timing.p95.toFixed(1)} ms`;
  }

  /** A note over the drawing. @param {string} text @param {"alarm" | "note"} [kind] */
  note(text, kind = "alarm") {
    const notice = byId("notice");
    if (this.gone && kind === "note") return;
    if (this.gone && text === "") return;
    notice.hidden = text === "";
    notice.dataset.kind = kind;
    if (notice.textContent !== text) notice.textContent = text;
  }

  /** @param {string} title @param {string} below */
  caption(title, below) {
    if (byId("caption").textContent === title + below) return;
    this.title = title;
    byId("caption").replaceChildren(title, html("small", {}, [below]));
    document.title = `${title} · assur`;
  }

  /** @param {...Node} panels */
  panels(...panels) {
    byId("panels").replaceChildren(...panels);
  }

  /** The problem's file as text. */
  async text() {
    const state = this.page?.state;
    if (state?.page === "manipulator") return (await this.connection.ask("write", { model: state.model })).text;
    return state ? `${JSON.stringify(state.file, null, 2)}\n` : "";
  }

  get ending() {
    return this.page?.state.page === "manipulator" ? "toml" : "json";
  }

  async edit() {
    try {
      byId("editor-text").value = await this.text();
      byId("editor-error").textContent = "";
      byId("editor").showModal();
    } catch (error) {
      this.fail(error);
    }
  }

  async apply() {
    try {
      /** @type {Opened} */
      const opened = await this.connection.ask("open", { text: byId("editor-text").value, file: `model.${this.ending}` });
      byId("editor").close();
      const page = this.page;
      // The same kind of thing is a change of this one: its mode is followed.
      if (page instanceof ManipulatorPage && opened.kind === "manipulator") page.pull({ handle: "design", model: opened.model }, true);
      else await this.open(opened).then(() => this.book());
    } catch (error) {
      byId("editor-error").textContent = error instanceof Error ? error.message : String(error);
    }
  }

  /** @param {File} file */
  async read(file) {
    if (file.size > this.connection.largest) return this.say(`${file.name}: too large, ${file.size} of at most ${this.connection.largest} bytes`);
    try {
      await this.open(await this.connection.ask("open", { text: await file.text(), file: file.name }));
      this.book();
    } catch (error) {
      this.fail(error);
    }
  }

  /** @param {string} family */
  async family(family) {
    try {
      await this.open(await this.connection.ask("new", { family }));
      this.book();
    } catch (error) {
      this.fail(error);
    }
  }

  async tab(/** @type {string} */ page) {
    const first = /** @type {Record<string, State | undefined>} */ ({
      manipulator: this.states.get("manipulator"),
      four_bar: { page: "four_bar", file: FIRST_FOUR_BAR, place: { circuit: 0, tau: 0.8 } },
      truss: { page: "truss", file: FIRST_TRUSS },
    });
    const state = this.states.get(page) ?? first[page];
    if (state) await this.show(state, false, true);
    else await this.open(await this.connection.ask("new", { family: "3-RPR" }));
    this.book();
  }

  theme() {
    const root = document.documentElement;
    root.dataset.theme = root.dataset.theme === "dark" ? "light" : "dark";
    localStorage.setItem("assur-theme", root.dataset.theme);
    if (this.page instanceof ManipulatorPage) this.page.slow.push(null);
  }

  listen() {
    const click = (/** @type {string} */ id, /** @type {() => unknown} */ act) => byId(id).addEventListener("click", act);
    const name = () => fileName(this.title);
    click("undo", () => this.restore(this.history.undo()));
    click("redo", () => this.restore(this.history.redo()));
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
    click("export-model", async () => download(new Blob([await this.text()], { type: "text/plain" }), `${name()}.${this.ending}`));
    click("export-svg", () => download(new Blob([picture(byId("stage"), this.title)], { type: "image/svg+xml" }), `${name()}.svg`));
    click("export-png", async () => download(await pixels(byId("stage"), this.title), `${name()}.png`));
    click("export-link", async () => {
      this.book();
      await navigator.clipboard.writeText(location.href).then(() => this.say("address copied"), () => this.say("the address of this page shows this view"));
    });
    byId("export").addEventListener("click", (/** @type {Event} */ event) => {
      if (event.target instanceof HTMLButtonElement) byId("export").open = false;
    });
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
      const back = key === "z" && !event.shiftKey;
      this.restore(back ? this.history.undo() : this.history.redo());
      return;
    }
    if (typing || event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
    const manipulator = this.page instanceof ManipulatorPage ? this.page : null;
    /** @type {Record<string, () => void>} */
    const keys = {
      f: () => this.fit(), "+": () => this.stage.zoom(1.25), "=": () => this.stage.zoom(1.25), "-": () => this.stage.zoom(0.8), o: () => byId("file").click(), d: () => this.theme(),
      "?": () => byId("keys").showModal(), p: () => manipulator?.prove(), l: () => manipulator?.toggleLoci(),
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
