// A robot of the scene and its pose between two frames.
import * as THREE from "three";
import type { PageMesh, PageRobot } from "./generated/page_pb";
import { joined } from "./meshes";
import { BODY_NUMBERS, type Sample } from "./timeline";

/** Distance between robots that are compared, as all of them share one world frame. */
export const SPACING_M = 1.5;

/** Point of a body, in its frame (m). */
export type Foot = { body: number; at: THREE.Vector3 };

const GHOST = new THREE.MeshStandardMaterial({ color: 0x9fb3c8, transparent: true, opacity: 0.35, depthWrite: false });

/** A copy of a body in the colour of ghosts, with the same geometry. */
function translucent(body: THREE.Group): THREE.Group {
  const copy = new THREE.Group();
  for (const part of body.children) {
    if (part instanceof THREE.Mesh) copy.add(new THREE.Mesh(part.geometry, GHOST));
  }
  return copy;
}

export class Robot {
  readonly group = new THREE.Group();
  /** Where the base is drawn: its position in the world and the offset. */
  readonly base = new THREE.Vector3();
  /** Where its centre of mass is drawn, if that is known. */
  readonly centre = new THREE.Vector3();
  hasCentre = false;
  yaw_rad = 0;
  /** Highest point above the base, and height, when it was first drawn (m). */
  top_m = 0.5;
  height_m = 1;
  readonly bodies: THREE.Group[] = [];
  /** The motion that the robot imitates, where that is. */
  readonly ghost = new THREE.Group();
  /** Feet that were left and right of the base when it was first drawn. */
  readonly feet: Record<"left" | "right", Foot[]> = { left: [], right: [] };
  private readonly from = new THREE.Quaternion();
  private readonly to = new THREE.Quaternion();

  constructor(private readonly robot: PageRobot, readonly offset_m: number) {
    const materials = new Map<number, THREE.Material>();
    for (const { meshes } of robot.bodies) {
      const body = new THREE.Group();
      const kinds = new Map<number, PageMesh[]>();
      for (const mesh of meshes) {
        const kind = 2 * mesh.colour + Number(mesh.isFaceted);
        kinds.set(kind, [...(kinds.get(kind) ?? []), mesh]);
      }
      for (const alike of kinds.values()) {
        const color = alike[0]!.colour;
        if (!materials.has(color)) {
          materials.set(color, new THREE.MeshStandardMaterial({ color, roughness: 0.45, metalness: 0.05 }));
        }
        const mesh = new THREE.Mesh(joined(alike), materials.get(color));
        mesh.castShadow = mesh.receiveShadow = true;
        body.add(mesh);
      }
      this.bodies.push(body);
      this.group.add(body);
    }
    // Nothing is known of the pose before the first frame.
    this.group.visible = this.ghost.visible = false;
  }

  /** Takes the pose at `sample`. */
  place({ before, after, mix }: Sample): void {
    const lerp = (to: THREE.Vector3, a: readonly number[], b: readonly number[]) => {
      const between = (axis: number) => a[axis]! + mix * (b[axis]! - a[axis]!);
      to.set(between(0), between(1) + this.offset_m, between(2));
    };
    lerp(this.base, before.frame.baseM, after.frame.baseM);
    this.group.position.copy(this.base);
    const [from, to] = [before.frame.centreOfMassM, after.frame.centreOfMassM];
    this.hasCentre = from.length === 3 && to.length === 3;
    if (this.hasCentre) lerp(this.centre, from, to);
    this.placeBodies(this.bodies, before.bodies, after.bodies, mix);
    this.ghost.visible = before.ghost.length > 0 && after.ghost.length > 0;
    if (this.ghost.visible) {
      if (this.ghost.children.length === 0) this.ghost.add(...this.bodies.map(translucent));
      lerp(this.ghost.position, before.frame.ghostBaseM, after.frame.ghostBaseM);
      this.placeBodies(this.ghost.children, before.ghost, after.ghost, mix);
    }
    const { x, y, z, w } = this.bodies[0]?.quaternion ?? this.from.identity();
    this.yaw_rad = Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
    if (!this.group.visible) this.measure();
  }

  private placeBodies(bodies: readonly THREE.Object3D[], p: Float32Array, q: Float32Array, mix: number): void {
    for (const [index, body] of bodies.entries()) {
      const at = BODY_NUMBERS * index;
      if (at + BODY_NUMBERS > p.length || at + BODY_NUMBERS > q.length) break;
      const position = (axis: number) => p[at + axis]! + mix * (q[at + axis]! - p[at + axis]!);
      body.position.set(position(0), position(1), position(2));
      this.from.fromArray(p, at + 3);
      this.to.fromArray(q, at + 3);
      // Takes the nearer of the two signs of a quaternion.
      body.quaternion.slerpQuaternions(this.from, this.to, mix);
    }
  }

  private measure(): void {
    this.group.visible = true;
    this.group.updateMatrixWorld(true);
    for (const { body, atM } of this.robot.feet) {
      if (body >= this.bodies.length) continue;
      const { x, y } = this.bodies[body]!.position;
      const isLeft = y * Math.cos(this.yaw_rad) > x * Math.sin(this.yaw_rad);
      this.feet[isLeft ? "left" : "right"].push({ body, at: new THREE.Vector3().fromArray(atM) });
    }
    const { min, max } = new THREE.Box3().setFromObject(this.group);
    if (min.z > max.z) return;
    [this.top_m, this.height_m] = [max.z - this.base.z, max.z - min.z];
  }
}
