// The particles and the pipe in three dimensions, by three.js: one sphere drawn as many times as there are particles.
//
// An instance is its centre and radius (m) and a share of the colour scale. It is drawn as a square that faces
// the eye; for each of its pixels a shader finds where the line of sight meets the sphere, and with it depth and light: round
// at any size, and two triangles instead of hundreds. The camera looks from -x: flow from left to right, y up, as the paper
// draws.
import * as three from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

import {colourTable, pageColour} from './colours.js';

const vertexShader = `
  attribute vec3 centre;
  attribute float share, size;
  uniform bool cut;
  varying vec3 middle, seen;
  varying float tint, radius;
  void main() {
    radius = size;
    middle = (modelViewMatrix * vec4(centre, 1.0)).xyz;
    tint = share;
    vec3 ahead = normalize(middle);
    vec3 right = normalize(cross(ahead, vec3(0.0, 1.0, 0.0)));
    float away = length(middle);
    float half_width = radius * away * inversesqrt(max(away * away - radius * radius, 1e-12));  // of the cone of sight
    if (cut && centre.x < 0.0) half_width = 0.0;  // the half nearer to the first view
    seen = middle + half_width * (position.x * right + position.y * cross(right, ahead));
    gl_Position = projectionMatrix * vec4(seen, 1.0);
  }`;
const fragmentShader = `
  uniform sampler2D colours;
  uniform mat4 projectionMatrix;
  varying vec3 middle, seen;
  varying float tint, radius;
  void main() {
    vec3 sight = normalize(seen);
    float along = dot(sight, middle);
    float under_root = along * along - dot(middle, middle) + radius * radius;
    if (under_root < 0.0) discard;
    vec3 hit = (along - sqrt(under_root)) * sight;
    vec3 facing = (hit - middle) / radius;
    vec4 clip = projectionMatrix * vec4(hit, 1.0);
    gl_FragDepth = 0.5 * clip.z / clip.w + 0.5;
    float light = 0.45 + 0.55 * max(dot(facing, vec3(-0.305, 0.609, 0.732)), 0.0);
    float rim = smoothstep(0.0, 0.35, -dot(facing, sight));  // a dark outline tells neighbours of one colour apart
    gl_FragColor = vec4(texture2D(colours, vec2(tint * 0.996 + 0.002, 0.5)).rgb * light * mix(0.35, 1.0, rim), 1.0);
  }`;

function colourTexture() {
  const data = new Uint8Array(colourTable().flatMap((rgb) => [...rgb, 255]));
  const texture = new three.DataTexture(data, 256, 1);
  texture.needsUpdate = true;
  return texture;
}

export class Scene {
  constructor(canvas, {radii, pipe}) {
    this.renderer = new three.WebGLRenderer({canvas, antialias: true});
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.scene = new three.Scene();
    this.camera = new three.PerspectiveCamera(20, 2, 0.01, 100);
    this.pipe = pipe;
    this.part = {begin: 0, length: pipe.length};  // what the camera has before it, m
    this.radii = radii;
    const particles = radii.length;

    const geometry = new three.InstancedBufferGeometry().copy(new three.PlaneGeometry(2, 2));
    this.centres = new Float32Array(3 * particles);
    this.shares = new Float32Array(particles);
    geometry.setAttribute('centre', new three.InstancedBufferAttribute(this.centres, 3).setUsage(three.DynamicDrawUsage));
    geometry.setAttribute('share', new three.InstancedBufferAttribute(this.shares, 1).setUsage(three.DynamicDrawUsage));
    geometry.setAttribute('size', new three.InstancedBufferAttribute(radii, 1).setUsage(three.DynamicDrawUsage));
    geometry.instanceCount = particles;
    this.uniforms = {cut: {value: false}, colours: {value: colourTexture()}};
    const spheres = new three.Mesh(geometry, new three.ShaderMaterial({uniforms: this.uniforms, vertexShader, fragmentShader}));
    spheres.frustumCulled = false;
    this.geometry = geometry;
    this.scene.add(spheres);
    this.addPipe(pipe);

    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener('change', () => this.request());
    this.view('side');
  }

