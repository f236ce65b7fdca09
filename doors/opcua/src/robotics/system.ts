// SPDX-License-Identifier: Apache-2.0
// The MotionDeviceSystem of a board: the board is the controller, each robot task a motion device, a task control and
// safety states. What the model demands and the board does not know is an empty text.

import { DataType, Variant, type UAObject } from "node-opcua";

import type { BoardTree } from "../space/tree";
import type { Derive } from "../space/variable";
import { Branch, type Shared } from "./branch";
import { node_at, set_name, set_number, set_text, set_unit } from "../space/set";
import type { Axis, Robot } from "./robot";

const MAKER = "InduRoP";
const MODES = [0, 3, 1];  // ROBOT_OPERATING_MODE -> OperationalModeEnumeration: OTHER, AUTOMATIC, MANUAL_REDUCED_SPEED
const IN_CONTROL = [1, 2, 3, 4];  // ROBOT_GROUP_STATE: all but DISABLED and ERRORSTOP
const LOADED = [1, 2, 5, 6];  // ROBOT_JOB_STATE: it runs, waits, pauses or resumes

const boolean = (value: boolean): Variant => new Variant({ dataType: DataType.Boolean, value });
const operational_mode: Derive = (mode: number) => new Variant({ dataType: DataType.Int32, value: MODES[mode] ?? 0 });
const in_control: Derive = (state: number) => boolean(IN_CONTROL.includes(state));
const is_loaded: Derive = (job) => boolean(LOADED.includes(job.eState) || job.bResume !== 0);
// bActive without a cause: the module that evaluates the circuit does not run, so it counts as an emergency stop.
const emergency_stop: Derive = (stop) => boolean(!!stop.bCircuit || (!!stop.bActive && !stop.bCurtain));
const protective_stop: Derive = (stop) => (stop.bCurtain === undefined ? null : boolean(stop.bCurtain !== 0));

function set_unknown(node: UAObject, names: string[]): void {
  for (const name of names) {
    if (name === "Manufacturer" || name === "Model") set_name(node, name, "");
    else set_text(node, name, "");
  }
}

class AxisNodes {
  private readonly axis: Branch;
  private readonly train: Branch;
  private unit: string | undefined;

  constructor(shared: Shared, device: UAObject, id: string, number: number, robot: Robot, tree: BoardTree) {
    const state = `${robot.prefix}AXIS_STATE[${number}]`;
    this.axis = new Branch(shared, "AxisType", {
      id: `${id}/axis${number + 1}`, name: `Axis_${number + 1}`, parent: node_at(device, "Axes"), optionals: ["ParameterSet.ActualSpeed"],
    });
    this.axis.view(tree, "ParameterSet/ActualPosition", `${state}.dPosition`);
    this.axis.view(tree, "ParameterSet/ActualSpeed", `${state}.dActualVelocity`);
    this.train = new Branch(shared, "PowerTrainType", {
      id: `${id}/train${number + 1}`, name: `PowerTrain_${number + 1}`, parent: node_at(device, "PowerTrains"),
    });
    const motor = shared.model.add("MotorType", { id: `${id}/train${number + 1}/motor`, name: "Motor", parent: this.train.node });
    set_unknown(motor, ["Manufacturer", "Model", "SerialNumber", "ProductCode"]);
    set_unit(motor, "ParameterSet/MotorTemperature", "degC");
    // As the model wants it where there is no sensor.
    node_at(motor, "ParameterSet/MotorTemperature").setValueFromSource(new Variant());
    this.train.link(this.axis.node, "Requires", this.train.node);
    this.train.link(this.train.node, "Moves", this.axis.node);
  }

  renew({ name, profile, unit }: Axis, tree: BoardTree): void {
    this.axis.renew(tree);
    this.train.renew(tree);
    this.axis.node.setDisplayName(name || this.axis.node.browseName.name!);
    set_number(this.axis.node, "MotionProfile", profile);
    if (unit === this.unit) return;  // clients of values are notified of every unit that is set
    this.unit = unit;
    set_unit(this.axis.node, "ParameterSet/ActualPosition", unit);
    set_unit(this.axis.node, "ParameterSet/ActualSpeed", `${unit}/s`);
  }

  withdraw(): void {
    this.train.withdraw();
    this.axis.withdraw();
  }
}

class RobotNodes {
  private readonly device: Branch;
  private readonly task: Branch;
  private readonly safety: Branch;
  private readonly axes: AxisNodes[] = [];

