// The column of numbers beside the drawing. What changes while something is pulled is changed in place: a button that is being pressed, or has the focus, stays.

import { html, set, write } from "./svg.js";

/**
 * A titled part of the column.
 * @param {string} title
 * @param {(Node | string)[]} body
 * @param {Node[]} [tools] beside the title
 */
export function panel(title, body, tools = []) {
  const spread = html("span", { class: "spread" });
  return html("section", { class: "panel" }, [html("h2", {}, [title, spread, ...tools]), ...body]);
}

/** @param {string} text @param {() => void} act @param {Record<string, string>} [attributes] */
export function button(text, act, attributes = {}) {
  const element = html("button", attributes, [text]);
  element.addEventListener("click", act);
  return element;
}

/** @param {[string, string][]} entries @param {(chosen: string) => void} act @param {string} label */
export function choice(entries, act, label) {
  const element = html("select", { "aria-label": label }, entries.map(([value, text]) => html("option", { value }, [text])));
  element.addEventListener("change", () => act(element.value));
  return element;
}

/** Names and values, one below the other. */
export class Facts {
  element = html("dl", { class: "facts" });

  /** @param {[string, string][]} entries */
  draw(entries) {
    const texts = entries.flat();
    while (this.element.children.length > texts.length) this.element.lastChild?.remove();
    texts.forEach((text, k) => {
      if (!this.element.children[k]) this.element.append(html(k % 2 === 0 ? "dt" : "dd"));
      write(this.element.children[k], text);
    });
  }
}

/** Modes, circuits or assemblies to take hold of. */
export class Rows {
  element = html("ul", { class: "modes" });

  /** @param {(number: number) => void} take */
  constructor(take) {
    this.take = take;
  }

  /** @param {{ tone: number, text: string, held: boolean, warning?: string, tag?: string, title?: string }[]} rows */
  draw(rows) {
    while (this.element.children.length > rows.length) this.element.lastChild?.remove();
    rows.forEach((row, k) => {
      const button = this.element.children[k]?.children[0] ?? this.add(k);
      set(button, "data-tone", String(row.tone));
      set(button, "aria-pressed", String(row.held));
      set(button, "title", row.title ?? "");
      [row.text, row.warning ?? "", row.tag ?? ""].forEach((text, at) => write(button.children[at + 1], text));
    });
  }

  /** @param {number} k */
  add(k) {
    const row = html("button", {}, [
      html("span", { class: "swatch" }, [html("b", {}, [String(k + 1)])]), html("span", { class: "text" }), html("span", { class: "tag bad" }), html("span", { class: "tag" }),
    ]);
    row.addEventListener("click", () => this.take(k));
    this.element.append(html("li", {}, [row]));
    return row;
  }
}

/** How many solutions are of which kind, a cell for each. */
export class Cells {
  element = html("div", { class: "account", role: "img" });

  /** @param {string[]} kinds @param {string} label */
  draw(kinds, label) {
    while (this.element.children.length > kinds.length) this.element.lastChild?.remove();
    kinds.forEach((kind, k) => set(this.element.children[k] ?? this.element.appendChild(html("span")), "class", kind));
    set(this.element, "aria-label", label);
  }
}

/** A field for a number. What is typed is asked for; refused, the field shows what holds again and is marked until something else is typed. */
export class NumberField {
  /** @param {string} label @param {(value: number) => Promise<void> | "more"} ask NaN for an empty field; "more" where this number says nothing without another that is still to be typed */
  constructor(label, ask) {
    this.element = html("input", { type: "number", step: "any", "aria-label": label });
    this.shown = "";
    /** Whether something is typed in it that nobody was asked for yet. */
    this.typed = false;
    this.element.addEventListener("input", () => {
      this.typed = true;
      this.element.removeAttribute("aria-invalid");
    });
    this.element.addEventListener("change", () => {
      const asked = ask(this.element.valueAsNumber);
      if (asked === "more") return;
      const text = this.element.value;
      asked.then(() => this.answered(text), () => {
        if (!this.answered(text)) return;
        this.show(this.shown);
        this.element.setAttribute("aria-invalid", "true");
      });
    });
  }

  /** What was asked for is answered; what has been typed since stays. @param {string} text what was asked for @returns {boolean} whether nothing has been typed since */
  answered(text) {
    const last = this.element.value === text;
    if (last) this.typed = false;
    return last;
  }

  /** @param {string} text the number that holds */
  show(text) {
    this.shown = text;
    if (!this.typed && this.element.value !== text) this.element.value = text;
  }
}

/** Tells of a slider's steps, and of each end of them once, however many steps a key that is held down makes. @param {HTMLInputElement} slider @param {() => void} step @param {() => void} end */
export function onSlide(slider, step, end) {
  let keyed = false;
  const release = () => {
    if (keyed) end();
    keyed = false;
  };
  slider.addEventListener("keydown", (event) => {
    if (/^(Arrow|Page|Home|End)/.test(event.key)) keyed = true;
  });
  slider.addEventListener("input", step);
  slider.addEventListener("change", () => keyed || end());
  slider.addEventListener("keyup", release);
  slider.addEventListener("blur", release);
}
