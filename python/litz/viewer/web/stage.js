/** Camera, light and mouse: what turns, moves and enlarges the model, and tells where the mouse has clicked. */

import { OrthographicCamera, Scene, TrackballControls, Vector3, WebGLRenderer } from "three";

// Pixels that the colour bar and the buttons take from the height
const TAKEN = 150;

/** A parallel projection of a scene into an element of the page. */
export class Stage {
   /** radius: of a ball around the origin that holds the model [m]; home: directions of the first view. */
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
      const turn = () => {
         this.controls.update();
         requestAnimationFrame(turn);
      };
      turn();
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
      const scale = Math.max(halfWidth / width, halfHeight / Math.max(height - TAKEN, height / 2));
      // the model is a little above the middle, where the colour bar does not cover it
      const shift = scale * TAKEN / 3;
      Object.assign(this.camera, {
         left: -scale * width, right: scale * width, top: scale * height - shift, bottom: -scale * height - shift,
      });
      this.camera.updateProjectionMatrix();
      this.controls.handleResize();
      this.draw();
   }

   get pixelsPerMetre() {
      return (this.element.clientWidth * this.camera.zoom) / (this.camera.right - this.camera.left);
   }

   /** Where a point is seen, in pixels from the upper left corner. */
   project(point) {
      const seen = point.clone().project(this.camera);
      return [((1 + seen.x) / 2) * this.element.clientWidth, ((1 - seen.y) / 2) * this.element.clientHeight];
   }

   /** Components of a direction to the right and upwards on the screen. */
   direction(vector) {
      const seen = vector.clone().applyQuaternion(this.camera.quaternion.clone().invert());
      return [seen.x, seen.y];
   }

   /** Call a function before each drawing. */
   beforeDrawing(listener) {
      this.listeners.push(listener);
   }

   /** Call a function with the place of each click that is not the end of a drag. */
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
