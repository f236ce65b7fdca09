// SPDX-License-Identifier: Apache-2.0
// What the arm keeps out of, the bodies of its tools, and the box that its tool stays in: transparent.

import * as THREE from "three";
import type { Robot, RobotBody } from "../../api/types";
import { colour } from "../../shell/theme";
import type { Arm } from "./arm";

function shape_of({ kind, size }: RobotBody): THREE.BufferGeometry {
  const [x, y, z] = size.map((one) => one / 1000);
  if (kind === "box") return new THREE.BoxGeometry(x, y, z);
  if (kind === "ball") return new THREE.SphereGeometry(x / 2, 32, 20);
  return new THREE.CylinderGeometry(x / 2, x / 2, z, 40).rotateX(Math.PI / 2);  // along z
}

function rad(degrees: number): number {
  return degrees * Math.PI / 180;
}

export class Zones {
  private readonly around = new THREE.Group();
  private readonly held = new THREE.Group();
  private readonly zone = new THREE.MeshStandardMaterial({ transparent: true, opacity: 0.22, depthWrite: false, side: THREE.DoubleSide });
  private readonly body = new THREE.MeshStandardMaterial({ transparent: true, opacity: 0.4, depthWrite: false });
  private readonly edge = new THREE.LineBasicMaterial();
  private readonly box = new THREE.LineBasicMaterial();
  private tool = 0;

  constructor(arm: Arm, private readonly robot: Robot) {
    for (const zone of robot.zones ?? []) this.around.add(this.solid(zone, this.zone));
    const corners = robot.workspace ?? [];
    if (corners.length === 6) {
      const [low, high] = [corners.slice(0, 3), corners.slice(3)].map((corner) => new THREE.Vector3(...corner).divideScalar(1000));
      const size = high.clone().sub(low);
      const shape = new THREE.BoxGeometry(Math.abs(size.x), Math.abs(size.y), Math.abs(size.z));
      const box = new THREE.LineSegments(new THREE.EdgesGeometry(shape), this.box);
      box.position.copy(low.add(high).divideScalar(2));
      this.around.add(box);
      shape.dispose();
    }
    arm.robot.add(this.around);  // these stand still, also where axes move the workpiece
    arm.tool.add(this.held);
    this.recolour();
  }

  show(shown: boolean): void {
    this.around.visible = this.held.visible = shown;
  }

  // Returns whether the drawing has changed.
  hold(tool: number): boolean {
    if (tool === this.tool) return false;
    this.tool = tool;
    this.held.clear();
    for (const body of this.robot.bodies ?? []) if (body.tool === tool) this.held.add(this.solid(body, this.body));
    return true;
  }

  recolour(): void {
    this.zone.color.set(colour("bad"));
    this.edge.color.set(colour("bad"));
    this.body.color.set(colour("accent"));
    this.box.color.set(colour("quiet"));
  }

  private solid(body: RobotBody, material: THREE.Material): THREE.Object3D {
    const mesh = new THREE.Mesh(shape_of(body), material);
    mesh.position.set(body.position[0], body.position[1], body.position[2]).divideScalar(1000);
    mesh.rotation.set(rad(body.orientation[0]), rad(body.orientation[1]), rad(body.orientation[2]), "ZYX");
    if (material === this.zone && body.kind === "box") mesh.add(new THREE.LineSegments(new THREE.EdgesGeometry(mesh.geometry), this.edge));
    return mesh;
  }
}
