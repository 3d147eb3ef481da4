// From the symbols of one assembly to SVG paths: one path for everything that looks alike.

/** @typedef {import("./types.js").Mark} Mark @typedef {import("./types.js").Point} Point */

/** The classes of paths, from back to front. */
export const LAYERS = ["body", "rail", "hatch", "guide", "ground", "bar", "rod", "solid", "driven", "violated", "axis-x", "axis-y"];

/** Those of a ghost: it has no ground, and no telltale colours. */
export const GHOST_LAYERS = ["body", "guide", "bar", "solid", "violated"];

/** What a ghost's layers are of. @param {Record<string, string>} d */
export const ghostly = (d) => ({ body: d.body, guide: d.guide, bar: `${d.bar ?? ""}${d.rod ?? ""}`, solid: `${d.solid ?? ""}${d.driven ?? ""}`, violated: d.violated });

const PIN = 4.4;
const BLOCK = [9, 5.5];
const CYLINDER = 4.2;
const CYLINDER_PART = 0.55;
const OVERHANG = 16;
const HATCH = 6;
const LONGEST_HATCH = 3000;
const AXIS = 22;

/** @param {Point[]} points @param {boolean} closed */
const line = (points, closed) => `M${points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join("L")}${closed ? "Z" : ""}`;
/** @param {Point} at @param {number} r */
const circle = ([x, y], r) => `M${(x - r).toFixed(1)} ${y.toFixed(1)}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0Z`;

/**
 * @param {Mark[]} marks
 * @param {(p: Point) => Point} place from the mechanism to pixels
 * @returns {Record<string, string>} path data by class
 */
export function paths(marks, place) {
  /** @type {Record<string, string>} */
  const out = {};
  const add = (/** @type {string} */ layer, /** @type {string} */ d) => {
    out[layer] = (out[layer] ?? "") + d;
  };
  const joint = (/** @type {Mark} */ mark, /** @type {string} */ d, /** @type {string} */ ring) => {
    add(mark.look?.actuated ? "driven" : "solid", d);
    if (mark.look?.violated) add("violated", ring);
  };
  for (const mark of marks) {
    const at = mark.at.map(place);
    // On the page y runs downwards.
    const along = mark.along ? /** @type {Point} */ ([mark.along[0], -mark.along[1]]) : /** @type {Point} */ ([1, 0]);
    const side = /** @type {Point} */ ([-along[1], along[0]]);
    const beside = (/** @type {Point} */ p, /** @type {number} */ x, /** @type {number} */ y) =>
      /** @type {Point} */ ([p[0] + along[0] * x + side[0] * y, p[1] + along[1] * x + side[1] * y]);
    switch (mark.mark) {
      case "body":
        add("body", line(at, true));
        break;
      case "bar":
        add("bar", line(at, false));
        break;
      case "ground": {
        const [x, y] = at[0];
        add("ground", line([[x, y], [x - 8, y + 13], [x + 8, y + 13]], true));
        for (const k of [-8, -3, 2, 7]) add("hatch", line([[x + k + 2, y + 13], [x + k - 2, y + 17.5]], false));
        break;
      }
      case "rail": {
        const reach = (at[1][0] - at[0][0]) * along[0] + (at[1][1] - at[0][1]) * along[1];
        const [from, to] = [Math.min(reach, 0) - OVERHANG, Math.max(reach, 0) + OVERHANG];
        add(mark.fixed ? "rail" : "guide", line([beside(at[0], from, 0), beside(at[0], to, 0)], false));
        if (!mark.fixed) break;
        for (let way = HATCH / 2; way < Math.min(to - from, LONGEST_HATCH); way += HATCH) {
          add("hatch", line([beside(at[0], from + way, 0), beside(at[0], from + way - 4, 4)], false));
        }
        break;
      }
      case "telescope": {
        const [a, b] = at;
        const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
        const length = Math.hypot(dx, dy) || 1;
        const [ux, uy] = [dx / length, dy / length];
        const corner = (/** @type {number} */ x, /** @type {number} */ y) => /** @type {Point} */ ([a[0] + ux * x - uy * y, a[1] + uy * x + ux * y]);
        const [start, end] = [Math.min(PIN, length), length * CYLINDER_PART];
        add("rod", line(at, false));
        const box = line([corner(start, CYLINDER), corner(end, CYLINDER), corner(end, -CYLINDER), corner(start, -CYLINDER)], true);
        joint(mark, box, box);
        break;
      }
      case "block": {
        const box = line([beside(at[0], BLOCK[0], BLOCK[1]), beside(at[0], -BLOCK[0], BLOCK[1]), beside(at[0], -BLOCK[0], -BLOCK[1]), beside(at[0], BLOCK[0], -BLOCK[1])], true);
        joint(mark, box, box);
        break;
      }
      case "pin":
        joint(mark, circle(at[0], PIN + (mark.look?.actuated ? 1.2 : 0)), circle(at[0], PIN + 4));
        break;
      case "frame":
        add("axis-x", line([at[0], beside(at[0], AXIS, 0)], false));
        add("axis-y", line([at[0], beside(at[0], 0, -AXIS)], false));
        break;
      default:
    }
  }
  return out;
}
