// The parts of three.js that the viewer uses. After a change: npm ci && npm run build
export {
   BufferAttribute, BufferGeometry, Color, DataTexture, DoubleSide, InstancedBufferAttribute, InstancedBufferGeometry,
   LineBasicMaterial, LineSegments, LinearFilter, Mesh, OrthographicCamera, RGBAFormat, Scene, ShaderMaterial,
   SphereGeometry, Vector3, WebGLRenderer,
} from "three";
export { TrackballControls } from "three/addons/controls/TrackballControls.js";
