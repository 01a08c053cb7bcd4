/** Contact spots: flat discs in the contact planes, drawn just before the two wires that touch, which would hide them. */

import { Color, InstancedMesh, Matrix4, MeshBasicMaterial, Quaternion, SphereGeometry, Vector3 } from "three";

const COLOUR = new Color("#e8502a");
const SELECTED_COLOUR = new Color("#111111");
const MIN_FRACTION = 0.15;
const RELATIVE_THICKNESS = 0.18;
const MIN_PIXELS = 6;
const SELECTED_MIN_PIXELS = 8;
const RIM_SCALE = 1.18;
const CLEARANCE = 1.05;
const LEAST_SINE = 0.3;

/** The discs of one increment. */
export class Spots {
   constructor(scene) {
      this.scene = scene;
      this.layers = [];
      this.centres = [];
      this.sizes = [];
      this.selected = -1;
   }

   /**
    * centres, normals: arrays of Vector3; sizes: shown by the areas; largest: their maximum over all increments;
    * radii: of both wires of each contact [m], 0 for a rigid surface; tangents: of both, arrays of Vector3.
    */
   set(centres, normals, sizes, largest, radii, tangents) {
      this.clear();
      this.centres = centres;
      Object.assign(this, { normals, radii, tangents });
      const thinner = (k) => (radii[2 * k + 1] > 0 ? Math.min(radii[2 * k], radii[2 * k + 1]) : radii[2 * k]);
      this.sizes = sizes.map((size, k) =>
         thinner(k) * Math.max(MIN_FRACTION, 0.85 * Math.sqrt(Math.abs(size) / (largest || 1))));
      const away = new Vector3(0, 0, 1);
      this.rotations = normals.map((normal) => new Quaternion().setFromUnitVectors(away, normal.clone().normalize()));
      if (!centres.length) return;
      const sphere = new SphereGeometry(1, 20, 14);
      this.layers = [1, 0].map((isRim) => {
         const material = new MeshBasicMaterial({ depthWrite: false, transparent: true, opacity: 0.9 });
         const mesh = new InstancedMesh(sphere, material, centres.length);
         mesh.frustumCulled = false;
         mesh.renderOrder = isRim ? 1 : 2;
         this.scene.add(mesh);
         return mesh;
      });
      this.select(this.selected);
   }

   clear() {
      for (const mesh of this.layers) {
         this.scene.remove(mesh);
         mesh.geometry.dispose();
         mesh.material.dispose();
         mesh.dispose();
      }
      this.layers = [];
      this.centres = [];
      this.sizes = [];
   }

   set visible(shown) {
      for (const mesh of this.layers) mesh.visible = shown;
   }

   /** Highlight one of them; -1: none. */
   select(index) {
      this.selected = index;
      const [rim, disc] = this.layers;
      if (!disc) return;
      const white = new Color("#ffffff");
      this.centres.forEach((_, k) => {
         rim.setColorAt(k, white);
         disc.setColorAt(k, k === index ? SELECTED_COLOUR : COLOUR);
      });
      rim.instanceColor.needsUpdate = disc.instanceColor.needsUpdate = true;
   }

   /** Magnification that keeps the largest disc visible at a given resolution. */
   enlargement(pixelsPerMetre) {
      return Math.max(1, MIN_PIXELS / (pixelsPerMetre * this.sizes.reduce((a, b) => Math.max(a, b), 1e-30)));
   }

   /** How far the two wires of a contact extend from it towards the viewer, near it, as pictures of litz have it [m]. */
   reach(k, toward, minRadius) {
      const ahead = this.normals[k].dot(toward);
      return Math.max(...[0, 1].map((side) => {
         const radius = this.radii[2 * k + side] && Math.max(this.radii[2 * k + side], minRadius);
         const along = Math.abs(this.tangents[2 * k + side].dot(toward));
         const across = Math.max(Math.sqrt(Math.max(1 - along * along, 0)), LEAST_SINE);
         return (radius / across) * (1 + ((side ? -ahead : ahead) / across) + along);
      }));
   }

   /** Position and scale the discs for a given resolution and a direction to the viewer; minRadius: drawn, of wires [m]. */
   place(pixelsPerMetre, toward, minRadius) {
      const factor = this.enlargement(pixelsPerMetre);
      this.layers.forEach((mesh, layer) => {
         this.centres.forEach((centre, k) => {
            const minRadius = k === this.selected ? SELECTED_MIN_PIXELS / pixelsPerMetre : 0;
            const radius = Math.max(factor * this.sizes[k], minRadius) * (layer === 0 ? RIM_SCALE : 1);
            const scale = new Vector3(radius, radius, RELATIVE_THICKNESS * radius);
            const before = centre.clone().addScaledVector(toward, CLEARANCE * this.reach(k, toward, minRadius));
            mesh.setMatrixAt(k, new Matrix4().compose(before, this.rotations[k], scale));
         });
         mesh.instanceMatrix.needsUpdate = true;
      });
   }
}