  // Rings at the ends and seven between them, two diameters apart where the pipe is long, four lines along: what a glass pipe shows
  // of itself.
  addPipe({diameter, length}) {
    const points = [], radius = diameter / 2, rings = Math.min(Math.max(8, Math.round(length / (2 * diameter))), 400);
    for (let ring = 0; ring <= rings; ++ring)
      for (let k = 0; k < 48; ++k)
        for (const turn of [k, k + 1]) {
          const angle = (turn / 48) * 2 * Math.PI;
          points.push(radius * Math.cos(angle), radius * Math.sin(angle), (ring / rings) * length);
        }
    for (const [x, y] of [[0, -radius], [0, radius], [-radius, 0], [radius, 0]]) points.push(x, y, 0, x, y, length);
    const geometry = new three.BufferGeometry().setAttribute('position', new three.Float32BufferAttribute(points, 3));
    this.lines = new three.LineBasicMaterial({transparent: true, opacity: 0.35});
    this.scene.add(new three.LineSegments(geometry, this.lines));
  }

  view(name) {
    const {diameter} = this.pipe, {begin, length} = this.part;
    const middle = new three.Vector3(0, 0, begin + length / 2);
    const away = new three.Vector3(...{side: [-1, 0, 0], oblique: [-0.9, 0.28, -0.35], end: [0, 0, -1]}[name]).normalize();
    this.controls.target.copy(middle);
    let distance = name === 'end' ? length / 2 + diameter : diameter;
    do {
      distance *= 1.04;
      this.camera.position.copy(away).multiplyScalar(distance).add(middle);
      this.controls.update();
      this.camera.updateMatrixWorld();
    } while (!this.corners().every((corner) => Math.abs(corner.project(this.camera).x) < 0.97 && Math.abs(corner.y) < 0.92));
    this.lastView = name;
    this.request();
  }

  // Has another part of the pipe before it: the camera goes along, as it stands, or is placed anew when the part is longer or shorter.
  look(begin, length) {
    const way = begin - this.part.begin, isAsLong = length === this.part.length;
    this.part = {begin, length};
    if (!isAsLong) return this.view(this.lastView || 'side');
    this.camera.position.z += way;
    this.controls.target.z += way;
    this.controls.update();
    this.request();
  }

  // Of the box around the part of the pipe.
  corners() {
    const {begin, length} = this.part, radius = this.pipe.diameter / 2;
    return [begin, begin + length].flatMap((z) => [-radius, radius].flatMap((y) => [-radius, radius].map((x) => new three.Vector3(x, y, z))));
  }

  // Turns by angles (rad) to the right and upwards, and goes nearer by a factor.
  turn(right, up, nearer = 1) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const place = new three.Spherical().setFromVector3(offset);
    place.theta += right;
    place.phi -= up;
    place.radius /= nearer;
    this.camera.position.setFromSpherical(place.makeSafe()).add(this.controls.target);
    this.lastView = '';
    this.controls.update();
    this.request();
  }

  resize(width, height) {
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (this.lastView) this.view(this.lastView);
    else this.request();
  }

  update() {
    this.geometry.getAttribute('centre').needsUpdate = true;
    this.geometry.getAttribute('share').needsUpdate = true;
    this.geometry.getAttribute('size').needsUpdate = true;
    this.request();
  }

  // However many things have changed, one picture for each that the screen shows.
  request() {
    if (this.requested) return;
    this.requested = true;
    requestAnimationFrame(() => this.draw());
  }

  draw() {
    this.requested = false;
    this.scene.background = new three.Color(pageColour('stage'));
    this.lines.color = new three.Color(pageColour('ink'));
    this.renderer.render(this.scene, this.camera);
  }
}
