// SPDX-License-Identifier: Apache-2.0
// Monitored items: a variable is followed as long as one watches it or a part of it. Items report changes of samples, or
// every run; none is sampled by a timer of its own.

import {
  AttributeIds, MonitoringMode, StatusCode, StatusCodes, type MonitoredItem, type MonitoringParameters, type OPCUAServer, type ServerSession,
  type Subscription,
} from "node-opcua";

import type { Follow } from "../space/follow";
import type { InnerItem } from "../space/internals";
import type { PartNode, Watched } from "../space/variable";
import type { Every } from "./every";

export interface Finders {
  part(node: string): PartNode | undefined;
  any(node: string): Watched | undefined;  // what is derived from a part, too
}

export class Items {
  private readonly watched = new WeakMap<MonitoredItem, Watched>();
  private readonly period_ms: number;

  constructor(private readonly find: Finders, private readonly follow: Follow, private readonly every: Every, rate_hz: number) {
    this.period_ms = 1000 / rate_hz;
  }

  begin(server: OPCUAServer): void {
    server.on("create_session", (session: ServerSession) => session.on("new_subscription", (subscription: Subscription) => this.attend(subscription)));
  }

  private attend(subscription: Subscription): void {
    const create = subscription.preCreateMonitoredItem.bind(subscription);
    subscription.preCreateMonitoredItem = (space, timestamps, request) => {
      const { nodeId, attributeId } = request.itemToMonitor;
      const node = attributeId === AttributeIds.Value ? nodeId.toString() : "";
      const is_every = this.revise(node, request.requestedParameters, subscription);
      const result = create(space, timestamps, request);
      if (result.monitoredItem && is_every) this.every.add(result.monitoredItem, this.find.part(node)!);
      return result;
    };
    subscription.on("monitoredItem", (item: MonitoredItem) => this.begin_item(item, subscription));
    subscription.on("removeMonitoredItem", (item: MonitoredItem) => this.end_item(item));
  }

  // Returns true if the item reports every run. Else it reports no faster than samples arrive.
  private revise(node: string, parameters: MonitoringParameters, subscription: Subscription, item?: MonitoredItem): boolean {
    const part = this.find.part(node);
    if (part && this.every.accepts(part, parameters, item)) return true;
    if (this.find.any(node)) {
      const { samplingInterval } = parameters;
      parameters.samplingInterval = Math.max(samplingInterval < 0 ? subscription.publishingInterval : samplingInterval, this.period_ms);
    }
    return false;
  }

  private begin_item(item: MonitoredItem, subscription: Subscription): void {
    if (item.itemToMonitor.attributeId !== AttributeIds.Value) return;
    const node = item.node?.nodeId.toString() ?? "";
    const one = this.find.any(node);
    if (!one) return;
    this.watched.set(item, one);
    one.items++;
    one.variable.monitored.add(one);
    this.follow.want(one.variable);
    this.report_changes(item);
    mark_any_status(item);
    const modify = item.modify.bind(item);
    item.modify = (timestamps, parameters) => {
      const is_every = parameters !== null && this.revise(node, parameters, subscription, item);
      const result = modify(timestamps, parameters);
      this.report_changes(item);
      if (parameters !== null) this.change(item, one, is_every);
      return result;
    };
    const set_mode = item.setMonitoringMode.bind(item);
    item.setMonitoringMode = (mode) => {
      const is_begin = item.monitoringMode === MonitoringMode.Invalid || item.monitoringMode === MonitoringMode.Disabled;
      const result = set_mode(mode);
      if (is_begin && mode !== MonitoringMode.Disabled) this.every.begin(item);
      return result;
    };
  }

  private change(item: MonitoredItem, one: Watched, is_every: boolean): void {
    if (is_every) {
      this.every.add(item, one as PartNode);
      return;
    }
    if (this.every.remove(item) && item.monitoringMode !== MonitoringMode.Disabled) item.recordValue(one.variable.value_for(one));
  }

  private end_item(item: MonitoredItem): void {
    this.every.remove(item);
    const one = this.watched.get(item);
    if (one && --one.items === 0) one.variable.monitored.delete(one);
  }

  // The item reports at the rate that was requested, as far as values arrive that often.
  private report_changes(item: MonitoredItem): void {
    const inner = item as unknown as InnerItem;
    inner._exceptionBased = true;
    if (inner.samplingInterval <= this.period_ms) inner.samplingInterval = 0;
  }
}

// node-opcua marks only good values, and throws at others.
function mark_any_status(item: MonitoredItem): void {
  const inner = item as unknown as InnerItem;
  const mark_good = inner._setOverflowBit.bind(item);
  inner._setOverflowBit = (notification) => {
    const { value } = notification;
    const code = value?.statusCode ?? StatusCodes.Good;
    if (value) value.statusCode = StatusCodes.Good;
    mark_good(notification);
    if (value) value.statusCode = StatusCode.makeStatusCode(code, "Overflow | InfoTypeDataValue");
  };
}
