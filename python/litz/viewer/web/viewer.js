/** Assembles the viewer: results, stage, wires, spots, zones, ledger and controls. */

import { bytes, endValues, engineering, floats, integers, openResults } from "litz/data.js";
import { drawColourBar, drawCompass } from "litz/frame.js";
import { Ledger } from "litz/ledger.js";
import { Prisms } from "litz/prisms.js";
import { Spots } from "litz/spots.js";
import { Stage } from "litz/stage.js";
import { Surfaces } from "litz/surfaces.js";
import { Tubes, referenceLines } from "litz/tubes.js";
import { Zones } from "litz/zones.js";

const MIN_PIXELS = 0.8;

class Viewer {
   constructor(root, { model, increment }) {
      this.root = root;
      this.model = { ...model, elements: integers(model.elements) };
      this.load = increment;
      const rest = floats(model.rest);
      this.stage = new Stage(this.find("canvas"), model.radius, model.view);
      const radii = floats(model.radii).slice();
      for (const { elements } of model.outlines) for (const element of integers(elements)) radii[element] = -1;
      this.tubes = new Tubes(rest, radii);
      this.prisms = new Prisms(this.model.elements, model.outlines, model.frames, this.tubes);
      this.reference = referenceLines(rest);
      this.spots = new Spots(this.stage.scene);
      this.surfaces = new Surfaces(this.stage.scene, model.surfaces);
      this.zones = new Zones(this.stage.scene, this.stage.depth);
      this.ledger = new Ledger(root, model.ledger, model.surface_ledger, model.zones.columns, (id) => this.select(id));
      this.tables = Object.fromEntries(Object.entries(model.colours).map(([name, text]) => [name, bytes(text)]));
      this.stage.scene.add(this.tubes.mesh, this.prisms.mesh, this.reference);
      this.stage.beforeDraw(() => {
         const minRadius = MIN_PIXELS / this.stage.pixelsPerMetre;
         this.tubes.setMinRadius(minRadius);
         this.spots.place(this.stage.pixelsPerMetre, this.stage.toward, minRadius);
         this.zones.place(this.stage.pixelsPerMetre);
         drawCompass(this.find("compass"), this.stage, model.units.m);
      });
      this.stage.onClick((x, y) => this.pick(x, y));
      this.fillControls();
   }

   find(name) {
      return this.root.querySelector(`.litz-${name}`);
   }

   fillControls() {
      const { model } = this;
      const fields = this.find("field");
      fields.append(...model.scalars.map(({ name, text }) => new Option(text.replaceAll("_", " "), name)));
      fields.value = model.scalar;
      if (!model.largest.current) this.find("spot-size").value = "force";
      const slider = this.find("increment");
      slider.max = model.times.length - 1;
      slider.value = slider.max;
      slider.addEventListener("input", () => this.show(Number(slider.value)));
      for (const name of ["field", "range", "spot-size", "with-reference"])
         this.find(name).addEventListener("change", () => this.update());
      this.find("scale").addEventListener("input", () => this.update());
      for (const button of this.root.querySelectorAll("[data-view]"))
         button.addEventListener("click", () => this.look(button.dataset.view));
      this.find("play").addEventListener("click", () => this.play());
      this.root.addEventListener("keydown", (event) => this.key(event));
   }

   /** Show an increment, by its index in the page. */
   async show(index) {
      this.requested = index;
      const data = await this.load(index);
      // another increment may have been requested in the meantime
      if (this.requested !== index) return;
      this.data = data;
      this.index = index;
      this.find("increment").value = index;
      const { steps, increments, times } = this.model;
      this.find("time").textContent =
         `step ${steps[index]}, increment ${increments[index]}, time ${Number(times[index].toPrecision(6))} ${this.model.units.s}`;
      this.update();
   }

   /** Update everything from the controls. */
   update() {
      const { model, data } = this;
      const factor = Math.max(0, Number(this.find("scale").value) || 0);
      this.tubes.setShape(floats(data.curves), factor);
      this.prisms.setShape(floats(data.frames), factor);
      const scalar = model.scalars.find(({ name }) => name === this.find("field").value);
      const ends = endValues(model, scalar, data);
      const { colours, limits } = this.range(scalar, ends);
      const text = scalar.text.replaceAll("_", " ");
      this.greyNote = ends.some(Number.isNaN) ? `grey wires: no ${text}` : "";
      this.tubes.setValues(ends);
      this.prisms.setValues(ends);
      this.tubes.setColours(this.tables[colours], limits);
      this.surfaces.move(data.surfaces, factor);
      this.updateSpots(factor);
      this.updateZones(factor);
      drawColourBar(this.find("colours"), this.tables[colours], limits, text, scalar.unit);
      this.reference.visible = this.find("with-reference").checked;
      this.ledger.show(data.contacts, data.zones);
      this.stage.draw();
      this.root.dataset.increment = this.index;
      this.root.dataset.limits = limits.join(" ");
   }

