/** Contact spots: flat discs in the planes of contact, drawn on top of the wires, which would hide them. */

import { Color, InstancedMesh, Matrix4, MeshBasicMaterial, Quaternion, SphereGeometry, Vector3 } from "three";

const COLOUR = new Color("#e8502a");
const CHOSEN = new Color("#111111");
const LEAST_PART = 0.15;
const THICKNESS = 0.18;
const LEAST_PIXELS = 6;
const CHOSEN_PIXELS = 8;
const RIM = 1.18;

/** The discs of one increment. */
export class Spots {
   constructor(scene) {
      this.scene = scene;
      this.layers = [];
      this.centres = [];
      this.sizes = [];
      this.chosen = -1;
   }

   /** centres, normals: arrays of Vector3; sizes: what the areas stand for; largest: of all increments; radii [m]. */
   set(centres, normals, sizes, largest, radii) {
      this.clear();
      this.centres = centres;
      this.sizes = sizes.map((size, k) =>
         radii[k] * Math.max(LEAST_PART, 0.85 * Math.sqrt(Math.abs(size) / (largest || 1))));
      const away = new Vector3(0, 0, 1);
      this.turns = normals.map((normal) => new Quaternion().setFromUnitVectors(away, normal.clone().normalize()));
      if (!centres.length) return;
      const ball = new SphereGeometry(1, 20, 14);
      this.layers = [1, 0].map((isRim) => {
         const material = new MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.9 });
         const mesh = new InstancedMesh(ball, material, centres.length);
         mesh.frustumCulled = false;
         mesh.renderOrder = isRim ? 1 : 2;
         this.scene.add(mesh);
         return mesh;
      });
      this.choose(this.chosen);
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

   /** Mark one of them; -1: none. */
   choose(index) {
      this.chosen = index;
      const [rim, disc] = this.layers;
      if (!disc) return;
      const white = new Color("#ffffff");
      this.centres.forEach((_, k) => {
         rim.setColorAt(k, white);
         disc.setColorAt(k, k === index ? CHOSEN : COLOUR);
      });
      rim.instanceColor.needsUpdate = disc.instanceColor.needsUpdate = true;
   }

   /** The factor that makes the largest disc visible at so many pixels per metre. */
   enlargement(pixelsPerMetre) {
      return Math.max(1, LEAST_PIXELS / (pixelsPerMetre * this.sizes.reduce((a, b) => Math.max(a, b), 1e-30)));
   }

   /** Place the discs, as large as they have to be at so many pixels per metre. */
   place(pixelsPerMetre) {
      const factor = this.enlargement(pixelsPerMetre);
      this.layers.forEach((mesh, layer) => {
         this.centres.forEach((centre, k) => {
            const least = k === this.chosen ? CHOSEN_PIXELS / pixelsPerMetre : 0;
            const radius = Math.max(factor * this.sizes[k], least) * (layer === 0 ? RIM : 1);
            const scale = new Vector3(radius, radius, THICKNESS * radius);
            mesh.setMatrixAt(k, new Matrix4().compose(centre, this.turns[k], scale));
         });
         mesh.instanceMatrix.needsUpdate = true;
      });
   }
}
