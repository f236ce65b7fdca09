// SPDX-License-Identifier: Apache-2.0
// Values of nodes that do not change with the board's variables.

import { DataType, LocalizedText, type BaseNode, type UAVariable } from "node-opcua";

import { unit_of } from "../model/units";

// The node of a path of names, "ParameterSet/ActualPosition".
export function node_at(from: BaseNode, path: string): UAVariable {
  return path.split("/").reduce((node: BaseNode, name) => node.getChildByName(name)!, from) as UAVariable;
}

export function set_text(from: BaseNode, path: string, value: string): void {
  node_at(from, path).setValueFromSource({ dataType: DataType.String, value });
}

export function set_name(from: BaseNode, path: string, value: string): void {
  node_at(from, path).setValueFromSource({ dataType: DataType.LocalizedText, value: new LocalizedText({ text: value }) });
}

export function set_number(from: BaseNode, path: string, value: number): void {
  node_at(from, path).setValueFromSource({ dataType: DataType.Int32, value });
}

export function set_unsigned(from: BaseNode, path: string, value: number): void {
  node_at(from, path).setValueFromSource({ dataType: DataType.UInt32, value });
}

export function set_unit(from: BaseNode, path: string, unit: string): void {
  node_at(from, `${path}/EngineeringUnits`).setValueFromSource({ dataType: DataType.ExtensionObject, value: unit_of(unit) });
}
