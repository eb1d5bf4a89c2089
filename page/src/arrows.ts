// Arrows of forces and velocities, trails of the base and the feet, and the centre of mass.
import * as THREE from "three";
import type { Foot, Robot } from "./robots";
import { BODY_NUMBERS, POSITION_M, type Sample, type Timeline } from "./timeline";

const FORCE_N = 0.1;
const FORCE_N_MIN = 3;
const FORCE_M_PER_N = 0.0015;
const VELOCITY_M_PER_MPS = 0.5;
const ARROW_M_MAX = 1.2;
const TRAIL_S = 5;
const TRAIL_STEP_S = 0.05;
const CAPACITY = 512;
const CENTRE_M = 0.05;
const UP = new THREE.Vector3(0, 0, 1);

/** Rods with or without a head, all of one colour, drawn by two calls. */
class Rods {
  readonly group = new THREE.Group();
  private readonly shafts: THREE.InstancedMesh;
  private readonly heads: THREE.InstancedMesh;
  private readonly turn = new THREE.Quaternion();
  private readonly along = new THREE.Vector3();
  private readonly scale = new THREE.Vector3();
  private readonly matrix = new THREE.Matrix4();

  /** `isInside`: drawn over the robot. */
  constructor(color: number, private readonly radius_m: number, isInside = false) {
    const glow = { color, emissive: color, emissiveIntensity: 0.45, roughness: 0.6 };
    const look = { ...glow, depthTest: !isInside, transparent: isInside };
    const part = (shape: THREE.BufferGeometry) => {
      shape.translate(0, 0.5, 0).rotateX(Math.PI / 2);
      const mesh = new THREE.InstancedMesh(shape, new THREE.MeshStandardMaterial(look), CAPACITY);
      // Bounds of instances would be computed once and go stale.
      mesh.frustumCulled = false;
      // Later than the ground, which is transparent too.
      mesh.renderOrder = isInside ? 1 : 0;
      this.group.add(mesh);
      return mesh;
    };
    this.shafts = part(new THREE.CylinderGeometry(1, 1, 1, 10));
    this.heads = part(new THREE.ConeGeometry(1, 1, 16));
  }

  begin(): void {
    this.shafts.count = this.heads.count = 0;
    this.shafts.instanceMatrix.needsUpdate = this.heads.instanceMatrix.needsUpdate = true;
  }

  rod(from: THREE.Vector3, to: THREE.Vector3): void {
    this.along.subVectors(to, from);
    const length_m = this.along.length();
    if (length_m < 1e-4 || this.shafts.count === CAPACITY) return;
    this.turn.setFromUnitVectors(UP, this.along.divideScalar(length_m));
    this.scale.set(this.radius_m, this.radius_m, length_m);
    this.shafts.setMatrixAt(this.shafts.count++, this.matrix.compose(from, this.turn, this.scale));
  }

  /** An arrow from `from` along `vector`. Changes `vector`. */
  arrow(from: THREE.Vector3, vector: THREE.Vector3): void {
    const length_m = Math.min(vector.length(), ARROW_M_MAX);
    if (length_m < 1e-3 || this.heads.count === CAPACITY) return;
    const head_m = Math.min(5 * this.radius_m, 0.6 * length_m);
    this.rod(from, vector.setLength(length_m - head_m).add(from));
    this.scale.set(0.5 * head_m, 0.5 * head_m, head_m);
    this.heads.setMatrixAt(this.heads.count++, this.matrix.compose(vector, this.turn, this.scale));
  }
}

/** Balls with the checks that mark a centre of mass, drawn over the robot. */
function balls(): THREE.InstancedMesh {
  const [dark, light] = [[16, 22, 32, 255], [255, 255, 255, 255]];
  const checks = Uint8Array.from([dark, light, dark, light, light, dark, light, dark].flatMap((texel) => texel ?? []));
  const map = new THREE.DataTexture(checks, 4, 2);
  map.needsUpdate = true;
  const look = new THREE.MeshBasicMaterial({ map, depthTest: false, transparent: true, toneMapped: false });
  const shape = new THREE.SphereGeometry(CENTRE_M, 24, 16).rotateX(Math.PI / 2);
  const mesh = new THREE.InstancedMesh(shape, look, CAPACITY);
  mesh.frustumCulled = false;
  mesh.renderOrder = 2;
  return mesh;
}

export const MARKINGS = ["contacts", "command", "velocity", "trail", "left", "right", "centre"] as const;
export type Marking = (typeof MARKINGS)[number];

