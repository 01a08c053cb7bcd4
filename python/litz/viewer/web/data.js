/** Reads results: from the page itself where they are in it, or else from the server that sends the page. */

/** The model, and a function that gives the data of an increment by its index. */
export async function openResults() {
   const read = document.getElementById("litz-model") ? readEmbedded : readFetched;
   const model = await read("model");
   const kept = new Map();
   const increment = (index) => {
      if (!kept.has(index)) {
         if (kept.size >= 64) kept.delete(kept.keys().next().value);
         kept.set(index, read(`increment-${index}`));
      }
      return kept.get(index);
   };
   return { model, increment };
}

async function readEmbedded(name) {
   const zipped = bytes(document.getElementById(`litz-${name}`).textContent.trim());
   const stream = new Blob([zipped]).stream().pipeThrough(new DecompressionStream("gzip"));
   return new Response(stream).json();
}

async function readFetched(name) {
   const answer = await fetch(`data/${name}`);
   if (!answer.ok) throw new Error(await answer.text());
   return answer.json();
}

/** Bytes of a base64 text. */
export function bytes(text) {
   return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
}

/** 32-bit floats of a base64 text. */
export function floats(text) {
   return new Float32Array(bytes(text).buffer);
}

/** 32-bit integers of a base64 text. */
export function integers(text) {
   return new Int32Array(bytes(text).buffer);
}

/** Values of a scalar at both ends of each element, [first, second, first, second, ...]. */
export function endValues(model, scalar, increment) {
   const parts = scalar.fields.map((name) => floats(increment.fields[name]));
   const width = parts[0].length / (scalar.at_nodes ? model.n_nodes : model.n_elements);
   const value = (row) => {
      if (scalar.component !== null) return parts[0][width * row + scalar.component];
      if (width === 1 && parts.length === 1) return parts[0][row];
      let sum = 0;
      for (const part of parts) for (let k = 0; k < width; k++) sum += part[width * row + k] ** 2;
      return Math.sqrt(sum);
   };
   return Float32Array.from({ length: 2 * model.n_elements }, (_, end) =>
      value(scalar.at_nodes ? model.elements[end] : end >> 1));
}

const PREFIXES = { "-15": "f", "-12": "p", "-9": "n", "-6": "µ", "-3": "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T" };
const SYMBOLS = { ohm: "Ω", "A/m^2": "A/m²", "N m": "N·m", Nm: "N·m", 1: "" };

const SI = ["m", "N", "Nm", "A", "V", "W", "J", "Pa", "S", "ohm"];

/** Factor and unit that bring a value between 1 and 1000; units that are not of the SI stay as they are. */
export function engineering(size, unit) {
   const symbol = SYMBOLS[unit] ?? unit;
   if (!SI.includes(unit.split(/[ /^]/)[0]) || !(size >= 1e-15) || !Number.isFinite(size)) return [1, symbol];
   const exponent = Math.min(12, Math.max(-15, 3 * Math.floor(Math.log10(size * (1 + 1e-9)) / 3)));
   return [10 ** -exponent, PREFIXES[exponent] + symbol];
}

/** A number with its unit, in six digits. */
export function quantity(value, unit) {
   if (typeof value !== "number") return value === null ? "–" : String(value);
   const [factor, symbol] = engineering(Math.abs(value), unit);
   return `${Number((factor * value).toPrecision(6))} ${symbol}`.trim();
}
