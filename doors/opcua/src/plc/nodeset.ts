// SPDX-License-Identifier: Apache-2.0
// The nodes that OPC 30000 (PLCopen, IEC 61131-3) 1.02 defines, with their ids. No package of npm has them.

import type { AddressSpace, BaseNode, Namespace } from "node-opcua";

export const UA = "http://opcfoundation.org/UA/";
export const DI = "http://opcfoundation.org/UA/DI/";
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

// Name, id, supertype.
const DATA_TYPES: [string, number, string][] = [
  ["BYTE", 3001, "Byte"], ["WORD", 3002, "UInt16"], ["DWORD", 3003, "UInt32"], ["LWORD", 3004, "UInt64"],
  ["TIME", 3005, "Int64"], ["LTIME", 3006, "Int64"], ["DATE", 3007, "DateTime"], ["TOD", 3008, "UInt32"],
  ["LTOD", 3009, "Int64"], ["DT", 3010, "DateTime"], ["CHAR", 3011, "Byte"], ["WCHAR", 3012, "UInt16"],
  ["STRING", 3013, "String"], ["LDATE", 3014, "Int64"], ["LDT", 3015, "Int64"],
];

// Name, id, supertype with the prefix of its namespace, abstract.
const TYPES: [string, number, string, boolean][] = [
  ["CtrlConfigurationType", 1001, "di:TopologyElementType", false],
  ["CtrlResourceType", 1002, "di:DeviceType", false],
  ["CtrlProgramOrganizationUnitType", 1003, "di:BlockType", true],
  ["CtrlProgramType", 1004, "plc:CtrlProgramOrganizationUnitType", true],
  ["CtrlFunctionBlockType", 1005, "plc:CtrlProgramOrganizationUnitType", true],
  ["CtrlTaskType", 1006, "BaseObjectType", false],
  ["SFCType", 1007, "BaseObjectType", false],
];

const CONTAINER = "di:ConfigurableObjectType";
const GROUP = "di:FunctionalGroupType";
const OBJECT = "BaseObjectType";
const VARIABLE = "BaseDataVariableType";
const PROPERTY = "PropertyType";
const PART = "HasComponent";
const MANDATORY = "Mandatory";
const OPTIONAL = "Optional";
const PLACEHOLDER = "OptionalPlaceholder";
const NAMESPACES = -1;  // the object of the standard that has all namespaces
const NAMESPACES_ID = "ns=0;i=11715";

interface Node {
  id: number;
  name: string;  // with the prefix of its namespace
  of?: [number, string];  // the node above it, and the type of the reference from there
  type?: string;  // of objects and variables
  rule?: string;
  data?: string;  // of variables
  rank?: number;
  access?: string;
  value?: unknown;  // of a property
}

const object = (id: number, name: string, of: [number, string], type: string, rule: string): Node => ({ id, name, of, type, rule });
const value = (id: number, name: string, of: Node["of"], data: string, rule?: string, type = VARIABLE): Node => ({ id, name, of, type, rule, data });
const method = (id: number, name: string, of: number): Node => ({ id, name, of: [of, PART], rule: OPTIONAL });
const words = (id: number, name: string, of: number): Node => ({ ...value(id, name, [of, "HasProperty"], "Argument", MANDATORY, PROPERTY), rank: 1 });
const variable = (id: number, name: string, reference: string): Node => (
  { ...value(id, name, [1003, reference], "BaseDataType", PLACEHOLDER), access: "CurrentRead | CurrentWrite" });
const property = (id: number, name: string, of: number, data: string, rule: string): Node => value(id, name, [of, "HasProperty"], data, rule, PROPERTY);
const about = (id: number, name: string, data: string, value?: unknown, rank = -1): Node => (
  { id, name, of: [15001, "HasProperty"], type: PROPERTY, data, rank, value });
const keyword = (id: number, name: string, data: string, rank = -1): Node => ({ ...value(id, name, undefined, data, undefined, PROPERTY), rank });

