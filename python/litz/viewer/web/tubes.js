/** Wires as tubes: each element is an instance whose Hermite axis is computed by the graphics processor. */

import {
   BufferAttribute, BufferGeometry, DataTexture, InstancedBufferAttribute, InstancedBufferGeometry, LineBasicMaterial,
   LineSegments, LinearFilter, Mesh, RGBAFormat, ShaderMaterial, DoubleSide,
} from "three";

const VERTEX = `
   attribute float xi;
   attribute float angle;
   attribute float ring;    // distance from the axis, and beyond the end along it, in radii: on the half spheres
   attribute float beyond;  // at the ends, ring^2 + beyond^2 = 1
   attribute vec3 p0;
   attribute vec3 p1;
   attribute vec3 m0;
   attribute vec3 m1;
   attribute vec2 ends;
   attribute float radius;
   uniform float minRadius;
   uniform float before;
   varying vec3 viewNormal;
   varying float value;

   void main() {
      float xi2 = xi * xi, xi3 = xi2 * xi;
      vec3 axis = ((2. - 3. * xi + xi3) * p0 + (2. + 3. * xi - xi3) * p1
         + (1. - xi - xi2 + xi3) * m0 + (-1. - xi + xi2 + xi3) * m1) / 4.;
      vec3 along = normalize(3. * (1. - xi2) * (p1 - p0) + (-1. - 2. * xi + 3. * xi2) * m0
         + (-1. + 2. * xi + 3. * xi2) * m1);
      vec3 size = abs(p1 - p0);
      vec3 aside = size.x <= size.y && size.x <= size.z ? vec3(1., 0., 0.)
         : size.y <= size.z ? vec3(0., 1., 0.) : vec3(0., 0., 1.);
      vec3 first = normalize(cross(along, aside));
      vec3 outward = cos(angle) * first + sin(angle) * cross(along, first);
      vec3 normal = ring * outward + beyond * along;
      vec3 place = axis + max(radius, minRadius) * normal;
      viewNormal = normalMatrix * normal;
      value = mix(ends.x, ends.y, (1. + xi) / 2.);
      gl_Position = projectionMatrix * modelViewMatrix * vec4(place, 1.);
      gl_Position.z -= 2. * before * gl_Position.w;
      // outside of what is seen
      if (radius < 0.) gl_Position = vec4(2., 2., 2., 1.);
   }`;

/** Stands for no value: graphics processors need not know what is not a number. */
const NO_VALUE = 1e30;

/** Values for the graphics processor. */
export function shownValues(values) {
   return values.map((value) => Number.isNaN(value) ? NO_VALUE : value);
}

export const FRAGMENT = `
   uniform sampler2D colours;
   uniform vec2 limits;
   varying vec3 viewNormal;
   varying float value;

   void main() {
      vec3 normal = normalize(viewNormal);
      if (!gl_FrontFacing) normal = -normal;
      float part = clamp((value - limits.x) / (limits.y - limits.x), 0., 1.);
      vec3 colour = texture2D(colours, vec2((255. * part + 0.5) / 256., 0.5)).rgb;
      // wires without a value, between the ends of an element, too
      if (value > 1e20) colour = vec3(0.77);
      vec3 left = normalize(vec3(-0.6, 0.7, 1.)), right = normalize(vec3(0.9, -0.1, 1.));
      float light = 0.3 + 0.65 * max(dot(normal, left), 0.) + 0.25 * max(dot(normal, right), 0.);
      float gloss = 0.2 * pow(max(dot(normal, normalize(left + vec3(0., 0., 1.))), 0.), 30.);
      gl_FragColor = vec4(light * colour + gloss, 1.);
   }`;

/** The tubes of a model. */
export class Tubes {
   /** rest: the undeformed curves, twelve floats per element; radii: one float per element, less than 0: it is not drawn; before: how much nearer to the viewer they are drawn, as a share of what is seen in depth. */
   constructor(rest, radii, before = 0) {
      this.rest = rest;
      const n = radii.length;
      this.curves = new Float32Array(rest);
      const geometry = new InstancedBufferGeometry();
      const [sides, segments] = n > 100000 ? [6, 1] : n > 20000 ? [8, 3] : n > 3000 ? [12, 6] : [24, 16];
      addTube(geometry, sides, segments);
      this.shape = ["p0", "p1", "m0", "m1"].map((name) => {
         const attribute = new InstancedBufferAttribute(new Float32Array(3 * n), 3);
         geometry.setAttribute(name, attribute);
         return attribute;
      });
      this.ends = new InstancedBufferAttribute(new Float32Array(2 * n), 2);
      geometry.setAttribute("ends", this.ends);
      this.radii = new InstancedBufferAttribute(radii, 1);
      geometry.setAttribute("radius", this.radii);
      geometry.instanceCount = n;
      this.material = new ShaderMaterial({
         vertexShader: VERTEX, fragmentShader: FRAGMENT, side: DoubleSide,
         uniforms: { colours: { value: null }, limits: { value: [0, 1] }, minRadius: { value: 0 },
            before: { value: before } },
      });
      this.mesh = new Mesh(geometry, this.material);
      this.mesh.frustumCulled = false;
   }

