/** Contact spots: flat discs in the contact planes, drawn just before the two wires that touch, which would hide them.
 *
 * Each disc is an instance that the graphics processor places, sizes and colours: a picture costs no time per contact here.
 */

import { Color, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, ShaderMaterial, SphereGeometry, Vector3 } from "three";

const COLOUR = "#e8502a";
const SELECTED_COLOUR = "#111111";
const RIM_COLOUR = "#ffffff";
const OPACITY = 0.9;
const MIN_FRACTION = 0.15;
const RELATIVE_THICKNESS = 0.18;
const MIN_PIXELS = 6;
const SELECTED_MIN_PIXELS = 8;
const RIM_SCALE = 1.18;
const CLEARANCE = 1.05;
const LEAST_SINE = 0.3;

const VERTEX = `
   attribute vec3 rest;
   attribute vec3 now;
   attribute vec3 facing;   // normal of the contact plane
   attribute vec3 first;    // tangents and radii of both wires; radius 0: a rigid surface
   attribute vec3 second;
   attribute vec2 radii;
   attribute float size;
   uniform float deformation;
   uniform float factor;
   uniform float rim;
   uniform vec3 toward;     // the viewer
   uniform float minRadius; // with which wires are drawn
   uniform int selected;
   uniform float selectedMinRadius;
   uniform vec3 colour;
   uniform vec3 selectedColour;
   varying vec3 shown;

   // how far a wire extends from the contact towards the viewer, near it, as pictures of litz have it
   float reach(float radius, vec3 tangent, float ahead) {
      if (radius <= 0.) return 0.;
      float along = abs(dot(tangent, toward));
      float across = max(sqrt(max(1. - along * along, 0.)), ${LEAST_SINE.toFixed(2)});
      return max(radius, minRadius) / across * (1. + ahead / across + along);
   }

   void main() {
      bool isSelected = gl_InstanceID == selected;
      vec3 normal = normalize(facing);
      vec3 aside = abs(normal.x) < 0.6 ? vec3(1., 0., 0.) : vec3(0., 1., 0.);
      vec3 across = normalize(cross(normal, aside));
      float radius = rim * max(factor * size, isSelected ? selectedMinRadius : 0.);
      vec3 offset = radius * (position.x * across + position.y * cross(normal, across)
         + ${RELATIVE_THICKNESS.toFixed(2)} * position.z * normal);
      float ahead = dot(normal, toward);
      float before = max(reach(radii.x, first, ahead), reach(radii.y, second, -ahead));
      vec3 place = mix(rest, now, deformation) + ${CLEARANCE.toFixed(2)} * before * toward + offset;
      shown = isSelected ? selectedColour : colour;
      gl_Position = projectionMatrix * modelViewMatrix * vec4(place, 1.);
   }`;

const FRAGMENT = `
   uniform float opacity;
   varying vec3 shown;

   void main() {
      gl_FragColor = vec4(shown, opacity);
   }`;

/** The discs of one increment. */
export class Spots {
   constructor(scene) {
      this.scene = scene;
      this.layers = [];
      this.count = 0;
      this.largest = 1e-30;
      this.uniforms = {
         deformation: { value: 1 }, factor: { value: 1 }, toward: { value: new Vector3(0, 0, 1) }, minRadius: { value: 0 },
         selected: { value: -1 }, selectedMinRadius: { value: 0 }, opacity: { value: OPACITY },
      };
   }