  constructor(private readonly shared: Shared, system: UAObject, controller: UAObject, private readonly id: string, robot: Robot, tree: BoardTree) {
    const { prefix, name } = robot;
    this.device = new Branch(shared, "MotionDeviceType", {
      id: `${id}/device`, name, parent: node_at(system, "MotionDevices"), optionals: ["ParameterSet.InControl", "TaskControlReference"],
    });
    this.device.view(tree, "ParameterSet/SpeedOverride", `${prefix}ROBOT_OVERRIDE`);
    this.device.view(tree, "ParameterSet/InControl", `${prefix}ROBOT_MODULE_STATE.eState`, in_control);
    set_unknown(this.device.node, ["Manufacturer", "SerialNumber", "ProductCode"]);
    this.task = new Branch(shared, "TaskControlType", { id: `${id}/task`, name, parent: node_at(controller, "TaskControls") });
    this.task.view(tree, "ParameterSet/TaskProgramName", `${prefix}ROBOT_JOB.name`);
    this.task.view(tree, "ParameterSet/TaskProgramLoaded", `${prefix}ROBOT_JOB`, is_loaded);
    set_name(this.task.node, "ComponentName", name);
    node_at(this.device.node, "TaskControlReference").setValueFromSource({ dataType: DataType.NodeId, value: this.task.node.nodeId });
    this.safety = new Branch(shared, "SafetyStateType", { id: `${id}/safety`, name, parent: node_at(system, "SafetyStates") });
    this.safety.view(tree, "ParameterSet/OperationalMode", `${prefix}ROBOT_ARM.eMode`, operational_mode);
    this.safety.view(tree, "ParameterSet/EmergencyStop", robot.emergency_stop, emergency_stop);
    this.safety.view(tree, "ParameterSet/ProtectiveStop", robot.emergency_stop, protective_stop);
    this.device.link(controller, "Controls", this.device.node);
    this.device.link(this.task.node, "Controls", this.device.node);
    this.safety.link(controller, "HasSafetyStates", this.safety.node);
  }

  renew(robot: Robot, tree: BoardTree): void {
    for (const branch of [this.device, this.task, this.safety]) branch.renew(tree);
    set_name(this.device.node, "Model", robot.model);
    set_number(this.device.node, "MotionDeviceCategory", robot.category);
    robot.axes.forEach((axis, number) => {
      this.axes[number] ??= new AxisNodes(this.shared, this.device.node, this.id, number, robot, tree);
      this.axes[number].renew(axis, tree);
    });
    for (const gone of this.axes.slice(robot.axes.length)) gone.withdraw();
  }

  withdraw(): void {
    for (const axis of this.axes) axis.withdraw();
    for (const branch of [this.safety, this.task, this.device]) branch.withdraw();
  }
}

export class System {
  private readonly root: Branch;
  private readonly controller: UAObject;
  private readonly robots = new Map<string, RobotNodes>();

  // version: of the software; empty: not known.
  constructor(private readonly shared: Shared, private readonly board: string, version: string) {
    const id = `${board}/robotics`;
    this.root = new Branch(shared, "MotionDeviceSystemType", { id: `${id}/system`, name: board, parent: shared.model.device_set });
    this.controller = shared.model.add("ControllerType", { id: `${id}/controller`, name: "Controller", parent: node_at(this.root.node, "Controllers") });
    set_unknown(this.controller, ["Manufacturer", "Model", "SerialNumber", "ProductCode"]);
    set_text(this.controller, "CurrentUser/Level", "");
    const software = shared.model.add("SoftwareType", { id: `${id}/software`, name: MAKER, parent: node_at(this.controller, "Software") });
    set_name(software, "Manufacturer", MAKER);
    set_name(software, "Model", MAKER);
    set_text(software, "SoftwareRevision", version);
  }

  // Robots that are as they were stay as they are.
  update(robots: Robot[], tree: BoardTree): void {
    const names = new Set(robots.map(({ name }) => name));
    for (const [name, nodes] of this.robots) if (!names.has(name)) nodes.withdraw();
    if (robots.length > 0) this.root.renew(tree);
    else this.root.withdraw();
    for (const robot of robots) {
      let nodes = this.robots.get(robot.name);
      if (!nodes) {
        nodes = new RobotNodes(this.shared, this.root.node, this.controller, `${this.board}/robotics/${robot.name}`, robot, tree);
        this.robots.set(robot.name, nodes);
      }
      nodes.renew(robot, tree);
    }
  }
}
