// Meshes of the scene as geometries of three.js.
import * as THREE from "three";
import { mergeGeometries, toCreasedNormals } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import type { PageMesh } from "./generated/page_pb";

/** Faceted triangles that meet at less than this angle look like one round surface. */
const CREASE_RAD = Math.PI / 6;
/** toCreasedNormals joins corners that are less than 0.01 apart. */
const CREASE_SCALE = 1000;

/** Up to so many corners, triangles name them by 16 bits. */
const MOST_OF_16_BITS = 65_536;

/** Joins meshes of one colour and kind of surface, so that a body costs few draw calls. */
export function joined(meshes: readonly PageMesh[]): THREE.BufferGeometry {
  const parts = meshes.map(({ corners, triangles, isFaceted, lowM, unitM }) => {
    const geometry = new THREE.BufferGeometry();
    // Copies, as bytes of a message may begin at an odd address.
    const steps = new Uint16Array(corners.slice().buffer);
    const positions = Float32Array.from(steps, (step, at) => lowM[at % 3]! + step * unitM[at % 3]!);
    geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
    const Index = positions.length / 3 <= MOST_OF_16_BITS ? Uint16Array : Uint32Array;
    // Parts of one body may differ in their number of corners.
    geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(new Index(triangles.slice().buffer)), 1));
    geometry.computeVertexNormals();
    if (!isFaceted) return geometry;
    const large = geometry.scale(CREASE_SCALE, CREASE_SCALE, CREASE_SCALE);
    return toCreasedNormals(large, CREASE_RAD).scale(1 / CREASE_SCALE, 1 / CREASE_SCALE, 1 / CREASE_SCALE);
  });
  return parts.length === 1 ? parts[0]! : mergeGeometries(parts);
}

/** Frees the memory of all meshes in `group` and removes it from the scene. */
export function discard(group: THREE.Object3D): void {
  group.traverse((object) => {
    if (!(object instanceof THREE.Mesh || object instanceof THREE.Sprite)) return;
    const material = object.material as THREE.Material & { map?: THREE.Texture | null };
    object.geometry.dispose();
    material.map?.dispose();
    material.dispose();
  });
  group.removeFromParent();
}
