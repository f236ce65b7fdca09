// SPDX-License-Identifier: Apache-2.0
// Monitored items: a variable is followed as long as one watches it or a part of it. Items report changes; none is
// sampled by a timer of its own.

import { AttributeIds, type MonitoredItem, type OPCUAServer, type ServerSession, type Subscription } from "node-opcua";

import type { Follow } from "../space/follow";
import type { InnerItem } from "../space/internals";
import type { Watched } from "../space/variable";

export function watch_items(server: OPCUAServer, find: (node: string) => Watched | undefined, follow: Follow, rate_hz: number): void {
  const watched = new WeakMap<MonitoredItem, Watched>();

  // The item reports at the rate that was requested, as far as values arrive that often.
  const report_changes = (item: MonitoredItem): void => {
    const inner = item as unknown as InnerItem;
    inner._exceptionBased = true;
    if (inner.samplingInterval <= 1000 / rate_hz) inner.samplingInterval = 0;
  };
  const begin = (item: MonitoredItem): void => {
    if (item.itemToMonitor.attributeId !== AttributeIds.Value) return;
    const one = find(item.node?.nodeId.toString() ?? "");
    if (!one) return;
    watched.set(item, one);
    one.items++;
    one.variable.monitored.add(one);
    follow.want(one.variable);
    report_changes(item);
    const modify = item.modify.bind(item);
    item.modify = (...words) => {
      const result = modify(...words);
      report_changes(item);
      return result;
    };
  };
  const end = (item: MonitoredItem): void => {
    const one = watched.get(item);
    if (one && --one.items === 0) one.variable.monitored.delete(one);
  };
  server.on("create_session", (session: ServerSession) => {
    session.on("new_subscription", (subscription: Subscription) => {
      subscription.on("monitoredItem", begin);
      subscription.on("removeMonitoredItem", end);
    });
  });
}
