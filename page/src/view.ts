// Picture of the robots: camera, renderer and what is drawn.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Arrows } from "./arrows";
import type { PageMesh, PageRobot } from "./generated/page_pb";
import { discard } from "./meshes";
import { Robot, SPACING_M } from "./robots";
import { Surroundings } from "./surroundings";
import type { Timeline } from "./timeline";

const PIXEL_RATIO_MAX = 2;
const PIXEL_RATIO_MIN = 0.75;
/** The same where frames are very slow, as without a GPU. */
const PIXEL_RATIO_LEAST = 0.3;
/** Frames slower than this for a while lower the resolution. */
const SLOW_FRAME_S = 0.028;
/** After several in a row that are slower than this, the picture is plain. */
const VERY_SLOW_FRAME_S = 0.15;
const VERY_SLOW_FRAMES = 3;
/** Frames this quick for so long allow a better picture, a few times: what is too much for a machine stays so. */
const QUICK_FRAME_S = 0.02;
const QUICK_S = 3;
const IMPROVEMENTS_MAX = 2;
/** Farther moves of the robots in one frame are a reset. */
const JUMP_M = 1;
const FOLLOW_S = 0.12;
const HEIGHT_FOLLOW_S = 0.6;
/** Height of a label as part of the picture's. */
const LABEL = 0.022;
const LABEL_CHARS_MAX = 26;

/** Text that always faces the camera, of a size that does not depend on the distance. */
function label(name: string): THREE.Sprite {
  // Runs that are compared differ at either end of their names.
  const half = LABEL_CHARS_MAX / 2;
  const text = name.length > LABEL_CHARS_MAX ? `${name.slice(0, half)}…${name.slice(-half)}` : name;
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d")!;
  const font = "600 44px system-ui, sans-serif";
  context.font = font;
  canvas.width = Math.ceil(context.measureText(text).width) + 48;
  canvas.height = 72;
  Object.assign(context, { font, fillStyle: "rgba(16, 22, 32, 0.78)", textBaseline: "middle" });
  context.roundRect(0, 0, canvas.width, canvas.height, 24);
  context.fill();
  context.fillStyle = "#ffffff";
  context.fillText(text, 24, 38);
  const map = new THREE.CanvasTexture(canvas);
  map.colorSpace = THREE.SRGBColorSpace;
  const look = { map, sizeAttenuation: false, depthTest: false, toneMapped: false };
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial(look));
  sprite.scale.set((LABEL * canvas.width) / canvas.height, LABEL, 1);
  sprite.center.set(0.5, 0);
  sprite.renderOrder = 2;
  return sprite;
}

export class View {
  readonly arrows = new Arrows();
  robots: Robot[] = [];
  following = true;
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.PerspectiveCamera(38, 1, 0.05, 250);
  private readonly controls: OrbitControls;
  private readonly surroundings: Surroundings;
  private readonly middle = new THREE.Vector3(0, 0, 0.8);
  private readonly shift = new THREE.Vector3();
  private readonly still = matchMedia("(prefers-reduced-motion: reduce)").matches;
  private labels: THREE.Sprite[] = [];
  private framed = false;
  private frame_s = 0.016;
  private verySlow = 0;
  private readonly best = Math.min(devicePixelRatio, PIXEL_RATIO_MAX);
  private ratio = this.best;
  /** Pixel ratio, width and height of the buffers. */
  private size = "";
  private quick_s = 0;
  private improvements = 0;
  private covered: [left: number, right: number, top: number, bottom: number] = [0, 0, 0, 0];
  /** Width through height of what panels leave free. */
  private aspect = 1;

