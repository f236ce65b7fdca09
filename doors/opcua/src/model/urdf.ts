// SPDX-License-Identifier: Apache-2.0
// The URDF file of an arm: its axes, in the order of the robot task (docs/robot.md).

import { Xml2Json } from "node-opcua-xml2json";

export interface Joint {
  name: string;
  type: string;
  parent: string;
  child: string;
  mimic: boolean;  // moved by another joint
}

export interface Urdf {
  name: string;
  axes: Joint[];
  is_linkage: boolean;
}

const TOOLS = ["tcp", "tool0"];
const AXIS_TYPES = ["revolute", "continuous", "prismatic"];

interface Robot {
  name: string;
  joints: Joint[];
  workpiece: string;  // the link that carries it, if axes move that
}

// Joints of <transmission> have no <child>.
function read(text: string): Robot {
  const robot: Robot = { name: "", joints: [], workpiece: "" };
  let joint: Joint;
  const end = (which: "parent" | "child") => ({ init: (_: string, attributes: Record<string, string>) => { joint[which] = attributes.link ?? ""; } });
  new Xml2Json({
    parser: {
      robot: {
        init: (_: string, attributes: Record<string, string>) => { robot.name = attributes.name ?? ""; },
        parser: {
          joint: {
            init: (_: string, { name = "", type = "" }: Record<string, string>) => { joint = { name, type, parent: "", child: "", mimic: false }; },
            parser: { parent: end("parent"), child: end("child"), mimic: { init: () => { joint.mimic = true; } } },
            finish: () => { if (joint.child) robot.joints.push(joint); },
          },
          workpiece: { init: (_: string, { link = "" }: Record<string, string>) => { robot.workpiece = link; } },
        },
      },
    },
  }).parseString(text);
  return robot;
}

// Axes from the root to this link. A loop ends it.
function axes_to(by_child: Map<string, Joint>, link: string): Joint[] {
  const chain: Joint[] = [];
  for (let at = by_child.get(link); at && chain.length < by_child.size; at = by_child.get(at.parent)) chain.unshift(at);
  return chain.filter(({ type, mimic }) => AXIS_TYPES.includes(type) && !mimic);
}

// null: not a file of an arm.
export function read_urdf(text: string): Urdf | null {
  let robot: Robot;
  try {
    robot = read(text);
  } catch {
    return null;
  }
  const by_child = new Map(robot.joints.map((joint) => [joint.child, joint]));
  const tool = TOOLS.find((name) => by_child.has(name));
  const ends = tool ? [tool] : [...by_child.keys()];
  const axes = ends.map((link) => axes_to(by_child, link)).reduce((best, one) => (one.length > best.length ? one : best), []);
  axes.push(...axes_to(by_child, robot.workpiece));
  return { name: robot.name, axes, is_linkage: robot.joints.some(({ mimic }) => mimic) };
}