export class Arrows {
  readonly group = new THREE.Group();
  readonly rods: Record<Marking, Rods> = {
    contacts: new Rods(0xe5383b, 0.01),
    command: new Rods(0x2bb24c, 0.016),
    velocity: new Rods(0x2f7bf6, 0.016),
    trail: new Rods(0xf5b700, 0.007),
    left: new Rods(0x12a5a0, 0.006),
    right: new Rods(0xdb4a9b, 0.006),
    centre: new Rods(0x9b5de5, 0.006, true),
  };
  /** Whether the ground is the plane z = 0. */
  isFlat = true;
  private readonly balls = balls();
  private readonly matrix = new THREE.Matrix4();
  private readonly from = new THREE.Vector3();
  private readonly to = new THREE.Vector3();
  private readonly turn = new THREE.Quaternion();
  private readonly part = new THREE.Vector3();

  constructor() {
    for (const rods of Object.values(this.rods)) this.group.add(rods.group);
    this.rods.centre.group.add(this.balls);
  }

  /** Draws what belongs to the robots at the moment of the timeline. */
  draw(robots: readonly Robot[], timeline: Timeline): void {
    for (const rods of Object.values(this.rods)) rods.begin();
    this.balls.count = 0;
    this.balls.instanceMatrix.needsUpdate = true;
    for (const [index, robot] of robots.entries()) {
      const sample = timeline.sample(index);
      if (sample !== undefined) this.add(robot, sample, timeline, index);
    }
  }

  private add(robot: Robot, sample: Sample, timeline: Timeline, index: number): void {
    const { frame, contacts } = sample.mix < 0.5 ? sample.before : sample.after;
    for (let at = 0; at + 5 < contacts.length; at += 6) {
      this.to.fromArray(contacts, at + 3).multiplyScalar(FORCE_N);
      if (this.to.length() < FORCE_N_MIN) continue;
      this.from.fromArray(contacts, at).multiplyScalar(POSITION_M).add(robot.base);
      this.rods.contacts.arrow(this.from, this.to.multiplyScalar(FORCE_M_PER_N));
    }
    this.velocity(this.rods.command, robot, frame.command, 0.16);
    this.velocity(this.rods.velocity, robot, frame.velocity, 0.1);
    const { episode } = sample.before.frame;
    const trail = (rods: Rods, foot?: Foot) => {
      if (rods.group.visible) this.trail(rods, robot, episode, timeline, index, foot);
    };
    trail(this.rods.trail);
    for (const foot of robot.feet.left) trail(this.rods.left, foot);
    for (const foot of robot.feet.right) trail(this.rods.right, foot);
    if (robot.hasCentre && this.rods.centre.group.visible) this.centre(robot);
  }

  /** Where a foot is drawn. */
  private at(robot: Robot, { body, at }: Foot): THREE.Vector3 {
    const { position, quaternion } = robot.bodies[body]!;
    return this.to.copy(at).applyQuaternion(quaternion).add(position).add(robot.base);
  }

  private centre(robot: Robot): void {
    this.balls.setMatrixAt(this.balls.count++, this.matrix.makeTranslation(robot.centre));
    const feet = [...robot.feet.left, ...robot.feet.right];
    const lowest_m = Math.min(...feet.map((foot) => this.at(robot, foot).z));
    const ground_m = this.isFlat || feet.length === 0 ? 0 : lowest_m;
    this.rods.centre.rod(robot.centre, this.to.copy(robot.centre).setZ(ground_m));
  }

  private velocity(rods: Rods, robot: Robot, [forward_mps, left_mps]: readonly number[], above_m: number): void {
    if (forward_mps === undefined || left_mps === undefined) return;
    this.from.copy(robot.base).setZ(robot.base.z + robot.top_m + above_m);
    this.to.set(forward_mps, left_mps, 0).multiplyScalar(VELOCITY_M_PER_MPS).applyAxisAngle(UP, robot.yaw_rad);
    rods.arrow(this.from, this.to);
  }

  /** Draws where the base, or a foot, was in the last seconds. */
  private trail(rods: Rods, robot: Robot, episode: bigint, timeline: Timeline, index: number, foot?: Foot): void {
    let last_s = -Infinity;
    timeline.visit(index, TRAIL_S, ({ frame, shown_s, bodies }) => {
      if (frame.episode !== episode || shown_s < last_s + TRAIL_STEP_S) return;
      this.to.fromArray(frame.baseM);
      this.to.y += robot.offset_m;
      if (foot !== undefined) {
        const from = BODY_NUMBERS * foot.body;
        this.to.add(this.part.fromArray(bodies, from));
        this.to.add(this.part.copy(foot.at).applyQuaternion(this.turn.fromArray(bodies, from + 3)));
      }
      if (last_s > 0) rods.rod(this.from, this.to);
      this.from.copy(this.to);
      last_s = shown_s;
    });
    if (last_s > 0) rods.rod(this.from, foot === undefined ? robot.base : this.at(robot, foot));
  }
}
