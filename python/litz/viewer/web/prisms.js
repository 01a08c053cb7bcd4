/** Wires whose sections are not round: their outlines swept along the elements, turning with the nodes. */

import { BufferAttribute, BufferGeometry, DoubleSide, Mesh, ShaderMaterial, Vector3 } from "three";
import { floats, integers } from "litz/data.js";
import { FRAGMENT, shownValues } from "litz/tubes.js";

const PIECES = 12;
const VERTEX = `
   attribute float scalar;
   varying vec3 viewNormal;
   varying float value;

   void main() {
      viewNormal = normalMatrix * normal;
      value = scalar;
      gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.);
   }`;

/** The elements that have an outline, one after another. */
export class Prisms {
   /**
    * nodes: of all elements; outlines: of each section its elements, its corners along the section axes, and the corners of
    * triangles that fill it; frames: the first section axis at both ends of these elements before any deformation; tubes: whose colours they have.
    */
   constructor(nodes, outlines, frames, tubes) {
      this.tubes = tubes;
      this.frames = floats(frames);
      this.elements = [];
      const triangles = [];
      let first = 0;
      for (const { elements, corners, caps } of outlines) {
         const places = pairs(floats(corners)), filling = integers(caps), rows = integers(elements);
         const count = new Map();
         const ends = (element) => [nodes[2 * element], nodes[2 * element + 1]];
         for (const element of rows) for (const node of ends(element)) count.set(node, (count.get(node) ?? 0) + 1);
         for (const element of rows) {
            this.elements.push({ element, sides: sidesOf(places), corners: places });
            // where the next element goes on, a cap would shine through
            const isFree = ends(element).map((node) => count.get(node) === 1);
            first = addTriangles(triangles, first, places.length, filling, isFree);
         }
      }
      const geometry = new BufferGeometry();
      for (const [name, size] of [["position", 3], ["normal", 3], ["scalar", 1]])
         geometry.setAttribute(name, new BufferAttribute(new Float32Array(size * first), size));
      geometry.setIndex(triangles);
      this.mesh = new Mesh(geometry, new ShaderMaterial({
         vertexShader: VERTEX, fragmentShader: FRAGMENT, side: DoubleSide, uniforms: tubes.material.uniforms,
      }));
      this.mesh.frustumCulled = false;
   }

   /** Set the section axes, with a scale factor for the deformation, along the curves of the tubes. */
   setShape(now, factor) {
      const { position, normal } = this.mesh.geometry.attributes;
      const { curves } = this.tubes, rest = this.frames;
      const axis = (start) => new Vector3(...[0, 1, 2].map((k) => rest[start + k] + factor * (now[start + k] - rest[start + k])));
      let place = 0;
      const add = (point, direction) => {
         position.setXYZ(place, point.x, point.y, point.z);
         normal.setXYZ(place++, direction.x, direction.y, direction.z);
      };
      this.elements.forEach(({ element, sides, corners }, number) => {
         const begin = axis(6 * number), end = axis(6 * number + 3);
         const sections = Array.from({ length: PIECES + 1 }, (_, k) => sectionAt(curves, 12 * element, k / PIECES, begin, end));
         for (const { across, point } of sections)
            for (const { ends, outward } of sides)
               for (const corner of ends) add(across(corner).add(point), across(outward));
         for (const [{ across, point, along }, sign] of [[sections[0], -1], [sections[PIECES], 1]])
            for (const corner of corners) add(across(corner).add(point), along.clone().multiplyScalar(sign));
      });
      position.needsUpdate = normal.needsUpdate = true;
   }

   /** ends: values at both ends of all elements. */
   setValues(values) {
      const ends = shownValues(values);
      const { scalar } = this.mesh.geometry.attributes;
      let place = 0;
      for (const { element, corners } of this.elements) {
         const [first, last] = [ends[2 * element], ends[2 * element + 1]], n = corners.length;
         for (let k = 0; k <= PIECES; k++, place += 2 * n)
            scalar.array.fill(first + (k / PIECES) * (last - first), place, place + 2 * n);
         scalar.array.fill(first, place, place + n).fill(last, place + n, place + 2 * n);
         place += 2 * n;
      }
      scalar.needsUpdate = true;
   }
}

/** Point, tangent, and what turns a pair of components into a vector, at a part of an element between two first axes. */
function sectionAt(curves, start, part, begin, end) {
   const xi = 2 * part - 1, xi2 = xi * xi, xi3 = xi2 * xi;
   const sum = (weights) => new Vector3(...[0, 1, 2].map((k) =>
      weights.reduce((total, weight, row) => total + (weight / 4) * curves[start + 3 * row + k], 0)));
   const point = sum([2 - 3 * xi + xi3, 2 + 3 * xi - xi3, 1 - xi - xi2 + xi3, -1 - xi + xi2 + xi3]);
   const along = sum([3 * xi2 - 3, 3 - 3 * xi2, -1 - 2 * xi + 3 * xi2, -1 + 2 * xi + 3 * xi2]).normalize();
   const first = begin.clone().lerp(end, part);
   first.addScaledVector(along, -first.dot(along)).normalize();
   const second = along.clone().cross(first);
   return { point, along, across: ([a, b]) => first.clone().multiplyScalar(a).addScaledVector(second, b) };
}

/** Both corners of each side of an anticlockwise outline, and the outward normal. */
function sidesOf(corners) {
   return corners.map((corner, k) => {
      const next = corners[(k + 1) % corners.length];
      const [a, b] = [next[0] - corner[0], next[1] - corner[1]], length = Math.hypot(a, b);
      return { ends: [corner, next], outward: [b / length, -a / length] };
   });
}

/** Rows of the vertices of one element of n sides, which begin at `first`; returns where those of the next one begin. */
function addTriangles(triangles, first, n, caps, isFree) {
   for (let piece = 0; piece < PIECES; piece++)
      for (let side = 0; side < n; side++) {
         const a = first + 2 * (n * piece + side), b = a + 2 * n;
         triangles.push(a, a + 1, b + 1, a, b + 1, b);
      }
   const end = first + 2 * n * (PIECES + 1);
   for (const side of [0, 1]) if (isFree[side]) for (const corner of caps) triangles.push(end + side * n + corner);
   return end + 2 * n;
}

function pairs(values) {
   return Array.from({ length: values.length / 2 }, (_, k) => [values[2 * k], values[2 * k + 1]]);
}
