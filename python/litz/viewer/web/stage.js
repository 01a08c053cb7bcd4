/** Camera and mouse: rotates, pans and zooms the view, and reports mouse clicks. */

import { OrthographicCamera, Scene, TrackballControls, Vector3, WebGLRenderer } from "three";

// Height covered by the colour bar and the buttons [pixels]
const OVERLAY_HEIGHT = 150;

/** A parallel projection of a scene into an element of the page. */
export class Stage {
   /** radius: of a sphere around the origin that contains the model [m]; home: directions of the initial view. */
   constructor(element, radius, home) {
      this.element = element;
      this.radius = radius;
      this.home = home;
      this.scene = new Scene();
      this.renderer = new WebGLRenderer({ antialias: true });
      this.renderer.setPixelRatio(window.devicePixelRatio);
      this.renderer.setClearColor("#ffffff");
      element.append(this.renderer.domElement);
      this.camera = new OrthographicCamera(-1, 1, 1, -1, 0, 20 * radius);
      this.controls = new TrackballControls(this.camera, this.renderer.domElement);
      Object.assign(this.controls, { rotateSpeed: 4, staticMoving: true });
      this.listeners = [];
      this.controls.addEventListener("change", () => this.draw());
      new ResizeObserver(() => this.resize()).observe(element);
      this.look(home.toward, home.up);
      this.resize();
      const animate = () => {
         this.controls.update();
         requestAnimationFrame(animate);
      };
      animate();
   }

   /** Look from a direction, with the whole model in view. */
   look(toward, up) {
      this.controls.target.set(0, 0, 0);
      this.camera.position.copy(new Vector3(...toward).normalize().multiplyScalar(10 * this.radius));
      this.camera.up.set(...up);
      this.camera.zoom = 1;
      this.camera.lookAt(0, 0, 0);
      this.resize();
   }

   resize() {
      const { clientWidth: width, clientHeight: height } = this.element;
      if (!width || !height) return;
      this.renderer.setSize(width, height);
      const [halfWidth, halfHeight] = this.home.half;
      const scale = Math.max(halfWidth / width, halfHeight / Math.max(height - OVERLAY_HEIGHT, height / 2));
      // the model is shifted up, so that the colour bar does not cover it
      const shift = scale * OVERLAY_HEIGHT / 3;
      Object.assign(this.camera, {
         left: -scale * width, right: scale * width, top: scale * height - shift, bottom: -scale * height - shift,
      });
      this.camera.updateProjectionMatrix();
      this.controls.handleResize();
      this.draw();
   }

   /** Unit vector to the viewer. */
   get toward() {
      return this.camera.position.clone().sub(this.controls.target).normalize();
   }

   /** What is seen in depth [m]. */
   get depth() {
      return this.camera.far - this.camera.near;
   }

   get pixelsPerMetre() {
      return (this.element.clientWidth * this.camera.zoom) / (this.camera.right - this.camera.left);
   }

   /** Screen position of a point, in pixels from the upper left corner. */
   project(point) {
      const projected = point.clone().project(this.camera);
      return [((1 + projected.x) / 2) * this.element.clientWidth, ((1 - projected.y) / 2) * this.element.clientHeight];
   }

   /** What gives the screen position of a point (a, b, c), in pixels from the left and from above: [p, q, r, s] for p a + q b + r c + s. */
   projection() {
      const at = (a, b, c) => this.project(new Vector3(a, b, c));
      const origin = at(0, 0, 0), unit = this.radius;
      const ends = [at(unit, 0, 0), at(0, unit, 0), at(0, 0, unit)];
      return [0, 1].map((side) => [...ends.map((end) => (end[side] - origin[side]) / unit), origin[side]]);
   }

   /** Components of a direction to the right and upwards on the screen. */
   direction(vector) {
      const rotated = vector.clone().applyQuaternion(this.camera.quaternion.clone().invert());
      return [rotated.x, rotated.y];
   }

   /** Call a function before each frame is drawn. */
   beforeDraw(listener) {
      this.listeners.push(listener);
   }

   /** Call a function with the position of each click that does not end a drag. */
   onClick(listener) {
      const canvas = this.renderer.domElement;
      let down = null;
      canvas.addEventListener("pointerdown", (event) => { down = [event.clientX, event.clientY]; });
      canvas.addEventListener("pointerup", (event) => {
         if (!down || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4) return;
         const box = canvas.getBoundingClientRect();
         listener(event.clientX - box.left, event.clientY - box.top);
      });
   }

   draw() {
      this.camera.updateMatrixWorld();
      for (const listener of this.listeners) listener();
      this.renderer.render(this.scene, this.camera);
   }
}
