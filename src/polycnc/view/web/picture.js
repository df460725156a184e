// Lines as typed buffers, the machine's bodies and the tool, drawn when something has changed.
import { OrbitControls, THREE } from "nicegui-scene";

const WIDTH = 5; // numbers of a point: x, y, z, feed, kind + 8 * colour (view/lines.py)
const POINTS_AT_FIRST = 4096;
// While the picture moves it has fewer segments where all of them take too long: points within so many pixels of a chord
// are left out, more where that is not enough. It is exact when it has rested for a moment.
const COARSE_PIXELS = 0.75;
const LONGEST_FRAME_MS = 40;
const REST_MS = 250;
// Nobody knows yet how long a segment takes: so many are drawn without asking.
const SURELY_FAST = 50000, SURELY_FEW = 10000;
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

// A line with fewer points: numbers of points of a buffer, none of which is left out farther than twice a tolerance from
// the chord that takes its place. Grows with the buffer.
class Coarse {
  constructor(tolerance) {
    this.tolerance = tolerance;
    this.index = new Uint32Array(1024);
    this.count = 0; // numbers that are there
    this.end = 0; // points that have been looked at
  }

  // Number of a point; the last one takes the place of the one before, where the chord goes on.
  put(point, goesOn) {
    if (goesOn) this.count -= 1;
    if (this.count === this.index.length) {
      const more = new Uint32Array(2 * this.count);
      more.set(this.index);
      this.index = more;
    }
    this.index[this.count++] = point;
  }

