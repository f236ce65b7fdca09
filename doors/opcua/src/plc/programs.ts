// SPDX-License-Identifier: Apache-2.0
// The PLC programs of all boards by the model of OPC 30000: those that `indurop serve --plc` was given and the board
// runs. A plant without them has none of it.

import { DataType, type UAObject, type UAObjectType } from "node-opcua";

import { log, message_of } from "../log";
import { board_path, Refused, type ServeClient } from "../serve/http";
import type { ModuleDescription, PlcDescription, VariableDescription } from "../serve/types";
import { node_at, set_name, set_text } from "../space/set";
import type { BoardTree, Space } from "../space/tree";
import { PlcModel } from "./model";

const US = 1000;

// As IEC 61131-3 writes times.
function time_of(ns: number): string {
  return ns % US === 0 ? `T#${ns / US}us` : `T#${ns}ns`;
}

interface Shown {
  program: UAObject;
  task: UAObject;
}

export class Programs {
  private readonly resources = new Map<string, UAObject>();
  private readonly shown = new Map<string, Shown>();  // by node id of the program
  private model: Promise<PlcModel> | undefined;

  constructor(private readonly client: ServeClient, private readonly space: Space, private readonly version: string) {}

  // The board has these variables now.
  async update(tree: BoardTree, list: VariableDescription[], here: boolean): Promise<void> {
    try {
      const modules = here ? await this.modules_of(tree.board) : [];
      if (modules.length === 0 && !this.resources.has(tree.board)) return;
      this.model ??= PlcModel.load(this.space.address_space, this.space.namespace);
      const model = await this.model;
      this.space.address_space.modelChangeTransaction(() => this.show(model, tree, modules, list));
    } catch (error) {
      log(`${tree.board}: its PLC programs cannot be shown: ${message_of(error)}`);
    }
  }

  private show(model: PlcModel, tree: BoardTree, modules: ModuleDescription[], list: VariableDescription[]): void {
    const resource = this.resources.get(tree.board) ?? this.add_resource(model, tree.board);
    this.resources.set(tree.board, resource);
    for (const [id, { program, task }] of this.shown) {
      if (!id.startsWith(`${tree.board}/plc/`)) continue;
      for (const one of program.findReferences(model.external, true)) program.removeReference(one);
      const name = program.browseName.name!;
      if (modules.some((one) => one.name === name)) continue;
      for (const node of [program, task]) this.space.namespace.deleteNode(node);
      this.shown.delete(id);
    }
    for (const module of modules) {
      const { program, task } = this.program_of(model, tree.board, resource, module);
      node_at(task, "Priority").setValueFromSource({ dataType: DataType.UInt32, value: module.priority });
      const interval = module.operation === "periodic" ? time_of(module.period_ns) : "";
      if (task.getChildByName("Interval")) set_text(task, "Interval", interval);
      for (const { name, writers, readers } of list) {
        const node = /_watch$/.test(name) ? undefined : tree.node_of(name);  // not of the program: made by `--watch`
        if (node && [...(writers ?? []), ...(readers ?? [])].includes(module.name)) {
          program.addReference({ referenceType: model.external, nodeId: node.nodeId });
        }
      }
    }
  }

  private program_of(model: PlcModel, board: string, resource: UAObject, { name, operation }: ModuleDescription): Shown {
    const id = `${board}/plc/${name}`;
    let shown = this.shown.get(id);
    if (!shown) {
      const type_id = `type/${id}`;
      const type = (this.space.namespace.findNode(`s=${type_id}`) as UAObjectType | null) ?? model.add_program_type(type_id, name);
      const optionals = operation === "periodic" ? ["Interval"] : [];
      shown = {
        program: model.add(type, id, name, model.folder(resource, "Programs")),
        task: model.add("CtrlTaskType", `${id}/task`, name, model.folder(resource, "Tasks"), optionals),
      };
      shown.program.addReference({ referenceType: model.with_task, nodeId: shown.task.nodeId });
      this.shown.set(id, shown);
    }
    return shown;
  }

  // What the model demands and the board does not know is an empty text.
  private add_resource(model: PlcModel, board: string): UAObject {
    const configuration = model.add("CtrlConfigurationType", `${board}/plc`, board, model.device_set);
    const resource = model.add("CtrlResourceType", `${board}/plc-resource`, board, model.folder(configuration, "Resources"));
    for (const name of ["Manufacturer", "Model"]) set_name(resource, name, "");
    for (const name of ["SerialNumber", "DeviceManual", "DeviceRevision", "HardwareRevision"]) set_text(resource, name, "");
    set_text(resource, "SoftwareRevision", this.version);
    node_at(resource, "RevisionCounter").setValueFromSource({ dataType: DataType.Int32, value: -1 });
    return resource;
  }

  // The modules of its PLC programs. None if the server was given none, or the board runs none of them.
  private async modules_of(board: string): Promise<ModuleDescription[]> {
    const first = await this.plc_of(board, "");
    if (!first) return [];
    const { modules } = await this.client.get<{ modules: ModuleDescription[] }>(board_path(board, "/modules"));
    const names: string[] = [];
    for (const name of first.programs) {
      if (name === first.program || await this.plc_of(board, `?program=${encodeURIComponent(name)}`)) names.push(name);
    }
    return modules.filter(({ name }) => names.includes(name));
  }

  private async plc_of(board: string, query: string): Promise<PlcDescription | undefined> {
    try {
      return await this.client.get<PlcDescription>(board_path(board, `/plc${query}`));
    } catch (error) {
      if (error instanceof Refused && error.code !== 0) return undefined;
      throw error;
    }
  }
}