   /**
    * places: rest, now, normals, tangents of both wires, radii of both [m] (0 for a rigid surface), as 32-bit floats, contact after
    * contact; deformation: factor on the displacements; sizes: shown by the areas; largest: their maximum over all increments.
    */
   set({ rest, now, normals, tangents, radii }, deformation, sizes, largest) {
      this.clear();
      const n = this.count = sizes.length;
      Object.assign(this, { rest, now });
      this.uniforms.deformation.value = deformation;
      this.sizes = Float32Array.from({ length: n }, (_, k) => {
         const thinner = radii[2 * k + 1] > 0 ? Math.min(radii[2 * k], radii[2 * k + 1]) : radii[2 * k];
         return thinner * Math.max(MIN_FRACTION, 0.85 * Math.sqrt(Math.abs(sizes[k]) / (largest || 1)));
      });
      this.largest = this.sizes.reduce((a, b) => Math.max(a, b), 1e-30);
      if (!n) return;
      const sphere = new SphereGeometry(1, ...(n > 20000 ? [8, 4] : n > 3000 ? [10, 6] : [20, 14]));
      const geometry = new InstancedBufferGeometry();
      geometry.setIndex(sphere.index);
      geometry.setAttribute("position", sphere.attributes.position);
      const columns = { rest: [rest, 3], now: [now, 3], facing: [normals, 3], first: [part(tangents, n, 0), 3],
         second: [part(tangents, n, 1), 3], radii: [radii, 2], size: [this.sizes, 1] };
      for (const [name, [values, width]] of Object.entries(columns))
         geometry.setAttribute(name, new InstancedBufferAttribute(values, width));
      geometry.instanceCount = n;
      this.layers = [[RIM_SCALE, RIM_COLOUR, RIM_COLOUR], [1, COLOUR, SELECTED_COLOUR]].map(([rim, colour, selectedColour], layer) => {
         const material = new ShaderMaterial({
            vertexShader: VERTEX, fragmentShader: FRAGMENT, depthWrite: false, transparent: true,
            uniforms: { ...this.uniforms, rim: { value: rim }, colour: { value: onScreen(colour) },
               selectedColour: { value: onScreen(selectedColour) } },
         });
         const mesh = new Mesh(geometry, material);
         mesh.frustumCulled = false;
         mesh.renderOrder = 1 + layer;
         this.scene.add(mesh);
         return mesh;
      });
   }

   clear() {
      for (const mesh of this.layers) {
         this.scene.remove(mesh);
         mesh.geometry.dispose();
         mesh.material.dispose();
      }
      this.layers = [];
      this.count = 0;
   }

   /** The highlighted one; -1: none. */
   get selected() {
      return this.uniforms.selected.value;
   }

   set selected(index) {
      this.uniforms.selected.value = index;
   }

   /** Place of one of them. */
   centre(k) {
      const at = (values) => new Vector3(...values.subarray(3 * k, 3 * k + 3));
      return at(this.rest).lerp(at(this.now), this.uniforms.deformation.value);
   }

   /** Magnification that keeps the largest disc visible at a given resolution. */
   enlargement(pixelsPerMetre) {
      return Math.max(1, MIN_PIXELS / (pixelsPerMetre * this.largest));
   }

   /** The one nearest to a position of the picture, of those whose disc, or whose reach in pixels, covers it; -1: none. */
   nearest(stage, x, y, reach) {
      const { rest, now, sizes } = this, deformation = this.uniforms.deformation.value;
      const factor = this.enlargement(stage.pixelsPerMetre) * stage.pixelsPerMetre;
      const [toLeft, toTop] = stage.projection();
      let found = -1, least = Infinity;
      for (let k = 0, row = 0; k < this.count; k++, row += 3) {
         const a = rest[row] + deformation * (now[row] - rest[row]);
         const b = rest[row + 1] + deformation * (now[row + 1] - rest[row + 1]);
         const c = rest[row + 2] + deformation * (now[row + 2] - rest[row + 2]);
         const distance = Math.hypot(toLeft[0] * a + toLeft[1] * b + toLeft[2] * c + toLeft[3] - x,
            toTop[0] * a + toTop[1] * b + toTop[2] * c + toTop[3] - y);
         if (distance < least && distance < Math.max(reach, factor * sizes[k])) [least, found] = [distance, k];
      }
      return found;
   }

   /** Draw for a given resolution and direction to the viewer; minRadius: with which wires are drawn [m]. */
   place(pixelsPerMetre, toward, minRadius) {
      const { uniforms } = this;
      uniforms.factor.value = this.enlargement(pixelsPerMetre);
      uniforms.toward.value.copy(toward);
      uniforms.minRadius.value = minRadius;
      uniforms.selectedMinRadius.value = SELECTED_MIN_PIXELS / pixelsPerMetre;
   }
}

/** Every other vector of those of both wires. */
function part(vectors, n, which) {
   const values = new Float32Array(3 * n);
   for (let k = 0; k < n; k++)
      for (let axis = 0; axis < 3; axis++) values[3 * k + axis] = vectors[6 * k + 3 * which + axis];
   return values;
}

/** A colour as the screen has it: what shaders write is not converted. */
function onScreen(colour) {
   return new Color().setStyle(colour).convertLinearToSRGB();
}
