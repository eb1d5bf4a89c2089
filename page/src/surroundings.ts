// Sky, lights and ground around the robots.
import * as THREE from "three";
import { RoomEnvironment } from "three/examples/jsm/environments/RoomEnvironment.js";
import groundShader from "./ground.glsl";
import type { PageMesh } from "./generated/page_pb";
import { discard, joined } from "./meshes";
import type { Robot } from "./robots";

const LIGHT = { zenith: 0x8fbbe8, horizon: 0xe4ebf2, ground: 0xa9b2ba, line: 0x7d8895, hemisphere: 0.8, key: 2.5 };
const DARK = { zenith: 0x0b1220, horizon: 0x1d2735, ground: 0x333c47, line: 0x5b6876, hemisphere: 0.7, key: 2.2 };
const ENVIRONMENT = 0.42;
const GROUND_M = 400;
const DOME_M = 100;
const SHADOW_PIXELS = 2048;

function gridMaterial(line: THREE.Color, centre: THREE.Vector2): THREE.MeshLambertMaterial {
  const material = new THREE.MeshLambertMaterial({ transparent: true });
  material.onBeforeCompile = (shader) => {
    const main = "void main() {";
    Object.assign(shader.uniforms, { line_colour: { value: line }, centre_m: { value: centre } });
    shader.vertexShader = shader.vertexShader.replace(main, `varying vec2 place_m;\n${main} place_m = position.xy;`);
    shader.fragmentShader = shader.fragmentShader
      .replace(main, `${groundShader}\n${main}`)
      .replace("#include <color_fragment>", "diffuseColor = ground(diffuseColor);");
  };
  return material;
}

/** A mesh once for each robot, as each robot is drawn at another place than it has in the world. */
class Terrain {
  readonly group = new THREE.Group();
  readonly below_m: number;
  readonly colour: number;
  private readonly borders: { left: THREE.Plane; right: THREE.Plane }[] = [];

  constructor(ground: PageMesh, robots: readonly Robot[]) {
    const geometry = joined([ground]);
    geometry.computeBoundingBox();
    this.below_m = geometry.boundingBox!.min.z - 0.02;
    this.colour = ground.colour;
    for (const { offset_m } of robots) {
      // Borders of the outermost strips stay infinitely far.
      const border = (y: number) => new THREE.Plane(new THREE.Vector3(0, y, 0), 1e6);
      const [left, right] = [border(-1), border(1)];
      this.borders.push({ left, right });
      const look = { color: ground.colour, roughness: 0.9, clippingPlanes: [left, right] };
      const mesh = new THREE.Mesh(geometry, new THREE.MeshStandardMaterial(look));
      mesh.position.y = offset_m;
      mesh.receiveShadow = mesh.castShadow = true;
      this.group.add(mesh);
    }
  }

  /** Moves the borders to the middle between neighbours. */
  split(robots: readonly Robot[]): void {
    for (let index = 0; index + 1 < robots.length; index += 1) {
      const border_m = (robots[index]!.base.y + robots[index + 1]!.base.y) / 2;
      this.borders[index]!.right.constant = -border_m;
      this.borders[index + 1]!.left.constant = border_m;
    }
  }
}

/** Whether the processor draws. */
function isSoftware(context: WebGLRenderingContext | WebGL2RenderingContext): boolean {
  const names = context.getExtension("WEBGL_debug_renderer_info");
  return names !== null && /swiftshader|llvmpipe|software/i.test(String(context.getParameter(names.UNMASKED_RENDERER_WEBGL)));
}

export class Surroundings {
  private readonly key = new THREE.DirectionalLight(0xfff4e6);
  private readonly hemisphere = new THREE.HemisphereLight(0xffffff, 0x8a8f98);
  private readonly line = new THREE.Color();
  private readonly centre = new THREE.Vector2();
  private readonly grid = gridMaterial(this.line, this.centre);
  private readonly plane = new THREE.Mesh(new THREE.PlaneGeometry(GROUND_M, GROUND_M), this.grid);
  private readonly dome = new THREE.Mesh(
    new THREE.SphereGeometry(DOME_M, 24, 24).rotateX(Math.PI / 2),
    new THREE.MeshBasicMaterial({ vertexColors: true, side: THREE.BackSide, depthWrite: false, toneMapped: false }),
  );
  private readonly dark = matchMedia("(prefers-color-scheme: dark)");
  private terrain: Terrain | undefined;
  /** Light of a room; `null` where it would take long. */
  private room: THREE.Texture | null = null;
  private isPlain = false;

