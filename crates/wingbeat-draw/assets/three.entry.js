// What the flight page uses of three.js 0.187.0. The bundle beside this file was made from it with
// esbuild three.entry.js --bundle --minify --format=iife --global-name=THREE --legal-comments=inline
export { AmbientLight, ArrowHelper, BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, DynamicDrawUsage, Float32BufferAttribute, GridHelper, Group, Line, LineBasicMaterial, Mesh, MeshBasicMaterial, MeshLambertMaterial, PerspectiveCamera, Scene, Vector3, WebGLRenderer, AxesHelper, LineSegments, Points, PointsMaterial } from 'three';
export { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
