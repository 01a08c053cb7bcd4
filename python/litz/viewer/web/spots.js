/** Contact spots: flat discs in the contact planes, drawn on top of the wires so that they are not hidden. */

import { Color, InstancedMesh, Matrix4, MeshBasicMaterial, Quaternion, SphereGeometry, Vector3 } from "three";

const COLOUR = new Color("#e8502a");
const SELECTED_COLOUR = new Color("#111111");
const MIN_FRACTION = 0.15;
const RELATIVE_THICKNESS = 0.18;
const MIN_PIXELS = 6;
const SELECTED_MIN_PIXELS = 8;
const RIM_SCALE = 1.18;

/** The discs of one increment. */
export class Spots {
   constructor(scene) {
      this.scene = scene;
      this.layers = [];
      this.centres = [];
      this.sizes = [];
      this.selected = -1;
   }

   /** centres, normals: arrays of Vector3; sizes: shown by the areas; largest: their maximum over all increments; radii [m]. */
   set(centres, normals, sizes, largest, radii) {
      this.clear();
      this.centres = centres;
      this.sizes = sizes.map((size, k) =>
         radii[k] * Math.max(MIN_FRACTION, 0.85 * Math.sqrt(Math.abs(size) / (largest || 1))));
      const away = new Vector3(0, 0, 1);
      this.rotations = normals.map((normal) => new Quaternion().setFromUnitVectors(away, normal.clone().normalize()));
      if (!centres.length) return;
      const sphere = new SphereGeometry(1, 20, 14);
      this.layers = [1, 0].map((isRim) => {
         const material = new MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.9 });
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

   /** Position and scale the discs for a given resolution. */
   place(pixelsPerMetre) {
      const factor = this.enlargement(pixelsPerMetre);
      this.layers.forEach((mesh, layer) => {
         this.centres.forEach((centre, k) => {
            const minRadius = k === this.selected ? SELECTED_MIN_PIXELS / pixelsPerMetre : 0;
            const radius = Math.max(factor * this.sizes[k], minRadius) * (layer === 0 ? RIM_SCALE : 1);
            const scale = new Vector3(radius, radius, RELATIVE_THICKNESS * radius);
            mesh.setMatrixAt(k, new Matrix4().compose(centre, this.rotations[k], scale));
         });
         mesh.instanceMatrix.needsUpdate = true;
      });
   }
}