  // Look at the points that have come: a chord goes on while they lie along the ray that it began with, of one kind.
  grow(points, end) {
    const limit = this.tolerance * this.tolerance;
    let { ax, ay, az, dx, dy, dz, far, what, open } = this.chord || { open: false };
    for (let i = this.end; i < end; i++) {
      const at = i * WIDTH, x = points[at], y = points[at + 1], z = points[at + 2], kind = points[at + 4];
      const vx = x - ax, vy = y - ay, vz = z - az, square = vx * vx + vy * vy + vz * vz;
      let goesOn = open && kind === what && this.count > 1;
      if (goesOn && far > 0) {
        const along = vx * dx + vy * dy + vz * dz;
        goesOn = along >= far && square - along * along <= limit;
        if (goesOn) far = along;
      }
      if (!goesOn) {
        // A chord begins at the point before.
        const from = (i > 0 ? i - 1 : 0) * WIDTH;
        ax = points[from]; ay = points[from + 1]; az = points[from + 2];
        what = kind; far = 0; open = true;
      }
      if (far === 0) {
        const ux = x - ax, uy = y - ay, uz = z - az, length = Math.sqrt(ux * ux + uy * uy + uz * uz);
        if (length * length > limit) { dx = ux / length; dy = uy / length; dz = uz / length; far = length; }
      }
      this.put(i, goesOn);
    }
    this.end = end;
    this.chord = { ax, ay, az, dx, dy, dz, far, what, open };
  }
}

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
    this.rough = new THREE.Line(new THREE.BufferGeometry(), this.material);
    this.rough.frustumCulled = this.rough.visible = false;
    this.coarse = null;
    this.hold(POINTS_AT_FIRST);
  }

  // Show all segments, or those of a coarser line; gives how many.
  show(tolerance) {
    this.mesh.visible = !tolerance;
    this.rough.visible = !!tolerance;
    if (!tolerance) return this.count;
    const known = this.coarse, fits = known && tolerance <= 2 * known.tolerance && known.tolerance <= 2 * tolerance;
    if (!fits) this.coarse = new Coarse(tolerance);
    if (this.coarse.end < this.count) {
      this.coarse.grow(this.buffer.array, this.count);
      const { index, count } = this.coarse;
      this.rough.geometry.dispose();
      this.rough.geometry = this.geometry();
      this.rough.geometry.setIndex(new THREE.BufferAttribute(index.slice(0, count), 1));
    }
    return this.coarse.count;
  }

  geometry() {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.InterleavedBufferAttribute(this.buffer, 3, 0));
    geometry.setAttribute("feed", new THREE.InterleavedBufferAttribute(this.buffer, 1, 3));
    geometry.setAttribute("what", new THREE.InterleavedBufferAttribute(this.buffer, 1, 4));
    return geometry;
  }

  // Room for so many points; what is there stays.
  hold(points) {
    const numbers = new Float32Array(points * WIDTH);
    if (this.buffer) numbers.set(this.buffer.array.subarray(0, this.count * WIDTH));
    this.mesh.geometry.dispose();
    this.buffer = new THREE.InterleavedBuffer(numbers, WIDTH);
    this.buffer.setUsage(THREE.DynamicDrawUsage);
    this.mesh.geometry = this.geometry();
    this.mesh.geometry.setDrawRange(0, this.count);
    this.coarse = null;
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
          this.coarse = null;
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
    this.controls.addEventListener("change", () => { this.dirty = true; this.moved = performance.now(); });
    this.moved = -Infinity;
    this.cost = 0; // ms that a segment takes; 0 for unknown
    this.wider = 1; // how much coarser than by pixels
    this.held = {};
    for (const [name, address] of Object.entries(this.lines)) {
      const line = new Line(address, "#8795a3", name === "path" ? 2 : 0);
      line.mesh.renderOrder = name === "path" ? 0 : 1;
      this.held[name] = line;
      line.rough.renderOrder = line.mesh.renderOrder;
      this.scene.add(line.mesh, line.rough);
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
      line.rough.geometry.dispose();
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
      const lathe = { space: [0.8, 1.6, 0.5], top: [0, 1, 0], front: [0, 1, 0], side: [0, 0, 1] }[name];
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
      const shift = pose.point.map((value, i) => value - pose.nose[i]);
      for (const part of this.parts) {
        const body = part.userData;
        const [at, direction] = pose.head[body.turns] ||
          [body.at.map((value, i) => value + body.moves[i] * pose.machine[i]), body.direction];
        part.position.set(...at.map((value, i) => value + shift[i]));
        const along = new THREE.Vector3(...direction).normalize();
        part.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), along);
        if (body.turns) {
          const turn = new THREE.Quaternion().setFromAxisAngle(along, ((pose.angles[body.turns] || 0) * Math.PI) / 180);
          part.quaternion.premultiply(turn);
        }
      }
      this.dirty = true;
      this.moved = performance.now();
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
      if (this.isDrawing()) return;
      const moves = performance.now() - this.moved < REST_MS;
      if (!this.dirty && (moves || !this.isRough)) return;
      this.dirty = false;
      this.render(moves);
      const gl = this.renderer.getContext();
      this.fence = { sync: gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0), began: performance.now() };
      gl.flush();
    },
    // Whether the card still draws the last picture; how long a segment has taken where it is done.
    isDrawing() {
      if (!this.fence) return false;
      const gl = this.renderer.getContext(), { sync, began } = this.fence;
      if (gl.getSyncParameter(sync, gl.SYNC_STATUS) !== gl.SIGNALED) return true;
      gl.deleteSync(sync);
      this.fence = null;
      this.learn(performance.now() - began);
      return false;
    },
    // How long a picture of so many segments has taken.
    learn(ms) {
      if (this.segments > SURELY_FEW) this.cost = ms / this.segments;
      if (this.isRough && ms > LONGEST_FRAME_MS && this.segments > SURELY_FEW) this.wider *= 2;
    },
    // Draw: all segments, or fewer while the picture moves and all of them would take too long.
    render(moves) {
      const lines = Object.values(this.held), all = lines.reduce((sum, line) => sum + line.count, 0);
      const isFast = this.cost && !this.isRough ? all * this.cost < LONGEST_FRAME_MS : all < SURELY_FAST;
      this.isRough = moves && !isFast;
      if (!moves) this.wider = Math.max(1, this.wider / 2);
      const pixel = (this.camera.right - this.camera.left) / (this.camera.zoom * Math.max(this.$el.clientWidth, 1));
      const tolerance = this.isRough ? COARSE_PIXELS * this.wider * pixel : 0;
      this.segments = lines.reduce((sum, line) => sum + line.show(tolerance), 0);
      this.renderer.render(this.scene, this.camera);
    },
    // Turn about the picture as fast as it can be drawn (for measurements); gives the pictures in a second, the
    // milliseconds of the page's own thread for one, and its segments. `moves`: as while a hand turns it, else exact.
    async pace(seconds, moves = true) {
      const gl = this.renderer.getContext(), pixel = new Uint8Array(4), axis = new THREE.Vector3(0, 0, 1);
      let pictures = 0, script = 0, begin = Infinity;
      for (let k = -8; k < 0 || performance.now() - begin < 1000 * seconds; k++) {
        if (k === 0) begin = performance.now();
        const start = performance.now();
        this.camera.position.sub(this.controls.target).applyAxisAngle(axis, 0.02).add(this.controls.target);
        this.camera.lookAt(this.controls.target);
        this.render(moves);
        const own = performance.now() - start;
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel); // until the card has drawn it
        this.learn(performance.now() - start);
        if (k >= 0) { pictures += 1; script += own; }
        if (!moves && k < -1) k = -1;
      }
      const rate = (1000 * pictures) / (performance.now() - begin);
      this.dirty = true;
      return { pictures: rate, script: script / pictures, segments: this.segments };
    },
  },
};
