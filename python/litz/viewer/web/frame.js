/** Overlays of the picture: colour bar, scale bar, directions of the axes. */

import { Vector3 } from "three";
import { engineering } from "litz/data.js";

// Width of a colour bar that has room for five numbers [pixels]
const WIDE_BAR = 250;

/** Draw the colour bar: a gradient with five numbers, or three where it is narrow. */
export function drawColourBar(element, table, limits, text, unit) {
   const [factor, symbol] = engineering(Math.max(...limits.map(Math.abs)), unit);
   const colours = Array.from({ length: 17 }, (_, k) => {
      const at = 4 * Math.round((255 * k) / 16);
      return `rgb(${table[at]} ${table[at + 1]} ${table[at + 2]})`;
   });
   element.querySelector(".bar").style.background = `linear-gradient(to right, ${colours.join(", ")})`;
   element.querySelector(".title").textContent = symbol ? `${text} [${symbol}]` : text;
   const parts = element.clientWidth < WIDE_BAR ? [0, 0.5, 1] : [0, 0.25, 0.5, 0.75, 1];
   element.querySelector(".numbers").replaceChildren(...parts.map((part) => {
      const value = factor * (limits[0] + part * (limits[1] - limits[0]));
      const span = document.createElement("span");
      span.textContent = Math.abs(value) < 1e-12 * factor * Math.abs(limits[1]) ? "0" : Number(value.toPrecision(3));
      return span;
   }));
}

/** Create an SVG element; its text is never interpreted as markup. */
function svgElement(name, attributes, text = "") {
   const element = document.createElementNS("http://www.w3.org/2000/svg", name);
   for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
   element.textContent = text;
   return element;
}

/** Draw the directions of the axes and a scale bar of round length, as an SVG of 190 x 70 pixels. */
export function drawCompass(svg, stage, lengthUnit) {
   const parts = [];
   [[1, 0, 0], [0, 1, 0], [0, 0, 1]].forEach((axis, k) => {
      const [x, y] = stage.direction(new Vector3(...axis));
      if (Math.hypot(x, y) < 0.1) return;
      const [tipX, tipY] = [150 + 24 * x, 35 - 24 * y];
      parts.push(svgElement("line", { x1: 150, y1: 35, x2: tipX, y2: tipY, "marker-end": "url(#litz-arrow)" }));
      parts.push(svgElement("text", { x: 150 + 34 * x, y: 39 - 34 * y }, "xyz"[k]));
   });
   const maxLength = 90 / stage.pixelsPerMetre;
   const decade = 10 ** Math.floor(Math.log10(maxLength));
   const length = decade * Math.max(...[1, 2, 5].filter((step) => step * decade <= maxLength));
   const pixels = length * stage.pixelsPerMetre;
   const [factor, unit] = engineering(length, lengthUnit);
   parts.push(svgElement("line", { x1: 100 - pixels, y1: 50, x2: 100, y2: 50, "stroke-width": 3 }));
   const text = `${Number((factor * length).toPrecision(3))} ${unit}`.trim();
   parts.push(svgElement("text", { x: 100 - pixels / 2, y: 42 }, text));
   svg.querySelector("g").replaceChildren(...parts);
}
