// SPDX-License-Identifier: Apache-2.0
// The types of OPC 30000 (PLCopen, IEC 61131-3), with DI, which it requires. They are loaded for the first program.

import type { AddressSpace, BaseNode, Namespace, NodeId, UAObject, UAObjectType } from "node-opcua";

import { load_nodesets } from "../space/nodesets";
import type { PlcVariable } from "../serve/types";
import { add_plcopen, DI, PLCOPEN } from "./nodeset";

// Types of OPC 30000 for elementary types of the compiler, whose times count nanoseconds in 64 bits.
const DATA_TYPES: Record<string, string> = {
  BYTE: "BYTE", WORD: "WORD", DWORD: "DWORD", LWORD: "LWORD", TIME: "LTIME", DATE: "LDATE", TIME_OF_DAY: "LTOD", DATE_AND_TIME: "LDT",
  CHAR: "CHAR", WCHAR: "WCHAR", STRING: "STRING",
};

const SECTIONS: Record<PlcVariable["section"], string> = {
  input: "HasInputVar", output: "HasOutputVar", in_out: "HasInOutVar", local: "HasLocalVar", external: "HasExternalVar",
};

export class PlcModel {
  readonly device_set: UAObject;
  readonly catalogue: UAObject;  // of the types of function blocks and programs
  readonly index: number;

  private constructor(private readonly space: AddressSpace, private readonly namespace: Namespace, standard: Namespace) {
    this.index = standard.index;
    this.device_set = space.rootFolder.objects.getFolderElementByName("DeviceSet", space.getNamespaceIndex(DI)) as UAObject;
    this.catalogue = namespace.addObject({
      browseName: { name: "CtrlTypes", namespaceIndex: this.index }, nodeId: "s=type/plc", organizedBy: space.findNode("i=88")!, typeDefinition: "FolderType",
    });
  }

  static async load(space: AddressSpace, namespace: Namespace): Promise<PlcModel> {
    await load_nodesets(space, ["Opc.Ua.Di.NodeSet2"]);
    const standard = space.registerNamespace(PLCOPEN);
    add_plcopen(space, standard);
    return new PlcModel(space, namespace, standard);
  }

  // An object with what its type demands.
  add(type: string, id: string, name: string, parent: UAObject, optionals: string[] = []): UAObject {
    return this.type(type).instantiate({
      namespace: this.namespace, browseName: { name, namespaceIndex: this.namespace.index }, nodeId: `s=${id}`, componentOf: parent, optionals,
    }) as UAObject;
  }

  // A folder of an object, with what DI demands of it: the declaration in the standard leaves that to the folder's type.
  folder(owner: UAObject, name: string): UAObject {
    const folder = owner.getChildByName(name) as UAObject;
    const di = this.space.getNamespaceIndex(DI);
    if (!folder.getChildByName("SupportedTypes")) {
      this.namespace.addObject({
        browseName: { name: "SupportedTypes", namespaceIndex: di }, nodeId: `${text_of(folder)}-SupportedTypes`, componentOf: folder, typeDefinition: "FolderType",
      });
    }
    return folder;
  }

  has_type(name: string, { index }: Namespace): boolean {
    return this.space.findObjectType(name, index) !== null;
  }

  type(name: string): UAObjectType {
    return this.space.findObjectType(name, this.index)!;
  }

  reference(name: string): NodeId {
    return this.space.findReferenceType(name, this.index)!.nodeId;
  }

  section(section: PlcVariable["section"]): NodeId {
    return this.reference(SECTIONS[section]);
  }

  // Nothing for types that are as those of OPC UA.
  data_type = (iec: string): NodeId | undefined => {
    const name = DATA_TYPES[iec];
    return name ? this.space.findDataType(name, this.index)!.nodeId : undefined;
  };
}

// The id of a node without its namespace.
export function text_of(node: BaseNode): string {
  return node.nodeId.toString().replace(/^ns=\d+;/, "");
}
