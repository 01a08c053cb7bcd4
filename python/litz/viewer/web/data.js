/** Reads results: embedded in the page, or fetched from the server that serves the page. */

// Elements and nodes of all increments that are kept
const MAX_KEPT = 2e6;

/** The model, and a function that returns the data of an increment by its index. */
export async function openResults() {
   const embedded = document.getElementById("litz-model") !== null;
   const read = embedded ? readEmbedded : fetchFromServer;
   const model = await read("model");
   const load = async (index) => {
      const data = await read(`increment-${index}`);
      return embedded ? placed(data, model) : data;
   };
   const cache = new Map();
   const most = Math.min(64, Math.max(2, Math.floor(MAX_KEPT / (model.n_elements + model.n_nodes))));
   const increment = (index) => {
      if (!cache.has(index)) {
         if (cache.size >= most) cache.delete(cache.keys().next().value);
         cache.set(index, load(index));
      }
      return cache.get(index);
   };
   return { model, increment };
}

async function readEmbedded(name) {
   const zipped = bytes(document.getElementById(`litz-${name}`).textContent.trim());
   const stream = new Blob([zipped]).stream().pipeThrough(new DecompressionStream("gzip"));
   return unpack(await new Response(stream).arrayBuffer());
}

/** A part of a page: the length of its JSON, the JSON, and its arrays, which become typed ones. */
export function unpack(buffer) {
   const start = 4 + new DataView(buffer).getUint32(0, true);
   const arrays = new Uint8Array(buffer, start);
   return JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, start - 4)), (_, value) =>
      value?.planes ? numbers(value, arrays) : value);
}

/** Numbers of steps, from the differences down each column: 0, 1, 2, 3, ... are 0, -1, 1, -2, ...; low bytes come first. */
function numbers({ rows, steps, planes, at, none }, arrays) {
   const columns = steps.length;
   const values = new Float32Array(rows * columns);
   for (let column = 0; column < columns; column++) {
      let count = 0;
      for (let row = 0; row < rows; row++) {
         let folded = 0;
         for (let plane = planes; plane--;) folded = 256 * folded + arrays[at + (plane * columns + column) * rows + row];
         count += folded % 2 ? -(folded + 1) / 2 : folded / 2;
         values[row * columns + column] = count === none ? NaN : count * steps[column];
      }
   }
   return values;
}

/** An increment of a page with places instead of displacements, and with lists of contacts. */
function placed(data, model) {
   const add = (moved, rest) => moved.map((value, k) => value + rest[k]);
   data.curves = add(data.curves, model.rest);
   for (const part of [data.spots, data.lines]) part.now = add(part.now, part.rest);
   data.contacts = Object.fromEntries(Object.entries(data.contacts).map(([name, column]) => [name, Array.from(column)]));
   return data;
}

async function fetchFromServer(name) {
   const response = await fetch(`data/${name}`);
   if (!response.ok) throw new Error(await response.text());
   return response.json();
}

/** Decode base64 text into bytes; numbers of a page are decoded already. */
export function bytes(text) {
   if (typeof text !== "string") return Uint8Array.from(text);
   const letters = atob(text);
   const values = new Uint8Array(letters.length);
   for (let k = 0; k < letters.length; k++) values[k] = letters.charCodeAt(k);
   return values;
}

/** Decode base64 text into 32-bit floats. */
export function floats(text) {
   if (typeof text !== "string") return text;
   return new Float32Array(bytes(text).buffer);
}

/** Decode base64 text into 32-bit integers. */
export function integers(text) {
   if (typeof text !== "string") return Int32Array.from(text);
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

/** Factor and prefixed unit that scale a value to between 1 and 1000; units outside the SI are left unchanged. */
export function engineering(size, unit) {
   const symbol = SYMBOLS[unit] ?? unit;
   if (!SI.includes(unit.split(/[ /^]/)[0]) || !(size >= 1e-15) || !Number.isFinite(size)) return [1, symbol];
   const exponent = Math.min(12, Math.max(-15, 3 * Math.floor(Math.log10(size * (1 + 1e-9)) / 3)));
   return [10 ** -exponent, PREFIXES[exponent] + symbol];
}

/** Format a number with its unit, to six significant digits. */
export function quantity(value, unit) {
   if (typeof value !== "number") return value === null ? "–" : String(value);
   const [factor, symbol] = engineering(Math.abs(value), unit);
   return `${Number((factor * value).toPrecision(6))} ${symbol}`.trim();
}
