// Lines as typed buffers, the machine's bodies and the tool, drawn when something has changed.
import { OrbitControls, THREE } from "nicegui-scene";

const WIDTH = 5; // numbers of a point: x, y, z, feed, kind + 8 * colour (view/lines.py)
const POINTS_AT_FIRST = 4096;
// Okabe and Ito's colours, as on paper (toolpath/plot.py), but light enough for a dark ground.
const COLOURS = ["#4ba3e3", "#e8803a", "#2fc492", "#e39bc2", "#f0b429", "#8fd0f5", "#c98a4a", "#dddddd"];

const VERTEX = `
in vec3 position; in float feed; in float what;
uniform mat4 projectionMatrix, modelViewMatrix;
uniform vec3 colours[8]; uniform vec3 pale; uniform float largest; uniform int mode;
flat out vec4 colour;
vec3 heat(float share) {
  return clamp(vec3(1.5) - abs(vec3(4.0 * share) - vec3(3.0, 2.0, 1.0)), 0.0, 1.0) * 0.75 + 0.25;
}
void main() {
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  float kind = mod(what, 8.0);
  vec3 own = mode == 2 ? pale : mode == 1 ? heat(feed / max(largest, 1.0)) : colours[int(mod(floor(what / 8.0), 8.0))];
  if (kind < 0.5 && mode != 2) own = pale;
  colour = vec4(own, kind > 1.5 ? 0.0 : 1.0);
}`;
const FRAGMENT = `
precision mediump float;
flat in vec4 colour; out vec4 shown;
void main() { if (colour.a < 0.5) discard; shown = vec4(colour.rgb, 1.0); }`;

// A colour as it is written: the shader puts it out as it is.
const plain = (name) => new THREE.Color().setStyle(name, THREE.LinearSRGBColorSpace);

// The colour of a tool by its number; a program may name one itself.
const colourOf = (tools, i) => (/^#[0-9a-f]{6}$/.test(tools[i] || "") ? tools[i] : COLOURS[i % COLOURS.length]);

class Line {
  constructor(address, pale, mode) {
    this.address = address;
    this.era = -1;
    this.count = 0;
    this.busy = false;
    this.box = new THREE.Box3();
    this.material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: {
        colours: { value: COLOURS.map(plain) },
        pale: { value: plain(pale) },
        largest: { value: 1 },
        mode: { value: mode },
      },
    });
    this.mesh = new THREE.Line(new THREE.BufferGeometry(), this.material);
    this.mesh.frustumCulled = false;
    this.hold(POINTS_AT_FIRST);
  }

  // Room for so many points; what is there stays.
  hold(points) {
    const numbers = new Float32Array(points * WIDTH);
    if (this.buffer) numbers.set(this.buffer.array.subarray(0, this.count * WIDTH));
    this.mesh.geometry.dispose();
    this.buffer = new THREE.InterleavedBuffer(numbers, WIDTH);
    this.buffer.setUsage(THREE.DynamicDrawUsage);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.InterleavedBufferAttribute(this.buffer, 3, 0));
    geometry.setAttribute("feed", new THREE.InterleavedBufferAttribute(this.buffer, 1, 3));
    geometry.setAttribute("what", new THREE.InterleavedBufferAttribute(this.buffer, 1, 4));
    geometry.setDrawRange(0, this.count);
    this.mesh.geometry = geometry;
  }

  add(first, points) {
    const end = first + points.length / WIDTH;
    if (end * WIDTH > this.buffer.array.length) this.hold(Math.max(end, (2 * this.buffer.array.length) / WIDTH));
    this.buffer.array.set(points, first * WIDTH);
    this.buffer.addUpdateRange(first * WIDTH, points.length);
    this.buffer.needsUpdate = true;
    this.count = end;
    this.mesh.geometry.setDrawRange(0, end);
    const largest = this.material.uniforms.largest;
    const { min, max } = this.box;
    for (let i = 0; i < points.length; i += WIDTH) {
      const x = points[i], y = points[i + 1], z = points[i + 2];
      if (x < min.x) min.x = x; if (x > max.x) max.x = x;
      if (y < min.y) min.y = y; if (y > max.y) max.y = y;
      if (z < min.z) min.z = z; if (z > max.z) max.z = z;
      if (points[i + 3] > largest.value) largest.value = points[i + 3];
    }
  }

  // Fetch what has come since; true where something was new.
  async follow(era, count) {
    if (this.busy || (era === this.era && count === this.count)) return false;
    this.busy = true;
    try {
      let told;
      do {
        const answer = await fetch(`${this.address}?era=${this.era}&first=${this.count}`);
        if (!answer.ok) return false;
        told = JSON.parse(answer.headers.get("X-Line"));
        const points = new Float32Array(await answer.arrayBuffer());
        if (told.era !== this.era || told.first === 0) {
          this.era = told.era;
          this.count = 0;
          this.box.makeEmpty();
          this.material.uniforms.largest.value = 1;
        }
        this.tools = told.tools;
        this.material.uniforms.colours.value = COLOURS.map((_, i) => plain(colourOf(told.tools, i)));
        this.add(told.first, points);
        if (points.length === 0) break;
      } while (this.count < told.count);
      return true;
    } finally {
      this.busy = false;
    }
  }
}

