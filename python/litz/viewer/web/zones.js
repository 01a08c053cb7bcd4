/** Zones of contact along lines: coloured by the force per length, drawn before the two wires that touch, which would hide them. */

import { Vector3 } from "three";
import { floats, integers } from "litz/data.js";
import { Tubes } from "litz/tubes.js";

const MIN_PIXELS = 1.6;
const SELECTED_SCALE = 1.8;

/** The lines of one increment. */
export class Zones {
   /** depth: what is seen in depth [m]. */
   constructor(scene, depth) {
      this.scene = scene;
      this.depth = depth;
      this.tubes = null;
      this.middles = [];
      this.zones = [];
      this.selected = -1;
   }

   /** lines: the pieces of an increment; factor: scale of the displacements; table, limits: colours of the force per length. */
   set(lines, factor, table, limits) {
      this.clear();
      const radii = floats(lines.radii);
      if (!radii.length) return;
      this.radii = Float32Array.from(radii);
      this.zones = integers(lines.zones);
      this.tubes = new Tubes(floats(lines.rest), radii, lines.before / this.depth);
      this.tubes.setShape(floats(lines.now), factor);
      this.tubes.setValues(floats(lines.values));
      this.tubes.setColours(table, limits);
      this.scene.add(this.tubes.mesh);
      const { curves } = this.tubes;
      this.middles = Array.from(radii, (_, k) => new Vector3(...curves.subarray(12 * k, 12 * k + 3))
         .lerp(new Vector3(...curves.subarray(12 * k + 3, 12 * k + 6)), 0.5));
      this.select(this.selected);
   }

   /** Draw one of them thicker, by its row; -1: none. */
   select(row) {
      this.selected = row;
      this.tubes?.setRadii(this.radii.map((radius, k) => (this.zones[k] === row ? SELECTED_SCALE : 1) * radius));
   }

   clear() {
      if (this.tubes) {
         this.scene.remove(this.tubes.mesh);
         this.tubes.dispose();
      }
      this.tubes = null;
      this.middles = [];
   }

   /** Keep the lines visible at a given resolution. */
   place(pixelsPerMetre) {
      this.tubes?.setMinRadius(MIN_PIXELS / pixelsPerMetre);
   }

   /** Row of the zone nearest to a position of the picture, within a number of pixels; -1: none. */
   nearest(stage, x, y, reach) {
      let found = -1, least = reach;
      this.middles.forEach((middle, k) => {
         const [left, top] = stage.project(middle);
         const distance = Math.hypot(left - x, top - y);
         if (distance < least) [least, found] = [distance, this.zones[k]];
      });
      return found;
   }
}
