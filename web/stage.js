// The drawing area: where it looks, what is on it, what is taken hold of.

import { GHOST_LAYERS, LAYERS, ghostly, paths } from "./marks.js";
import { set, svg } from "./svg.js";

/**
 * @typedef {import("./types.js").Mark} Mark
 * @typedef {import("./types.js").Point} Point
 * @typedef {{ key: string, label: string, at: Point, origin?: Point, from?: Point, axis?: boolean, body?: boolean }} Grip `from`: where its axis starts, if no line shows it; `body`: the solid plate is held by it
 * @typedef {{ tone: number, label: string, ghost: boolean, marks: Mark[], name: Point | null }} Assembly
 */

/** Pixels around what is shown, when all of it is. */
const ROOM = 70;
/** A key press moves a handle by so many pixels; with Shift, with Alt. */
const STEPS = { plain: 4, shift: 40, alt: 0.5 };

export class Stage {
  /**
   * @param {SVGSVGElement} root
   * @param {{ grab: (key: string) => void, pull: (key: string, to: Point) => void, drop: (key: string) => void, take: (number: number) => void }} on
   */
  constructor(root, on) {
    this.root = root;
    this.on = on;
    this.scale = 20;
    /** @type {Point} */
    this.centre = [0, 0];
    const layer = (/** @type {string} */ name) => svg("g", { class: name }, root);
    this.back = layer("back");
    this.ghosts = layer("ghosts");
    this.front = layer("front");
    this.labels = layer("labels");
    this.over = layer("over");
    this.grips = layer("grips");
    /** @type {Map<string, { element: SVGGElement, grip: Grip }>} */
    this.byKey = new Map();
    /** @type {{ key: string, offset: Point } | null} */
    this.held = null;
    /** The handle that keys move. */
    this.keyed = "";
    /** @type {() => void} */
    this.redraw = () => {};
    this.measure();
    this.listen();
  }

  get size() {
    const box = this.root.getBoundingClientRect();
    return [box.width || 800, box.height || 600];
  }

  /** @param {Point} p @returns {Point} */
  place = ([x, y]) => {
    const [w, h] = this.extent;
    return [w / 2 + (x - this.centre[0]) * this.scale, h / 2 - (y - this.centre[1]) * this.scale];
  };

  /** @param {Point} p pixels in the drawing area @returns {Point} */
  unplace([x, y]) {
    const [w, h] = this.extent;
    return [this.centre[0] + (x - w / 2) / this.scale, this.centre[1] - (y - h / 2) / this.scale];
  }

  /** @type {[number, number]} */
  extent = [800, 600];

  measure() {
    const [w, h] = this.size;
    this.extent = [w, h];
    this.root.setAttribute("viewBox", `0 0 ${w} ${h}`);
  }

  /** Shows these points with room around them. @param {Point[]} points */
  fit(points) {
    const sound = points.filter((p) => p.every(Number.isFinite));
    if (sound.length === 0) return;
    this.measure();
    const [xs, ys] = [sound.map((p) => p[0]), sound.map((p) => p[1])];
    const [low, high] = [[Math.min(...xs), Math.min(...ys)], [Math.max(...xs), Math.max(...ys)]];
    const [w, h] = this.extent;
    const [dx, dy] = [high[0] - low[0], high[1] - low[1]];
    const fitting = Math.min((w - 2 * ROOM) / (dx || 1e-9), (h - 2 * ROOM) / (dy || 1e-9));
    this.scale = Number.isFinite(fitting) && fitting > 0 ? Math.min(fitting, 1e6) : 1;
    this.centre = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
  }

  /** @param {number} factor @param {Point} [about] in pixels */
  zoom(factor, about) {
    const [w, h] = this.extent;
    const pixel = about ?? /** @type {Point} */ ([w / 2, h / 2]);
    const before = this.unplace(pixel);
    this.scale *= factor;
    const after = this.unplace(pixel);
    this.centre = [this.centre[0] + before[0] - after[0], this.centre[1] + before[1] - after[1]];
    this.redraw();
  }