export default {
  template: `
    <div class="picture" :data-points="points">
      <canvas role="img" :aria-label="words.name"></canvas>
      <p v-if="!works">{{ words["no-webgl"] }}</p>
      <div class="picture-keys">
        <button v-for="name in names" :key="name" type="button" class="k" @click="press(name)"
          :class="{ chosen: isChosen(name) }" :aria-pressed="isChosen(name)">{{ words[name] }}</button>
        <span class="picture-tools"><span v-for="(tool, i) in tools" :style="{ color: colourOf(i) }">{{ tool }}</span></span>
      </div>
    </div>`,
  props: { lines: Object, bodies: Array, lathe: Boolean, words: Object, over: String },
  data() {
    return { names: ["tool", "feed", "machine", "space", "top", "front", "side", "fit"], by: "tool", hasMachine: true,
      works: true, tools: [], points: 0 };
  },
  mounted() {
    THREE.Object3D.DEFAULT_UP.set(0, 0, 1);
    const canvas = this.$el.querySelector("canvas");
    try {
      this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
    } catch {
      this.works = false;
      return;
    }
    this.scene = new THREE.Scene();
    this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -1e5, 1e5);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => (this.dirty = true));
    this.held = {};
    for (const [name, address] of Object.entries(this.lines)) {
      const line = new Line(address, "#8795a3", name === "path" ? 2 : 0);
      line.mesh.renderOrder = name === "path" ? 0 : 1;
      this.held[name] = line;
      this.scene.add(line.mesh);
    }
    this.scene.add(new THREE.AmbientLight("#ffffff", 1.6), new THREE.AxesHelper(20));
    const light = new THREE.DirectionalLight("#ffffff", 1.8);
    light.position.set(1, -2, 3);
    this.scene.add(light);
    this.machine = new THREE.Group();
    this.scene.add(this.machine);
    this.parts = this.bodies.map((body) => this.partOf(body));
    this.tool = this.toolShape();
    this.scene.add(this.tool);
    this.look("space");
    this.box = new THREE.Box3();
    this.dirty = true;
    this.frame = requestAnimationFrame(() => this.draw());
  },
  beforeUnmount() {
    cancelAnimationFrame(this.frame);
    for (const line of Object.values(this.held || {})) {
      line.mesh.geometry.dispose();
      line.material.dispose();
    }
    this.renderer?.dispose();
  },
  methods: {
    colourOf(i) { return colourOf(this.tools, i); },
    isChosen(name) { return name === this.by || (name === "machine" && this.hasMachine); },
    press(name) {
      if (name === "tool" || name === "feed") {
        this.by = name;
        if (this.held?.trail) this.held.trail.material.uniforms.mode.value = name === "feed" ? 1 : 0;
      } else if (name === "machine") {
        this.hasMachine = this.machine.visible = !this.hasMachine;
      } else {
        if (name !== "fit") this.look(name);
        this.fit();
      }
      this.dirty = true;
    },
    partOf(body) {
      const geometry = body.shape === "box" ? new THREE.BoxGeometry(...body.size)
        : new THREE.CylinderGeometry(body.size[0] / 2, body.size[0] / 2, body.size[1], 6).rotateX(Math.PI / 2);
      const colour = { rail: "#5b6b7c", carriage: "#9fb3c8", disc: "#b08d57" }[body.role] || "#8a97a5";
      const mesh = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ color: colour, transparent: true, opacity: 0.45 }));
      mesh.userData = body;
      this.machine.add(mesh);
      return mesh;
    },
    // A tool whose tip is the zero and which leads upwards: cutter and shank.
    toolShape() {
      const group = new THREE.Group();
      const tip = new THREE.Mesh(new THREE.ConeGeometry(3, 12, 16), new THREE.MeshLambertMaterial({ color: "#ffd75e" }));
      tip.geometry.rotateX(-Math.PI / 2).translate(0, 0, 6);
      const shank = new THREE.Mesh(new THREE.CylinderGeometry(3, 3, 18, 16), new THREE.MeshLambertMaterial({ color: "#c9d3dd" }));
      shank.geometry.rotateX(Math.PI / 2).translate(0, 0, 21);
      group.add(tip, shank);
      return group;
    },
    look(name) {
      const from = { space: [1, -1.6, 1.1], top: [0, 0, 1], front: [0, -1, 0], side: [1, 0, 0] }[name];
      // A lathe is looked at as its drawing lies: Z to the right, X up.
      const lathe = { space: [0.5, -1.6, 0.8], top: [0, -1, 0], front: [0, -1, 0], side: [0, 0, 1] }[name];
      const up = this.lathe ? [1, 0, 0] : name === "top" ? [0, 1, 0] : [0, 0, 1];
      this.camera.up.set(...up);
      this.controls.target.set(0, 0, 0);
      this.camera.position.set(...(this.lathe ? lathe : from)).multiplyScalar(1000);
      this.controls.update();
    },
    fit() {
      const box = new THREE.Box3();
      for (const line of Object.values(this.held)) box.union(line.box);
      if (box.isEmpty()) box.setFromCenterAndSize(this.tool.position, new THREE.Vector3(100, 100, 100));
      const size = Math.max(box.getSize(new THREE.Vector3()).length(), 1), middle = box.getCenter(new THREE.Vector3());
      const way = middle.clone().sub(this.controls.target);
      this.controls.target.copy(middle);
      this.camera.position.add(way);
      this.camera.zoom = 1;
      this.extent = size * 0.62;
      this.tool.scale.setScalar(Math.max(size / 250, 0.02));
      this.shape();
      this.controls.update();
      this.dirty = true;
    },
    // The camera has the shape of the canvas.
    shape() {
      const { clientWidth: w, clientHeight: h } = this.$el;
      if (!w || !h) return;
      const half = this.extent || 100, ratio = w / h;
      Object.assign(this.camera, { left: -half * ratio, right: half * ratio, top: half, bottom: -half });
      if (ratio < 1) Object.assign(this.camera, { left: -half, right: half, top: half / ratio, bottom: -half / ratio });
      this.camera.updateProjectionMatrix();
    },
    place() {
      if (!this.over) return;
      const found = document.querySelector(this.over);
      this.$el.style.display = found ? "" : "none";
      if (!found) return;
      const at = found.getBoundingClientRect();
      const wanted = [at.left, at.top, at.width, at.height].map(Math.round).join();
      if (wanted === this.at) return;
      this.at = wanted;
      Object.assign(this.$el.style, { position: "fixed", left: `${at.left}px`, top: `${at.top}px`,
        width: `${at.width}px`, height: `${at.height}px` });
    },
    async show(pose, counts) {
      if (!this.works || !this.held) return;
      this.tool.position.set(...pose.point);
      this.tool.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), new THREE.Vector3(...pose.along).normalize());
      const shift = pose.point.map((value, i) => value - pose.machine[i]);
      for (const part of this.parts) {
        const body = part.userData;
        part.position.set(...body.at.map((value, i) => value + shift[i] + body.moves[i] * pose.machine[i]));
        const along = new THREE.Vector3(...body.direction).normalize();
        part.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), along);
        if (body.turns) {
          const turn = new THREE.Quaternion().setFromAxisAngle(along, ((pose.angles[body.turns] || 0) * Math.PI) / 180);
          part.quaternion.premultiply(turn);
        }
      }
      this.dirty = true;
      const before = Object.values(this.held).reduce((sum, line) => sum + line.count, 0);
      const has = await Promise.all(Object.entries(counts).map(([name, [era, count]]) => this.held[name]?.follow(era, count)));
      if (!has.some(Boolean)) return;
      this.points = Object.values(this.held).reduce((sum, line) => sum + line.count, 0);
      this.tools = this.held.trail?.tools?.length ? this.held.trail.tools : this.held.path?.tools || [];
      if (before < 2 || this.outgrown()) this.fit();
      this.dirty = true;
    },
    // What has come since the picture was fitted is not in sight any more.
    outgrown() {
      const box = new THREE.Box3();
      for (const line of Object.values(this.held)) box.union(line.box);
      return !box.isEmpty() && box.getSize(new THREE.Vector3()).length() * 0.62 > (this.extent || 0) * 1.2;
    },
    draw() {
      this.frame = requestAnimationFrame(() => this.draw());
      this.place();
      const { clientWidth: w, clientHeight: h } = this.$el;
      if (!w || !h) return;
      if (this.width !== w || this.height !== h) {
        this.width = w; this.height = h;
        this.renderer.setPixelRatio(window.devicePixelRatio);
        this.renderer.setSize(w, h, false);
        this.shape();
        this.dirty = true;
      }
      if (!this.dirty) return;
      this.dirty = false;
      this.renderer.render(this.scene, this.camera);
    },
    // Turn about the picture as fast as it can be drawn; gives the pictures in a second (for measurements).
    async pace(seconds) {
      const gl = this.renderer.getContext(), pixel = new Uint8Array(4), begin = performance.now();
      let pictures = 0;
      while (performance.now() - begin < 1000 * seconds) {
        this.camera.position.sub(this.controls.target).applyAxisAngle(new THREE.Vector3(0, 0, 1), 0.02).add(this.controls.target);
        this.camera.lookAt(this.controls.target);
        this.renderer.render(this.scene, this.camera);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel); // until the card has drawn it
        pictures += 1;
      }
      return (1000 * pictures) / (performance.now() - begin);
    },
  },
};
