// Pictures and files out of the page.

/** What of an element's style goes into a picture, as attributes: readable by every program for drawings. */
const STYLES = [
  "fill", "fill-opacity", "fill-rule", "stroke", "stroke-opacity", "stroke-width", "stroke-linecap", "stroke-linejoin", "stroke-dasharray", "opacity",
  "font-family", "font-size", "font-weight", "text-anchor", "dominant-baseline", "paint-order",
];
/** Pixels of a picture for each one of the page. */
const SHARPNESS = 2;

/** The drawing as a document of its own. @param {SVGSVGElement} stage @param {string} title */
export function picture(stage, title) {
  const copy = /** @type {SVGSVGElement} */ (stage.cloneNode(true));
  copy.querySelector(".grips")?.remove();
  const originals = [...stage.querySelectorAll("*")].filter((element) => !element.closest(".grips"));
  [...copy.querySelectorAll("*")].forEach((element, k) => {
    const style = getComputedStyle(originals[k]);
    if (style.display === "none") {
      element.setAttribute("display", "none");
      return;
    }
    for (const name of STYLES) element.setAttribute(name, style.getPropertyValue(name));
    element.removeAttribute("class");
  });
  copy.querySelectorAll('[display="none"], path[d=""]').forEach((element) => element.remove());
  const box = stage.getBoundingClientRect();
  copy.setAttribute("width", String(Math.round(box.width)));
  copy.setAttribute("height", String(Math.round(box.height)));
  for (const name of ["role", "aria-label", "id"]) copy.removeAttribute(name);
  const paper = document.createElementNS("http://www.w3.org/2000/svg", "rect");
  paper.setAttribute("width", "100%");
  paper.setAttribute("height", "100%");
  paper.setAttribute("fill", getComputedStyle(stage).backgroundColor);
  const name = document.createElementNS("http://www.w3.org/2000/svg", "title");
  name.textContent = title;
  copy.prepend(name, paper);
  return `${new XMLSerializer().serializeToString(copy)}\n`;
}

/** The drawing as PNG. @param {SVGSVGElement} stage @param {string} title @returns {Promise<Blob>} */
export async function pixels(stage, title) {
  const address = URL.createObjectURL(new Blob([picture(stage, title)], { type: "image/svg+xml" }));
  try {
    const image = new Image();
    image.src = address;
    await image.decode();
    const box = stage.getBoundingClientRect();
    const canvas = document.createElement("canvas");
    canvas.width = Math.round(box.width * SHARPNESS);
    canvas.height = Math.round(box.height * SHARPNESS);
    canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
    return await new Promise((resolve, reject) => canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("the picture is too large"))), "image/png"));
  } finally {
    URL.revokeObjectURL(address);
  }
}

/** Hands a file to the browser's downloads. @param {Blob} blob @param {string} name */
export function download(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** A name for a file. @param {string} title */
export const fileName = (title) => title.toLowerCase().replaceAll(/[^a-z0-9]+/g, "-").replaceAll(/^-|-$/g, "").slice(0, 60) || "mechanism";