  /** @param {Assembly[]} assemblies */
  draw(assemblies) {
    const ghosts = assemblies.filter((a) => a.ghost);
    const solid = assemblies.filter((a) => !a.ghost);
    this.fill(this.ghosts, ghosts, assemblies);
    this.fill(this.front, solid, assemblies);
    const names = assemblies.flatMap((a) => (a.name ? [{ at: this.place(a.name), text: a.label, tone: a.tone }] : []));
    const legs = (solid[0] ?? ghosts[0])?.marks.filter((m) => m.mark === "number") ?? [];
    const texts = [
      ...legs.map((m) => ({ at: /** @type {Point} */ (this.place(m.at[0]).map((v, k) => v + [16, 14][k])), text: String(m.leg), tone: -1 })),
      ...(assemblies.length > 1 ? names : []),
    ];
    while (this.labels.children.length > texts.length) this.labels.lastChild?.remove();
    texts.forEach(({ at, text, tone }, k) => {
      const label = this.labels.children[k] ?? svg("text", { class: "label" }, this.labels);
      if (label.textContent !== text) label.textContent = text;
      set(label, "x", at[0].toFixed(1));
      set(label, "y", at[1].toFixed(1));
      set(label, "class", tone < 0 ? "label" : "label name");
      set(label, "data-tone", String(tone));
    });
  }

  /** @param {SVGGElement} parent @param {Assembly[]} shown @param {Assembly[]} all */
  fill(parent, shown, all) {
    const ghosts = parent === this.ghosts;
    const layers = ghosts ? GHOST_LAYERS : LAYERS;
    while (parent.children.length > shown.length) parent.lastChild?.remove();
    shown.forEach((assembly, k) => {
      let group = parent.children[k];
      if (!group) {
        group = svg("g", {}, parent);
        for (const layer of layers) svg("path", { class: layer }, group);
        group.addEventListener("click", () => {
          const number = Number(group.getAttribute("data-number"));
          if (group.classList.contains("ghost")) this.on.take(number);
        });
      }
      set(group, "class", assembly.ghost ? "mode ghost" : "mode held-mode");
      set(group, "data-tone", String(assembly.tone));
      set(group, "data-number", String(all.indexOf(assembly)));
      /** @type {Record<string, string | undefined>} */
      const d = ghosts ? ghostly(paths(assembly.marks, this.place)) : paths(assembly.marks, this.place);
      layers.forEach((layer, at) => set(group.children[at], "d", d[layer] ?? ""));
    });
  }

  /** Lines and areas behind the mechanism. @param {{ class: string, points: Point[], closed: boolean }[]} shapes */
  background(shapes) {
    /** @type {Map<string, string>} */
    const byClass = new Map();
    for (const { class: name, points, closed } of shapes) {
      const d = points.map((p) => this.place(p).map((v) => v.toFixed(1)).join(" ")).join("L");
      if (d) byClass.set(name, `${byClass.get(name) ?? ""}M${d}${closed ? "Z" : ""}`);
    }
    const entries = [...byClass];
    while (this.back.children.length > entries.length) this.back.lastChild?.remove();
    entries.forEach(([name, d], k) => {
      const path = this.back.children[k] ?? svg("path", { "fill-rule": "evenodd" }, this.back);
      const [style, tone] = name.split("@");
      set(path, "class", style);
      set(path, "data-tone", tone ?? "");
      set(path, "d", d);
    });
  }

  /** Rings where modes meet. @param {Point[]} points */
  rings(points) {
    while (this.over.children.length > points.length) this.over.lastChild?.remove();
    points.forEach((p, k) => {
      const ring = this.over.children[k] ?? svg("circle", { class: "meeting", r: 17 }, this.over);
      const [x, y] = this.place(p);
      set(ring, "cx", x.toFixed(1));
      set(ring, "cy", y.toFixed(1));
    });
  }

  /** @param {Grip[]} grips */
  handles(grips) {
    set(this.root, "data-plate", String(grips.some((grip) => grip.body)));
    const keys = new Set(grips.map((grip) => grip.key));
    for (const [key, { element }] of this.byKey) {
      // A handle that is held stays, whatever becomes of the mode it belongs to.
      if (!keys.has(key) && this.held?.key !== key && this.keyed !== key) {
        element.remove();
        this.byKey.delete(key);
      }
    }
    for (const grip of grips) {
      let entry = this.byKey.get(grip.key);
      if (!entry) {
        const element = svg("g", { class: `handle${grip.axis ? " axis" : ""}`, tabindex: 0, role: "button", "aria-label": grip.label, "data-key": grip.key }, this.grips);
        if (grip.from) svg("line", { class: "arm" }, element);
        svg("circle", { class: "reach", r: 15 }, element);
        svg("circle", { class: "dot", r: grip.axis ? 5 : 10 }, element);
        svg("title", {}, element).textContent = grip.label;
        entry = { element, grip };
        this.byKey.set(grip.key, entry);
      }
      entry.grip = grip;
      const [x, y] = this.place(grip.at);
      set(entry.element, "transform", `translate(${x.toFixed(2)} ${y.toFixed(2)})`);
      if (!grip.from) continue;
      const arm = this.place(grip.from);
      set(entry.element.children[0], "x1", (arm[0] - x).toFixed(2));
      set(entry.element.children[0], "y1", (arm[1] - y).toFixed(2));
    }
  }