  constructor(readonly canvas: HTMLCanvasElement) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, powerPreference: "high-performance" });
    this.renderer.toneMapping = THREE.NeutralToneMapping;
    this.renderer.shadowMap.enabled = this.renderer.localClippingEnabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.surroundings = new Surroundings(this.scene, this.renderer);
    this.scene.add(this.arrows.group);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    [this.controls.minDistance, this.controls.maxDistance] = [0.4, 60];
    this.controls.maxPolarAngle = Math.PI / 2 + 0.1;
    [this.controls.enableDamping, this.controls.dampingFactor] = [!this.still, 0.15];
    this.reset();
    canvas.addEventListener("dblclick", () => this.reset());
  }

  /** Fits the picture to the pixels that are free: the robots stand in their middle, smaller if they are few. */
  cover(...covered: typeof this.covered): void {
    this.covered = covered;
    const [left, right, top, bottom] = covered;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    // Each allocates the buffers anew.
    const size = `${this.ratio} ${width} ${height}`;
    if (size !== this.size) {
      this.renderer.setPixelRatio(this.ratio);
      this.renderer.setSize(width, height, false);
      this.size = size;
    }
    const before = this.aspect;
    const free = Math.max(0.15 * height, height - top - bottom);
    this.aspect = Math.max(0.2 * width, width - left - right) / free;
    // Robots beside each other would be cut off.
    if (this.robots.length > 1 && this.aspect < 0.9 * before) this.framed = false;
    this.camera.aspect = width / height;
    this.camera.zoom = free / height;
    this.camera.setViewOffset(width, height, (right - left) / 2, (bottom - top) / 2, width, height);
  }

  /** Replaces the robots. */
  setRobots(robots: readonly PageRobot[]): void {
    for (const { group, ghost } of this.robots) [group, ghost].forEach(discard);
    this.labels.forEach(discard);
    const middle = (robots.length - 1) / 2;
    this.robots = robots.map((robot, index) => new Robot(robot, (middle - index) * SPACING_M));
    this.labels = robots.length > 1 ? robots.map((robot) => label(robot.name)) : [];
    this.scene.add(...this.robots.flatMap(({ group, ghost }) => [group, ghost]), ...this.labels);
    this.framed = false;
  }

  setGround(ground: PageMesh | undefined): void {
    this.arrows.isFlat = ground === undefined;
    this.surroundings.setGround(ground, this.robots);
  }

  /** Puts the camera where the robots fill about half of the height. */
  reset(): void {
    const height_m = Math.max(0.4, ...this.robots.map((robot) => robot.height_m));
    const width_m = Math.max(0.7 * height_m, SPACING_M * (this.robots.length - 1) + 1);
    const tangent = 2 * Math.tan((this.camera.fov * Math.PI) / 360);
    const distance_m = Math.max(height_m / (0.58 * tangent), width_m / (0.9 * tangent * this.aspect));
    // Several robots stand side by side, so the camera is more in front of them.
    const turn = this.robots.length > 1 ? 0.35 : 0.85;
    this.shift.set(Math.cos(turn), -Math.sin(turn), 0.32).setLength(distance_m);
    this.controls.target.copy(this.middle);
    this.camera.position.copy(this.middle).add(this.shift);
    this.controls.update();
  }

  /** Draws the moment of the timeline, `wall_s` after the one before. */
  draw(timeline: Timeline, wall_s: number): void {
    for (const [index, robot] of this.robots.entries()) {
      const sample = timeline.sample(index);
      if (sample === undefined) continue;
      robot.place(sample);
      this.labels[index]?.position.copy(robot.base).setZ(robot.base.z + robot.top_m + 0.22);
    }
    this.arrows.draw(this.robots, timeline);
    this.follow(wall_s);
    this.controls.update();
    this.stagger();
    this.surroundings.follow(this.middle, this.camera.position, this.robots);
    this.adapt(wall_s);
    this.renderer.render(this.scene, this.camera);
  }

  /** Moves labels so that none is cut off at a side or lies on another. */
  private stagger(): void {
    this.camera.updateMatrixWorld();
    const scale = this.camera.projectionMatrix.elements;
    const placed: { x: number; y: number; half: number }[] = [];
    for (const sprite of this.labels) {
      const { x, y } = this.shift.copy(sprite.position).project(this.camera);
      const [half, high] = [0.5 * sprite.scale.x * scale[0]!, sprite.scale.y * scale[5]!];
      const put = { x: Math.max(half - 1, Math.min(1 - half, x)), y, half };
      const near = placed.filter((other) => Math.abs(other.x - put.x) < other.half + half);
      for (const other of near.sort((a, b) => a.y - b.y)) {
        if (Math.abs(other.y - put.y) < high) put.y = other.y + 1.1 * high;
      }
      placed.push(put);
      sprite.center.set(0.5 - (put.x - x) / (2 * half), (y - put.y) / high);
    }
  }

  private follow(wall_s: number): void {
    const shown = this.robots.filter((robot) => robot.group.visible);
    if (shown.length === 0) return;
    this.middle.set(0, 0, 0);
    for (const robot of shown) this.middle.addScaledVector(robot.base, 1 / shown.length);
    if (!this.framed) this.reset();
    this.framed = true;
    if (!this.following) return;
    this.shift.subVectors(this.middle, this.controls.target);
    const jumps = this.still || Math.hypot(this.shift.x, this.shift.y) > JUMP_M;
    const share = (span_s: number) => (jumps ? 1 : 1 - Math.exp(-wall_s / span_s));
    this.shift.x *= share(FOLLOW_S);
    this.shift.y *= share(FOLLOW_S);
    this.shift.z *= share(HEIGHT_FOLLOW_S);
    this.controls.target.add(this.shift);
    this.camera.position.add(this.shift);
  }

  /** Lowers the resolution where frames take too long, and draws plainly where they are very slow. */
  private adapt(wall_s: number): void {
    this.verySlow = wall_s > VERY_SLOW_FRAME_S ? this.verySlow + 1 : 0;
    if (this.verySlow >= VERY_SLOW_FRAMES) {
      this.surroundings.simplify(true);
      this.lower(PIXEL_RATIO_LEAST, 0.5);
    }
    if (wall_s > 1) return;
    // A pause, as while shaders are compiled, must not leave a poor picture for ever.
    this.quick_s = wall_s < QUICK_FRAME_S ? this.quick_s + wall_s : 0;
    if (this.quick_s > QUICK_S && this.ratio < this.best && this.improvements < IMPROVEMENTS_MAX) {
      [this.quick_s, this.ratio] = [0, this.best];
      this.improvements += 1;
      this.surroundings.simplify(false);
      this.cover(...this.covered);
    }
    this.frame_s += 0.03 * (wall_s - this.frame_s);
    if (this.frame_s > SLOW_FRAME_S) this.lower(PIXEL_RATIO_MIN, 0.75);
  }

  private lower(least: number, share: number): void {
    [this.frame_s, this.verySlow] = [0.016, 0];
    if (this.ratio <= least) return;
    this.ratio = Math.max(least, share * this.ratio);
    this.cover(...this.covered);
  }

  /** Returns the picture of this moment as PNG. */
  picture(timeline: Timeline): Promise<Blob | null> {
    // The buffer is valid only until the browser shows it, so it is drawn and read at once.
    const { ratio } = this;
    this.ratio = this.best;
    this.cover(...this.covered);
    this.draw(timeline, 0);
    const picture = new Promise<Blob | null>((resolve) => this.canvas.toBlob(resolve, "image/png"));
    this.ratio = ratio;
    this.cover(...this.covered);
    return picture;
  }
}
