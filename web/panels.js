// The column of numbers beside the drawing.

import { html } from "./svg.js";

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

/** @param {[string, string][]} entries */
export function facts(entries) {
  return html("dl", { class: "facts" }, entries.flatMap(([name, value]) => [html("dt", {}, [name]), html("dd", {}, [value])]));
}
