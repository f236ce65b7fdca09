// SPDX-License-Identifier: Apache-2.0
// The types of OPC 30000 (PLCopen, IEC 61131-3), with DI, which it requires. No package of npm has them, so those that
// programs need are stated here, with the ids of the standard.

import type { AddressSpace, Namespace, UAObject, UAObjectType } from "node-opcua";

import { load_nodesets } from "../space/nodesets";

const DI = "http://opcfoundation.org/UA/DI/";
export const PLCOPEN = "http://PLCopen.org/OpcUa/IEC61131-3/";

// Name, inverse name, id, supertype.
const REFERENCES: [string, string, number, string][] = [
  ["HasInputVar", "InputVarOf", 4001, "HasComponent"],
  ["HasOutputVar", "OutputVarOf", 4002, "HasComponent"],
  ["HasInOutVar", "InOutVarOf", 4003, "HasComponent"],
  ["HasLocalVar", "LocalVarOf", 4004, "HasComponent"],
  ["HasExternalVar", "ExternalVarOf", 4005, "Organizes"],
  ["With", "Executes", 4006, "NonHierarchicalReferences"],
];

// Name, id, supertype, namespace of the supertype ("": this one), abstract.
const TYPES: [string, number, string, string, boolean][] = [
  ["CtrlConfigurationType", 1001, "TopologyElementType", DI, false],
  ["CtrlResourceType", 1002, "DeviceType", DI, false],
  ["CtrlProgramOrganizationUnitType", 1003, "BlockType", DI, true],
  ["CtrlProgramType", 1004, "CtrlProgramOrganizationUnitType", "", true],
  ["CtrlTaskType", 1006, "BaseObjectType", "http://opcfoundation.org/UA/", false],
];

// Mandatory folders of objects, and what is in them: type, id, name, then id, name and type of the placeholder.
const FOLDERS: [string, number, string, number, string, string][] = [
  ["CtrlConfigurationType", 5004, "Resources", 5005, "<ResourceName>", "CtrlResourceType"],
  ["CtrlResourceType", 5014, "Tasks", 5015, "<TaskName>", "CtrlTaskType"],
  ["CtrlResourceType", 5016, "Programs", 5017, "<ProgramName>", "CtrlProgramType"],
];

const TASK_PROPERTIES: [string, number, string, "Mandatory" | "Optional"][] = [
  ["Priority", 6004, "UInt32", "Mandatory"],
  ["Interval", 6005, "String", "Optional"],
  ["Single", 6006, "String", "Optional"],
];

export class PlcModel {
  readonly device_set: UAObject;
  readonly external: string;  // id of HasExternalVar
  readonly with_task: string;

  private constructor(private readonly space: AddressSpace, private readonly namespace: Namespace, private readonly standard: Namespace) {
    this.device_set = space.rootFolder.objects.getFolderElementByName("DeviceSet", space.getNamespaceIndex(DI)) as UAObject;
    this.external = `ns=${standard.index};i=4005`;
    this.with_task = `ns=${standard.index};i=4006`;
  }

  static async load(space: AddressSpace, namespace: Namespace): Promise<PlcModel> {
    await load_nodesets(space, ["Opc.Ua.Di.NodeSet2"]);
    const model = new PlcModel(space, namespace, space.registerNamespace(PLCOPEN));
    model.define();
    return model;
  }

  // An object with what its type demands.
  add(type: UAObjectType | string, id: string, name: string, parent: UAObject, optionals: string[] = []): UAObject {
    const definition = typeof type === "string" ? this.type(type) : type;
    return definition.instantiate({
      namespace: this.namespace, browseName: { name, namespaceIndex: this.namespace.index }, nodeId: `s=${id}`, componentOf: parent, optionals,
    }) as UAObject;
  }

  // A folder of an object, with what DI demands of it: the declaration in the standard leaves that to the folder's type.
  folder(owner: UAObject, name: string): UAObject {
    const folder = owner.getChildByName(name) as UAObject;
    const di = this.space.getNamespaceIndex(DI);
    if (!folder.getChildByName("SupportedTypes")) {
      this.namespace.addObject({
        browseName: { name: "SupportedTypes", namespaceIndex: di }, nodeId: `${folder.nodeId.toString().replace(/^ns=\d+;/, "")}-SupportedTypes`,
        componentOf: folder, typeDefinition: "FolderType",
      });
    }
    return folder;
  }

  // Programs are instances of types of their own: CtrlProgramType is abstract.
  add_program_type(id: string, name: string): UAObjectType {
    return this.namespace.addObjectType({ browseName: name, nodeId: `s=${id}`, subtypeOf: this.type("CtrlProgramType") });
  }

  private type(name: string): UAObjectType {
    return this.space.findObjectType(name, this.standard.index)!;
  }

  private define(): void {
    for (const [browseName, inverseName, id, subtypeOf] of REFERENCES) {
      this.standard.addReferenceType({ browseName, inverseName, nodeId: `i=${id}`, subtypeOf } as any);
    }
    for (const [browseName, id, supertype, uri, isAbstract] of TYPES) {
      const index = uri === "" ? this.standard.index : this.space.getNamespaceIndex(uri);
      this.standard.addObjectType({ browseName, nodeId: `i=${id}`, isAbstract, subtypeOf: this.space.findObjectType(supertype, index)! });
    }
    for (const [name, id, dataType, modellingRule] of TASK_PROPERTIES) {
      this.standard.addVariable({ browseName: name, nodeId: `i=${id}`, propertyOf: this.type("CtrlTaskType"), dataType, modellingRule });
    }
    const di = this.space.getNamespaceIndex(DI);
    const container = this.space.findObjectType("ConfigurableObjectType", di)!;
    for (const [owner, id, name, inner, inner_name, inner_type] of FOLDERS) {
      const folder = this.standard.addObject({
        browseName: name, nodeId: `i=${id}`, componentOf: this.type(owner), typeDefinition: container, modellingRule: "Mandatory",
      });
      this.standard.addObject({
        browseName: { name: inner_name, namespaceIndex: di }, nodeId: `i=${inner}`, componentOf: folder,
        typeDefinition: this.type(inner_type), modellingRule: "OptionalPlaceholder",
      });
    }
  }
}
