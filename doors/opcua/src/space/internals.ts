// SPDX-License-Identifier: Apache-2.0
// What is used of node-opcua beyond its documented interface. Its version is fixed in package-lock.json; an update begins here.

import type { DataValue, HistoryReadDetails, HistoryReadResult, NumericRange, SessionContext, StatusCode, UAVariable } from "node-opcua";

export interface InnerVariable extends UAVariable {
  // Called for a value that is read now, by Read and for the first value of a monitored item.
  refreshFunc?: (this: UAVariable, done: (error: Error | null, value: DataValue) => void) => void;
  // Called for Write, after session and node were found.
  writeAttribute: any;
  // Called for HistoryRead, after the node was found.
  _historyRead: any;
  // The newest value. Monitored items learn another one by the event "value_changed"; node-opcua's own way would also
  // touch the parts of a structure, which have events of their own here.
  $dataValue: DataValue;
  _basicDataType: unknown;  // remembered from dataType
}

export interface WriteRequest {
  attributeId: number;
  indexRange: NumericRange;
  value: DataValue;
}

export type WriteAttribute = (this: UAVariable, context: SessionContext, request: WriteRequest,
  done: (error: Error | null, code: StatusCode) => void) => void;

export type HistoryRead = (this: UAVariable, context: SessionContext, details: HistoryReadDetails, range: NumericRange, encoding: unknown,
  continuation: { continuationPoint?: Buffer; releaseContinuationPoints?: boolean }, done: (error: Error | null, result: HistoryReadResult) => void) => void;

export interface InnerItem {
  // The item reports changes, at most once in samplingInterval, and has no timer that samples.
  _exceptionBased: boolean;
  samplingInterval: number;
  // Marks a notification: others that would follow or precede it were discarded.
  _setOverflowBit(notification: { value?: DataValue }): void;
}

// Replaces a node's value and passes it to the monitored items.
export function put_value(node: InnerVariable, value: DataValue): void {
  node.$dataValue = value;
  node.emit("value_changed", value.clone());
}
