// SPDX-License-Identifier: LGPL-3.0-or-later
// What the report uses of three.js; bundle makes three.min.js of it.
export {
  BufferAttribute, BufferGeometry, DataTexture, DoubleSide, LineSegments, Matrix4, Mesh, OrthographicCamera, Points, Quaternion, REVISION,
  Scene, ShaderMaterial, Vector3, WebGLRenderer,
} from "three";
export { TrackballControls } from "three/examples/jsm/controls/TrackballControls.js";