   /** Set the deformed curves, with a scale factor for the deformation. */
   setShape(now, factor) {
      const { rest, curves } = this;
      for (let k = 0; k < rest.length; k++) curves[k] = rest[k] + factor * (now[k] - rest[k]);
      this.shape.forEach((attribute, part) => {
         for (let row = 0; row < attribute.count; row++)
            for (let k = 0; k < 3; k++) attribute.array[3 * row + k] = curves[12 * row + 3 * part + k];
         attribute.needsUpdate = true;
      });
   }

   setValues(ends) {
      this.ends.array.set(shownValues(ends));
      this.ends.needsUpdate = true;
   }

   setRadii(radii) {
      this.radii.array.set(radii);
      this.radii.needsUpdate = true;
   }

   /** table: 256 colours of four bytes; limits: the values of the first and the last colour. */
   setColours(table, limits) {
      this.material.uniforms.colours.value?.dispose();
      const texture = new DataTexture(table, 256, 1, RGBAFormat);
      texture.minFilter = texture.magFilter = LinearFilter;
      texture.needsUpdate = true;
      this.material.uniforms.colours.value = texture;
      this.material.uniforms.limits.value = limits;
   }

   /** Release what the graphics processor holds of them. */
   dispose() {
      this.mesh.geometry.dispose();
      this.material.uniforms.colours.value?.dispose();
      this.material.dispose();
   }

   /** Set the minimum radius with which wires are drawn. */
   setMinRadius(radius) {
      this.material.uniforms.minRadius.value = radius;
   }
}

/** Vertices and triangles of one tube with half spheres at its ends. */
function addTube(geometry, sides, segments) {
   const steps = Math.ceil(sides / 6), rows = [];
   for (let k = steps; k > 0; k--) rows.push(onSphere(-1, (Math.PI / 2) * (k / steps)));
   for (let k = 0; k <= segments; k++) rows.push([-1 + (2 * k) / segments, 1, 0]);
   for (let k = 1; k <= steps; k++) rows.push(onSphere(1, (Math.PI / 2) * (k / steps)));
   const vertices = rows.flatMap((row) => Array.from({ length: sides }, (_, k) => [...row, (2 * Math.PI * k) / sides]));
   ["xi", "ring", "beyond", "angle"].forEach((name, column) => {
      geometry.setAttribute(name, new BufferAttribute(Float32Array.from(vertices, (vertex) => vertex[column]), 1));
   });
   // three.js requires an attribute of this name, and takes the number of vertices from it
   geometry.setAttribute("position", new BufferAttribute(new Float32Array(3 * vertices.length), 3));
   const triangles = [];
   for (let row = 0; row < rows.length - 1; row++)
      for (let k = 0; k < sides; k++) {
         const a = row * sides + k, b = row * sides + ((k + 1) % sides);
         triangles.push(a, b, a + sides, b, b + sides, a + sides);
      }
   geometry.setIndex(triangles);
}

/** A row of vertices at an end, xi = -1 or 1, at an angle from the section in which the tube ends. */
function onSphere(end, angle) {
   return [end, Math.cos(angle), end * Math.sin(angle)];
}

/** The undeformed axes as thin lines. */
export function referenceLines(rest) {
   const n = rest.length / 12, parts = n > 20000 ? 1 : 8;
   const points = new Float32Array(6 * parts * n);
   for (let start = 0, place = 0; start < rest.length; start += 12)
      for (let k = 0; k < 2 * parts; k++, place += 3) hermite(rest, start, -1 + (2 * ((k + 1) >> 1)) / parts, points, place);
   const geometry = new BufferGeometry();
   geometry.setAttribute("position", new BufferAttribute(points, 3));
   return new LineSegments(geometry, new LineBasicMaterial({ color: "#9a9a9a" }));
}

/** A point of the curve that begins at a place of the curves, into the points at a place. */
function hermite(curves, start, xi, points, place) {
   const xi2 = xi * xi, xi3 = xi2 * xi;
   const a = (2 - 3 * xi + xi3) / 4, b = (2 + 3 * xi - xi3) / 4, c = (1 - xi - xi2 + xi3) / 4, d = (-1 - xi + xi2 + xi3) / 4;
   for (let axis = 0; axis < 3; axis++) points[place + axis] = a * curves[start + axis] + b * curves[start + 3 + axis]
      + c * curves[start + 6 + axis] + d * curves[start + 9 + axis];
}