  constructor(private readonly scene: THREE.Scene, renderer: THREE.WebGLRenderer) {
    // It takes seconds on a processor, and nothing is seen before.
    if (!isSoftware(renderer.getContext())) {
      const generator = new THREE.PMREMGenerator(renderer);
      this.room = scene.environment = generator.fromScene(new RoomEnvironment(), 0.04).texture;
      generator.dispose();
    }
    scene.environmentRotation.set(Math.PI / 2, 0, 0);
    scene.environmentIntensity = ENVIRONMENT;
    const { shadow } = this.key;
    this.key.castShadow = this.plane.receiveShadow = true;
    shadow.mapSize.set(SHADOW_PIXELS, SHADOW_PIXELS);
    [shadow.radius, shadow.bias, shadow.normalBias, shadow.camera.far] = [3, -0.0003, 0.012, 20];
    this.hemisphere.position.set(0, 0, 1);
    this.dome.renderOrder = -1;
    scene.add(this.key, this.key.target, this.hemisphere, this.plane, this.dome);
    this.dark.addEventListener("change", () => this.paint());
    this.paint();
    this.simplify(this.room === null);
  }

  /** Draws plainly, for machines without a GPU: no shadow, and no light from the room. */
  simplify(isPlain: boolean): void {
    this.isPlain = isPlain || this.room === null;
    this.key.castShadow = !this.isPlain;
    this.scene.environment = this.isPlain ? null : this.room;
    this.hemisphere.intensity = this.isPlain ? 2 : (this.dark.matches ? DARK : LIGHT).hemisphere;
  }

  private paint(): void {
    const theme = this.dark.matches ? DARK : LIGHT;
    this.grid.color.setHex(this.terrain?.colour ?? theme.ground);
    this.line.setHex(theme.line);
    this.hemisphere.intensity = this.isPlain ? 2 : theme.hemisphere;
    this.key.intensity = theme.key;
    const corners = this.dome.geometry.getAttribute("position");
    const colours = new THREE.BufferAttribute(new Float32Array(3 * corners.count), 3);
    const [horizon, zenith, tint] = [new THREE.Color(theme.horizon), new THREE.Color(theme.zenith), new THREE.Color()];
    for (let corner = 0; corner < corners.count; corner += 1) {
      const height = Math.max(0, corners.getZ(corner) / DOME_M);
      tint.lerpColors(horizon, zenith, Math.sqrt(height)).toArray(colours.array, 3 * corner);
    }
    this.dome.geometry.setAttribute("color", colours);
  }

  /** Takes the ground of a scene: a mesh, or the plane z = 0. */
  setGround(ground: PageMesh | undefined, robots: readonly Robot[]): void {
    if (this.terrain !== undefined) discard(this.terrain.group);
    this.terrain = ground && new Terrain(ground, robots);
    if (this.terrain !== undefined) this.scene.add(this.terrain.group);
    // Below a mesh, the plane fills gaps between strips.
    this.plane.position.z = this.terrain?.below_m ?? 0;
    this.paint();
    const { camera } = this.key.shadow;
    camera.right = camera.top = 1.6 + 0.75 * robots.length;
    camera.left = camera.bottom = -camera.right;
    camera.updateProjectionMatrix();
  }

  /** Follows the middle of the robots. */
  follow(middle: THREE.Vector3, camera: THREE.Vector3, robots: readonly Robot[]): void {
    // Steps of 10 m keep lines and checks where they are in the world.
    const { position } = this.plane;
    [position.x, position.y] = [10 * Math.round(middle.x / 10), 10 * Math.round(middle.y / 10)];
    this.centre.set(middle.x - position.x, middle.y - position.y);
    this.dome.position.copy(camera);
    this.key.target.position.copy(middle);
    this.key.position.set(middle.x + 3, middle.y - 3.5, middle.z + 7);
    this.terrain?.split(robots);
  }
}
