// SPDX-License-Identifier: Apache-2.0
// The arm of a URDF file: its axes in order, and simple bodies for links without a shape.

import * as THREE from "three";
import URDFLoader, { type URDFJoint, type URDFLink, type URDFRobot } from "urdf-loader";

const TOOLS = ["tool0", "tcp"];
const THIN = 1e-3;

export interface Arm {
  robot: URDFRobot;
  axes: URDFJoint[];
  tool: THREE.Object3D;
  base: THREE.Object3D;  // poses are in its frame: the link of the workpiece, if axes move that
  size: number;  // m, approximately its reach
}

function is_joint(object: THREE.Object3D): object is URDFJoint {
  return (object as URDFJoint).isURDFJoint === true;
}

function joints_below(link: THREE.Object3D): URDFJoint[] {
  return link.children.filter(is_joint);
}

function is_axis(joint: URDFJoint): boolean {
  return ["revolute", "continuous", "prismatic"].includes(joint.jointType) && !("mimicJoint" in joint && joint.mimicJoint);
}

function joints_to(link: THREE.Object3D, robot: URDFRobot): URDFJoint[] {
  const chain: URDFJoint[] = [];
  for (let at: THREE.Object3D | null = link; at && at !== robot; at = at.parent) if (is_joint(at)) chain.unshift(at);
  return chain;
}

// The link named by <workpiece>, whose axes come after those of the arm; else the robot.
function base_of(urdf: string, robot: URDFRobot): THREE.Object3D {
  const name = new DOMParser().parseFromString(urdf, "text/xml").querySelector("workpiece")?.getAttribute("link");
  return (name && robot.links[name]) || robot;
}

// Joints from the root to the tool, or else to the end of the longest chain.
function chain_of(robot: URDFRobot): URDFJoint[] {
  const tool = TOOLS.map((name) => robot.links[name]).find(Boolean);
  if (tool) return joints_to(tool, robot);
  const longest = (from: THREE.Object3D): URDFJoint[] => joints_below(from)
    .map((joint) => [joint, ...joint.children.flatMap((link) => longest(link))])
    .reduce((best, one) => (one.length > best.length ? one : best), [] as URDFJoint[]);
  return longest(robot);
}

function tube(from: THREE.Vector3, to: THREE.Vector3, radius: number, material: THREE.Material): THREE.Mesh {
  const vector = to.clone().sub(from);
  const mesh = new THREE.Mesh(new THREE.CapsuleGeometry(radius, vector.length(), 6, 20), material);
  mesh.position.copy(from).addScaledVector(vector, 0.5);
  mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), vector.normalize());
  return mesh;
}

function has_shape(link: THREE.Object3D): boolean {
  return link.children.some((child) => !is_joint(child) && (child as { isURDFVisual?: boolean }).isURDFVisual === true && child.children.length > 0);
}

function hub(joint: URDFJoint, radius: number, material: THREE.Material): THREE.Mesh {
  const shape = joint.jointType === "prismatic"
    ? new THREE.BoxGeometry(radius * 2, radius * 2.6, radius * 2)
    : new THREE.CylinderGeometry(radius * 1.25, radius * 1.25, radius * 2.6, 32);
  const mesh = new THREE.Mesh(shape, material);
  mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), joint.axis.clone().normalize());
  return mesh;
}

function size_of(robot: URDFRobot): number {
  let sum = 0;
  for (const joint of chain_of(robot)) sum += joint.position.length();
  return Math.max(0.1, sum);
}

// Most URDF files refer to mesh files, which the page does not load: such links get a body from joint to joint.
function add_bodies(robot: URDFRobot, size: number, link_material: THREE.Material, hub_material: THREE.Material): void {
  const chain = chain_of(robot);
  const links = Object.values(robot.links) as URDFLink[];
  for (const link of links) {
    if (has_shape(link)) continue;
    const depth = chain.findIndex((joint) => joint.children.includes(link)) + 1;
    const radius = size * 0.045 * (1 - 0.55 * depth / (chain.length + 1));
    for (const joint of joints_below(link)) {
      if (joint.position.length() > THIN) link.add(tube(new THREE.Vector3(), joint.position.clone(), radius * 0.8, link_material));
      if (joint.jointType !== "fixed") joint.add(hub(joint, radius, hub_material));
    }
  }
}

export function arm_of(urdf: string, link_material: THREE.Material, hub_material: THREE.Material): Arm {
  const loader = new URDFLoader();
  loader.loadMeshCb = (_url, _manager, _material, done) => done(new THREE.Group());
  const robot = loader.parse(urdf);
  const chain = chain_of(robot);
  const size = size_of(robot);
  add_bodies(robot, size, link_material, hub_material);
  const last = chain[chain.length - 1];
  const tool = last?.children.find((child) => (child as URDFLink).isURDFLink) ?? robot;
  tool.add(new THREE.AxesHelper(size * 0.12));
  const base = base_of(urdf, robot);
  return { robot, axes: [...chain, ...joints_to(base, robot)].filter(is_axis), tool, base, size };
}