const NODES: Node[] = [
  // A configuration.
  object(5001, "di:ParameterSet", [1001, PART], OBJECT, OPTIONAL),
  value(1037, "di:<ParameterIdentifier>", [5001, PART], "BaseDataType", "MandatoryPlaceholder"),
  object(5002, "di:MethodSet", [1001, PART], OBJECT, OPTIONAL),
  method(7001, "plc:Start", 5002), words(1031, "InputArguments", 7001), words(1032, "OutputArguments", 7001),
  method(7002, "plc:Stop", 5002), words(1034, "InputArguments", 7002), words(1035, "OutputArguments", 7002),
  object(5003, "di:Identification", [1001, PART], GROUP, OPTIONAL),
  object(5004, "plc:Resources", [1001, PART], CONTAINER, MANDATORY),
  object(5005, "di:<ResourceName>", [5004, PART], "plc:CtrlResourceType", PLACEHOLDER),
  object(5006, "plc:GlobalVars", [1001, PART], GROUP, OPTIONAL),
  object(5007, "plc:AccessVars", [1001, PART], GROUP, OPTIONAL),
  object(5008, "plc:ConfigVars", [1001, PART], GROUP, OPTIONAL),
  object(5009, "plc:Configuration", [1001, PART], GROUP, OPTIONAL),
  object(5010, "plc:Status", [1001, PART], GROUP, OPTIONAL),
  // A resource.
  object(5012, "plc:MethodSet", [1002, PART], OBJECT, OPTIONAL), method(7003, "plc:Start", 5012), method(7004, "plc:Stop", 5012),
  object(5014, "plc:Tasks", [1002, PART], CONTAINER, MANDATORY),
  object(5015, "di:<TaskName>", [5014, PART], "plc:CtrlTaskType", PLACEHOLDER),
  object(5016, "plc:Programs", [1002, PART], CONTAINER, MANDATORY),
  object(5017, "di:<ProgramName>", [5016, PART], "plc:CtrlProgramType", PLACEHOLDER),
  object(5018, "plc:GlobalVars", [1002, PART], GROUP, OPTIONAL),
  object(5019, "plc:Configuration", [1002, PART], GROUP, OPTIONAL),
  object(5020, "plc:Status", [1002, PART], GROUP, OPTIONAL),
  // Programs and function blocks.
  object(1008, "plc:<TaskName>", [1003, "plc:With"], "plc:CtrlTaskType", PLACEHOLDER),
  variable(1011, "plc:<VarInOutName>", "plc:HasInOutVar"),
  variable(1012, "plc:<VarInputName>", "plc:HasInputVar"),
  variable(1013, "plc:<VarOutputName>", "plc:HasOutputVar"),
  variable(1014, "plc:<VarLocalName>", "plc:HasLocalVar"),
  variable(1015, "plc:<VarExternalName>", "plc:HasExternalVar"),
  object(1016, "plc:<BlockName>", [1003, "plc:HasLocalVar"], "plc:CtrlFunctionBlockType", PLACEHOLDER),
  object(1018, "plc:<SFCName>", [1003, PART], "plc:SFCType", PLACEHOLDER),
  property(1019, "plc:Priority", 1018, "UInt32", MANDATORY),
  value(6001, "plc:Body", [1003, PART], "XmlElement", OPTIONAL),
  value(6002, "plc:Program", [1004, PART], "Structure", OPTIONAL),
  value(6003, "plc:FunctionBlock", [1005, PART], "BaseDataType", OPTIONAL),
  object(1020, "plc:<FunctionBlockInputName>", [1005, "plc:HasInputVar"], "plc:CtrlFunctionBlockType", PLACEHOLDER),
  object(1021, "plc:<FunctionBlockOutputName>", [1005, "plc:HasOutputVar"], "plc:CtrlFunctionBlockType", PLACEHOLDER),
  object(1022, "plc:<FunctionBlockInOutName>", [1005, "plc:HasInOutVar"], "plc:CtrlFunctionBlockType", PLACEHOLDER),
  // A task.
  property(6004, "plc:Priority", 1006, "UInt32", MANDATORY),
  property(6005, "plc:Interval", 1006, "String", OPTIONAL),
  property(6006, "plc:Single", 1006, "String", OPTIONAL),
  // What variables may have.
  keyword(3400, "plc:SubrangeMin", "Number"), keyword(3401, "plc:SubrangeMax", "Number"), keyword(3402, "plc:Dimensions", "UInt32"),
  keyword(3403, "plc:IndexMin", "Int32", 1), keyword(3404, "plc:IndexMax", "Int32", 1), keyword(3405, "plc:RETAIN", "Boolean"),
  keyword(3406, "plc:NON_RETAIN", "Boolean"), keyword(3407, "plc:CONSTANT", "Boolean"), keyword(3408, "plc:AT", "String"),
  // The namespace.
  { id: 15001, name: `plc:${PLCOPEN}`, of: [NAMESPACES, PART], type: "NamespaceMetadataType" },
  about(15002, "NamespaceUri", "String", PLCOPEN), about(15003, "NamespaceVersion", "String", "1.02"),
  about(15004, "NamespacePublicationDate", "DateTime", new Date(Date.UTC(2020, 10, 25))), about(15005, "IsNamespaceSubset", "Boolean", false),
  about(15006, "StaticNodeIdTypes", "IdType", [0], 1), about(15007, "StaticNumericNodeIdRange", "NumericRange", "1:65535"),
  about(15008, "StaticStringNodeIdPattern", "String", ""), about(15031, "DefaultRolePermissions", "RolePermissionType", undefined, 1),
  about(15032, "DefaultUserRolePermissions", "RolePermissionType", undefined, 1), about(15033, "DefaultAccessRestrictions", "UInt16"),
];

