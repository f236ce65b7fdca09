// SPDX-License-Identifier: Apache-2.0
// The configuration of a board: a resource for each program of `indurop serve --plc`, with its tasks and the instances of
// programs. What DI demands of a resource and the board does not know is an empty text.

import type { NodeId, UAObject } from "node-opcua";

import type { ModuleDescription, PlcDescription } from "../serve/types";
import { node_at, set_name, set_number, set_text, set_unsigned } from "../space/set";
import type { BoardTree, Space } from "../space/tree";
import { Instances } from "./instances";
import type { PlcModel } from "./model";
import type { PouTypes } from "./pou_types";

const US = 1000;

// As IEC 61131-3 writes times.
function time_of(ns: number): string {
  return ns % US === 0 ? `T#${ns / US}us` : `T#${ns}ns`;
}

// The first 8 bytes of the data, from a hexadecimal number.
function mark_of(text: string): Buffer {
  const mark = Buffer.alloc(8);
  mark.writeBigUInt64LE(BigInt(`0x${text}`));
  return mark;
}

interface Resource {
  node: UAObject;
  shown: boolean;
  tasks: Map<string, UAObject>;  // by id
  variables: string[];  // with the data of its programs
}

export class Configuration {
  readonly instances: Instances;
  private readonly node: UAObject;
  private readonly resources = new Map<string, Resource>();

  constructor(private readonly space: Space, private readonly model: PlcModel, private readonly types: PouTypes, private readonly board: string,
    private readonly version: string) {
    this.instances = new Instances(space, model);
    this.node = model.add("CtrlConfigurationType", `${board}/plc`, board, model.device_set);
  }

  get is_empty(): boolean {
    return ![...this.resources.values()].some(({ shown }) => shown);
  }

  // Programs that the board has run, and has the variables of.
  expected(tree: BoardTree): string[] {
    const is_there = (name: string): boolean => tree.variable(name)?.gone === false;
    return [...this.resources].filter(([, { variables }]) => variables.some(is_there)).map(([name]) => name);
  }

  // on_other: another program runs than one of these.
  update(programs: PlcDescription[], modules: ModuleDescription[], tree: BoardTree, on_other: () => void): void {
    this.instances.begin();
    for (const program of programs) this.show(program, modules, tree, on_other);
    this.instances.end();
    for (const [name, resource] of this.resources) {
      if (programs.some(({ program }) => program === name)) continue;
      this.keep_tasks(resource, new Set());
      if (resource.shown) resource.node.removeReference(this.below_resources());
      resource.shown = false;
    }
  }

  private show(program: PlcDescription, modules: ModuleDescription[], tree: BoardTree, on_other: () => void): void {
    const resource = this.resource(program.program);
    this.show_globals(resource.node, program.globals, tree);
    const id = `${this.board}/plc/${program.program}`;
    const tasks = program.tasks.map((task) => this.task(id, resource, task, modules.find(({ name }) => name === task.module)));
    const nodes = this.types.all(program.types);
    resource.variables = program.instances.map(({ variable }) => variable);
    for (const instance of program.instances) {
      const variable = tree.variable(instance.variable);
      if (!variable || variable.gone) continue;
      variable.mark = { expected: mark_of(instance.mark), on_other };
      const priority = node_at(tasks[instance.task], "Priority").readValue().value.value as number;
      this.instances.program(`${id}/${instance.name}`, instance, { types: program.types, nodes, tree, variable, priority },
        this.model.folder(resource.node, "Programs"), tasks[instance.task]);
    }
    this.keep_tasks(resource, new Set(tasks));
  }

  private resource(name: string): Resource {
    let resource = this.resources.get(name);
    if (!resource) {
      const resources = this.model.folder(this.node, "Resources");
      resource = { node: this.model.add("CtrlResourceType", `${this.board}/plc/${name}`, name, resources, ["GlobalVars"]), shown: true, tasks: new Map(), variables: [] };
      for (const text of ["Manufacturer", "Model"]) set_name(resource.node, text, "");
      for (const text of ["SerialNumber", "DeviceManual", "DeviceRevision", "HardwareRevision"]) set_text(resource.node, text, "");
      set_text(resource.node, "SoftwareRevision", this.version);
      set_number(resource.node, "RevisionCounter", -1);
      this.resources.set(name, resource);
    }
    if (!resource.shown) resource.node.addReference(this.below_resources());
    resource.shown = true;
    return resource;
  }

  private below_resources(): { referenceType: string; isForward: boolean; nodeId: NodeId } {
    return { referenceType: "HasComponent", isForward: false, nodeId: this.model.folder(this.node, "Resources").nodeId };
  }

  private task(id: string, resource: Resource, { name, module, single }: PlcDescription["tasks"][0], node: ModuleDescription | undefined): UAObject {
    const periodic = node?.operation === "periodic";
    const task_id = `${id}/task/${module}${periodic ? "" : "/sporadic"}`;
    let task = resource.tasks.get(task_id);
    if (!task) {
      const optionals = [...(periodic ? ["Interval"] : []), ...(single ? ["Single"] : [])];
      task = this.model.add("CtrlTaskType", task_id, name || module, this.model.folder(resource.node, "Tasks"), optionals);
      resource.tasks.set(task_id, task);
    }
    set_unsigned(task, "Priority", node?.priority ?? 0);
    if (periodic) set_text(task, "Interval", time_of(node.period_ns));
    if (task.getChildByName("Single")) set_text(task, "Single", single ?? "");
    return task;
  }

  private keep_tasks(resource: Resource, tasks: Set<UAObject>): void {
    for (const [id, task] of resource.tasks) {
      if (tasks.has(task)) continue;
      resource.tasks.delete(id);
      this.space.namespace.deleteNode(task);
    }
  }

  // The board's variables that the program declares.
  private show_globals(resource: UAObject, names: string[], tree: BoardTree): void {
    const group = resource.getChildByName("GlobalVars") as UAObject;
    for (const one of group.findReferences("Organizes", true)) group.removeReference(one);
    for (const name of names) {
      const node = tree.node_of(name);
      if (node) group.addReference({ referenceType: "Organizes", nodeId: node.nodeId });
    }
  }
}