   /** Colours and limits of a scalar: for the whole run, or for this increment. */
   range(scalar, ends) {
      if (this.find("range").value === "run") return scalar;
      const known = ends.filter((value) => !Number.isNaN(value));
      const low = known.reduce((a, b) => Math.min(a, b), Infinity), high = known.reduce((a, b) => Math.max(a, b), -Infinity);
      if (!(high - low > 1e-6 * Math.max(Math.abs(low), Math.abs(high)))) return scalar;
      const largest = Math.max(-low, high);
      return scalar.colours === "coolwarm"
         ? { colours: scalar.colours, limits: [-largest, largest] }
         : { colours: scalar.colours, limits: [low, high] };
   }

   updateSpots(factor) {
      const { data, model } = this;
      const by = this.find("spot-size").value;
      const n = by === "none" ? 0 : data.contacts.id.length;
      const places = Object.fromEntries(Object.entries(data.spots).map(([name, text]) => [name, floats(text)]));
      this.spots.selected = data.contacts.id.indexOf(this.ledger.selected);
      this.spots.set(places, factor, n ? data.contacts[by] : [], model.largest[by]);
      const notes = [this.spotNote(by, n), model.contact_texts[this.index], this.greyNote, model.shape_text];
      this.find("spot-note").textContent = notes.filter(Boolean).join("; ");
   }

   updateZones(factor) {
      const { data, model } = this;
      const { limits, title, unit } = model.zones;
      const hidden = this.find("spot-size").value === "none" || !data.zones.id.length;
      this.find("zone-colours").hidden = hidden;
      if (hidden) {
         this.zones.clear();
         return;
      }
      this.zones.selected = data.zones.id.indexOf(this.ledger.selected);
      this.zones.set(data.lines, factor, this.tables.zones, limits);
      drawColourBar(this.find("zone-colours"), this.tables.zones, limits, title, unit);
   }

   spotNote(by, n) {
      if (by === "none") return "";
      const zones = this.data.zones.id.length;
      const lines = zones ? `${zones} zone${zones > 1 ? "s" : ""} of line contact` : "";
      if (!n) return lines;
      const largest = this.data.contacts[by].reduce((a, b) => Math.max(a, Math.abs(b)), 0);
      const [factor, unit] = engineering(largest, this.model.units[{ force: "N", current: "A" }[by]]);
      return `${n} contact${n > 1 ? "s" : ""}, disc area proportional to ${by}, `
         + `maximum ${Number((factor * largest).toPrecision(3))} ${unit}${lines ? `; ${lines}` : ""}`;
   }

   /** Select the contact at a position of the picture, if there is one. */
   pick(x, y) {
      const { stage, spots } = this;
      let found = this.data.contacts.id[spots.nearest(stage, x, y, 8)] ?? null;
      if (found === null) found = this.data.zones.id[this.zones.nearest(stage, x, y, 12)] ?? null;
      this.select(found);
   }

   /** Select a contact by its number; null: none. */
   select(id) {
      this.ledger.select(id);
      this.spots.selected = this.data.contacts.id.indexOf(id);
      this.zones.select(this.data.zones.id.indexOf(id));
      this.stage.draw();
   }

   /** Screen position of a contact of this increment, in pixels from the upper left corner of the picture. */
   screenPosition(id) {
      return this.stage.project(this.spots.centre(this.data.contacts.id.indexOf(id)));
   }

   look(name) {
      const views = { x: [[1, 0, 0], [0, 0, 1]], "-y": [[0, -1, 0], [0, 0, 1]], z: [[0, 0, 1], [0, 1, 0]],
         iso: [[1, -1, 0.8], [0, 0, 1]], home: [this.model.view.toward, this.model.view.up] };
      this.stage.look(...views[name]);
   }

   /** Start or stop playing the increments. */
   play() {
      const button = this.find("play");
      if (this.timer) {
         clearInterval(this.timer);
         this.timer = null;
      } else {
         const n = this.model.times.length;
         let next = this.index + 1 < n ? this.index + 1 : 0;
         this.timer = setInterval(() => {
            this.show(next++);
            if (next >= n) this.play();
         }, Math.max(80, Math.min(500, 6000 / n)));
      }
      button.textContent = this.timer ? "❚❚" : "▶";
      button.title = this.timer ? "stop" : "play";
   }

   key(event) {
      if (["INPUT", "SELECT"].includes(event.target.tagName) && event.target.type !== "range") return;
      const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (!step || event.target.type === "range") return;
      this.show(Math.min(this.model.times.length - 1, Math.max(0, this.index + step)));
      event.preventDefault();
   }
}

async function start(root) {
   const message = root.querySelector(".litz-message");
   try {
      root.viewer = new Viewer(root, await openResults());
      await root.viewer.show(root.viewer.model.times.length - 1);
      message.remove();
      root.dataset.ready = "yes";
   } catch (error) {
      message.textContent = `The results cannot be shown: ${error.message}`;
      console.error(error);
   }
}

for (const root of document.querySelectorAll(".litz-viewer")) start(root);
