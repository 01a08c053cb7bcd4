/** Rigid surfaces: half transparent patches that move with their reference nodes. */

import {
   BufferAttribute, BufferGeometry, Color, DoubleSide, LineBasicMaterial, LineSegments, Mesh, ShaderMaterial,
} from "three";
import { floats, integers } from "litz/data.js";

const COLOUR = new Color("#8296aa");
const OPACITY = 0.3;

const VERTEX = `
   varying vec3 place;

   void main() {
      vec4 seen = modelViewMatrix * vec4(position, 1.);
      place = seen.xyz;
      gl_Position = projectionMatrix * seen;
   }`;

const FRAGMENT = `
   uniform vec3 colour;
   uniform float opacity;
   varying vec3 place;

   void main() {
      vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
      float light = 0.6 + 0.4 * abs(dot(normal, normalize(vec3(-0.5, 0.6, 1.))));
      gl_FragColor = vec4(light * colour, opacity);
   }`;

/** The patches of a model. */
export class Surfaces {
   /** surfaces: names, corners before any deformation, faces of four corners, and edges, as the model has them. */
   constructor(scene, surfaces) {
      this.patches = surfaces.map(({ name, rest, quads, rim }) => {
         const corners = floats(rest);
         const place = new BufferAttribute(new Float32Array(corners), 3);
         const faces = geometryOf(place, triangles(integers(quads)));
         const material = new ShaderMaterial({
            vertexShader: VERTEX, fragmentShader: FRAGMENT, side: DoubleSide, transparent: true, depthWrite: false,
            uniforms: { colour: { value: COLOUR }, opacity: { value: OPACITY } },
         });
         const edges = geometryOf(place, Array.from(integers(rim)));
         scene.add(withoutCulling(new Mesh(faces, material)));
         scene.add(withoutCulling(new LineSegments(edges, new LineBasicMaterial({ color: COLOUR }))));
         return { name, corners, place };
      });
   }

   /** Move the patches: their corners at an increment, and the factor on displacements. */
   move(now, factor) {
      this.patches.forEach(({ corners, place }, k) => {
         const moved = floats(now[k]);
         place.array.set(corners.map((value, i) => value + factor * (moved[i] - value)));
         place.needsUpdate = true;
      });
   }
}

function geometryOf(place, index) {
   const geometry = new BufferGeometry();
   geometry.setAttribute("position", place);
   geometry.setIndex(index);
   return geometry;
}

/** The bounds of a patch change with each increment. */
function withoutCulling(object) {
   object.frustumCulled = false;
   return object;
}

/** Two triangles for each face of four corners. */
function triangles(quads) {
   const index = [];
   for (let k = 0; k < quads.length; k += 4) {
      const [a, b, c, d] = quads.subarray(k, k + 4);
      index.push(a, b, c, a, c, d);
   }
   return index;
}