// Built-in types of values of other types.
const BASE: Record<string, string> = { IdType: "Int32", NumericRange: "String" };

// Adds them to the address space, which has those of DI.
export function add_plcopen(space: AddressSpace, standard: Namespace): void {
  const index_of = (prefix: string): number => space.getNamespaceIndex(prefix === "plc" ? PLCOPEN : prefix === "di" ? DI : UA);
  const split = (name: string): [string, number] => {
    const [, prefix, rest] = /^(?:(plc|di):)?(.*)$/.exec(name)!;
    return [rest, index_of(prefix ?? "")];
  };
  const object_type = (name: string) => space.findObjectType(...split(name))!;
  for (const [browseName, inverseName, id, subtypeOf] of REFERENCES) {
    standard.addReferenceType({ browseName, inverseName, nodeId: `i=${id}`, subtypeOf } as any);
  }
  for (const [browseName, id, subtypeOf] of DATA_TYPES) {
    standard.createDataType({ browseName, nodeId: `i=${id}`, subtypeOf, isAbstract: false } as any);
  }
  for (const [browseName, id, supertype, isAbstract] of TYPES) {
    standard.addObjectType({ browseName, nodeId: `i=${id}`, isAbstract, subtypeOf: object_type(supertype) });
  }
  const below = (id: number): BaseNode => space.findNode(id === NAMESPACES ? NAMESPACES_ID : `ns=${standard.index};i=${id}`)!;
  for (const { id, name, of, type, rule, data, rank, access, value: content } of NODES) {
    const [text, namespaceIndex] = split(name);
    const node = { browseName: { name: text, namespaceIndex }, nodeId: `i=${id}`, modellingRule: rule };
    const references = of ? [{ referenceType: reference_in(space, split(of[1])), isForward: false, nodeId: below(of[0]).nodeId }] : [];
    if (data) {
      standard.addVariable({
        ...node, references, typeDefinition: space.findVariableType(type!)!, dataType: data, valueRank: rank ?? -1, accessLevel: access ?? "CurrentRead",
        ...(content === undefined ? {} : { value: { dataType: BASE[data] ?? data, arrayType: Array.isArray(content) ? "Array" : "Scalar", value: content } }),
      } as any);
    } else if (type) {
      standard.addObject({ ...node, references, typeDefinition: object_type(type) } as any);
    } else {
      standard.addMethod(below(of![0]) as any, node as any);
    }
  }
}

function reference_in(space: AddressSpace, [name, namespace]: [string, number]) {
  return space.findReferenceType(name, namespace)!.nodeId;
}
