// A robot of the scene and its pose between two frames.
import * as THREE from "three";
import type { PageMesh, PageRobot } from "./generated/page_pb";
import { joined } from "./meshes";
import type { Sample } from "./timeline";

/** Distance between robots that are compared, as all of them share one world frame. */
export const SPACING_M = 1.5;
/** Unit of the packed positions. */
export const POSITION_M = 1e-4;

export class Robot {
  readonly group = new THREE.Group();
  /** Where the base is drawn: its position in the world and the offset. */
  readonly base = new THREE.Vector3();
  yaw_rad = 0;
  /** Highest point above the base, and height, when it was first drawn (m). */
  top_m = 0.5;
  height_m = 1;
  private readonly bodies: THREE.Group[] = [];
  private readonly from = new THREE.Quaternion();
  private readonly to = new THREE.Quaternion();

  constructor(robot: PageRobot, readonly offset_m: number) {
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
    this.group.visible = false;
  }

  /** Takes the pose at `sample`. */
  place({ before, after, mix }: Sample): void {
    const [a, b] = [before.frame.baseM, after.frame.baseM];
    const between = (axis: number) => a[axis]! + mix * (b[axis]! - a[axis]!);
    this.base.set(between(0), between(1) + this.offset_m, between(2));
    this.group.position.copy(this.base);
    const [p, q] = [before.bodies, after.bodies];
    for (const [index, body] of this.bodies.entries()) {
      const at = 7 * index;
      if (at + 7 > p.length || at + 7 > q.length) break;
      const position = (axis: number) => (p[at + axis]! + mix * (q[at + axis]! - p[at + axis]!)) * POSITION_M;
      body.position.set(position(0), position(1), position(2));
      this.from.set(p[at + 4]!, p[at + 5]!, p[at + 6]!, p[at + 3]!).normalize();
      this.to.set(q[at + 4]!, q[at + 5]!, q[at + 6]!, q[at + 3]!).normalize();
      body.quaternion.slerpQuaternions(this.from, this.to, mix);
    }
    const { x, y, z, w } = this.bodies[0]?.quaternion ?? this.from.identity();
    this.yaw_rad = Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
    if (!this.group.visible) this.measure();
  }

  private measure(): void {
    this.group.visible = true;
    this.group.updateMatrixWorld(true);
    const { min, max } = new THREE.Box3().setFromObject(this.group);
    if (min.z > max.z) return;
    [this.top_m, this.height_m] = [max.z - this.base.z, max.z - min.z];
  }
}