  listen() {
    const pixel = (/** @type {MouseEvent} */ event) => {
      const box = this.root.getBoundingClientRect();
      return /** @type {Point} */ ([event.clientX - box.left, event.clientY - box.top]);
    };
    /** @type {Point | null} */
    let panned = null;
    /** @type {number | null} The pointer that pulls or pans: the first finger, the first button. */
    let pointer = null;
    this.root.addEventListener("pointerdown", (event) => {
      if (pointer !== null || event.button !== 0 || !event.isPrimary) return;
      const target = event.target instanceof Element ? event.target : null;
      const body = target?.matches(".held-mode .body") ? [...this.byKey.values()].find(({ grip }) => grip.body) : null;
      const key = target?.closest(".handle")?.getAttribute("data-key") ?? body?.grip.key;
      const entry = key ? this.byKey.get(key) : null;
      if (key && entry) {
        const at = this.unplace(pixel(event));
        const from = entry.grip.origin ?? entry.grip.at;
        this.held = { key, offset: [from[0] - at[0], from[1] - at[1]] };
        entry.element.classList.add("held");
        this.on.grab(key);
      } else if (!target?.closest(".ghost")) {
        panned = pixel(event);
      } else {
        return;
      }
      pointer = event.pointerId;
      this.root.setPointerCapture(event.pointerId);
    });
    this.root.addEventListener("pointermove", (event) => {
      if (event.pointerId !== pointer) return;
      const at = pixel(event);
      if (this.held) {
        const [x, y] = this.unplace(at);
        this.on.pull(this.held.key, this.rounded([x + this.held.offset[0], y + this.held.offset[1]]));
      } else if (panned) {
        this.centre = [this.centre[0] - (at[0] - panned[0]) / this.scale, this.centre[1] + (at[1] - panned[1]) / this.scale];
        panned = at;
        this.redraw();
      }
    });
    const release = (/** @type {PointerEvent} */ event) => {
      if (event.pointerId !== pointer) return;
      pointer = null;
      panned = null;
      if (!this.held) return;
      const { key } = this.held;
      this.byKey.get(key)?.element.classList.remove("held");
      this.held = null;
      this.on.drop(key);
    };
    this.root.addEventListener("pointerup", release);
    this.root.addEventListener("pointercancel", release);
    this.root.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY * 0.0015), pixel(event));
    }, { passive: false });
    this.root.addEventListener("keydown", (event) => {
      const key = event.target instanceof Element ? event.target.closest(".handle")?.getAttribute("data-key") : null;
      /** @type {Record<string, Point>} */
      const ways = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
      const way = ways[event.key];
      const grip = key ? this.byKey.get(key)?.grip : null;
      if (!key || !grip || !way) return;
      event.preventDefault();
      const step = (event.shiftKey ? STEPS.shift : event.altKey ? STEPS.alt : STEPS.plain) / this.scale;
      const from = grip.origin ?? grip.at;
      this.keyed = key;
      this.on.grab(key);
      this.on.pull(key, this.rounded([from[0] + way[0] * step, from[1] + way[1] * step]));
    });
    // However often a key repeats, letting it go is one end.
    const rest = () => {
      if (this.keyed) this.on.drop(this.keyed);
      this.keyed = "";
    };
    this.root.addEventListener("keyup", rest);
    this.root.addEventListener("focusout", rest);
    // Measured when it changes: asked for with each drawing, the browser would lay the page out twice.
    new ResizeObserver(() => {
      this.measure();
      this.redraw();
    }).observe(this.root);
  }

  /** To a tenth of a pixel, in as few decimals. @param {Point} p @returns {Point} */
  rounded(p) {
    const decimals = Math.max(0, Math.min(12, Math.ceil(Math.log10(this.scale * 10))));
    return [Number(p[0].toFixed(decimals)), Number(p[1].toFixed(decimals))];
  }
}
