// SPDX-License-Identifier: Apache-2.0
// Alarms of the boards as conditions of OPC 10000-9. Their states are those of `indurop serve`; acknowledging is a request
// there, with the token of the session's user.

import { StatusCodes, type ISessionContext, type LocalizedText, type StatusCode, type UAAlarmConditionEx, type UAMethod, type UAObject, type UAObjectType, type Variant } from "node-opcua";

import { log, message_of } from "../log";
import { board_path, Refused, status, type ServeClient } from "../serve/http";
import type { Alarm } from "../serve/types";
import type { Boards } from "../space/boards";
import type { BoardTree, Space } from "../space/tree";
import { code_of } from "./write";
import type { Users } from "./users";

const SEVERITY = { critical: 1000, high: 800, medium: 500, low: 200 };
const POLL_MS = 5000;  // the stream does not report alarms of boards of other hosts
const HANDLED_AT_SERVE = ["AddComment", "Enable", "Disable", "Confirm"];

interface Condition {
  node: UAAlarmConditionEx;
  board: string;
  alarm: string;
  reported: string;  // the state that clients know
}

export class Alarms {
  private readonly conditions = new Map<string, Condition>();  // by node id
  private readonly reading = new Set<string>();
  private readonly again = new Set<string>();
  private polling: NodeJS.Timeout | undefined;

  constructor(private readonly client: ServeClient, private readonly users: Users, private readonly boards: Boards, private readonly space: Space) {
    space.address_space.installAlarmsAndConditionsService();
    boards.on_alarms = (board) => void this.read(board);
    boards.on_update = (tree) => this.read(tree.board);
    space.address_space.addMethodCallInterceptor((context, object, method, words) => this.before_call(context, object, method, words));
  }

  begin(): void {
    this.polling = setInterval(() => { for (const board of this.boards.trees.keys()) void this.read(board); }, POLL_MS);
  }

  stop(): void {
    clearInterval(this.polling);
  }

  private async read(board: string): Promise<void> {
    if (this.reading.has(board)) {
      this.again.add(board);
      return;
    }
    this.reading.add(board);
    try {
      const { alarms } = await this.client.get<{ alarms: Alarm[] }>(board_path(board, "/alarms?all=true"));
      const tree = this.boards.trees.get(board);
      if (tree) this.update(tree, alarms);
    } catch (error) {
      if (!(error instanceof Refused)) log(`${board}: its alarms cannot be shown: ${message_of(error)}`);
    } finally {
      this.reading.delete(board);
      if (this.again.delete(board)) void this.read(board);
    }
  }

  private update(tree: BoardTree, alarms: Alarm[]): void {
    const listed = new Set<string>();
    for (const alarm of alarms) {
      const id = `ns=${this.space.namespace.index};s=${tree.board}/alarms/${alarm.alarm}`;
      listed.add(id);
      let condition = this.conditions.get(id);
      if (!condition) {
        condition = { node: this.make(tree, alarm, id), board: tree.board, alarm: alarm.alarm, reported: "normal" };
        this.conditions.set(id, condition);
      }
      this.tell(condition, alarm);
    }
    for (const [id, condition] of this.conditions) {
      if (condition.board !== tree.board || listed.has(id)) continue;
      this.tell(condition, { alarm: condition.alarm, name: "", text: "the alarm is not declared any more", priority: "low", condition: "", state: "normal" });
      this.conditions.delete(id);
      this.space.namespace.deleteNode(condition.node);
    }
  }

  private make(tree: BoardTree, alarm: Alarm, id: string): UAAlarmConditionEx {
    const source = tree.node_of(alarm.name);
    const node = this.space.namespace.instantiateAlarmCondition("AlarmConditionType", {
      browseName: alarm.alarm,
      nodeId: id,
      componentOf: tree.folder,
      conditionSource: tree.folder,
      conditionName: alarm.alarm,
      inputNode: source ?? tree.folder.nodeId,
    } as any) as unknown as UAAlarmConditionEx;
    node.sourceName.setValueFromSource({ dataType: "String", value: tree.board } as any);
    node.currentBranch().setActiveState(false);
    node.currentBranch().setAckedState(true);
    return node;
  }

  private tell(condition: Condition, alarm: Alarm): void {
    if (condition.reported === alarm.state) return;
    condition.reported = alarm.state;
    const { node } = condition;
    const branch = node.currentBranch();
    const active = alarm.state === "unacknowledged" || alarm.state === "acknowledged";
    const acknowledged = alarm.state !== "unacknowledged" && alarm.state !== "returned";
    branch.setActiveState(active);
    if (branch.getAckedState() !== acknowledged) branch.setAckedState(acknowledged);
    node.suppressedOrShelved.setValueFromSource({ dataType: "Boolean", value: alarm.state === "shelved" } as any);
    if (alarm.reason) branch.setComment(alarm.reason);
    if (alarm.who) branch.setClientUserId(alarm.who);
    node.raiseNewCondition({
      message: [alarm.text || alarm.alarm, alarm.value ? `(${alarm.value})` : ""].filter(Boolean).join(" "),
      severity: SEVERITY[alarm.priority],
      quality: StatusCodes.Good,
      retain: alarm.state !== "normal" && alarm.state !== "shelved",
    });
  }

  // Good: node-opcua goes on with the call.
  private async before_call(context: ISessionContext, object: UAObject | UAObjectType | null, method: UAMethod, words: Variant[]): Promise<StatusCode> {
    const condition = object && this.conditions.get(object.nodeId.toString());
    const name = method.browseName.name ?? "";
    if (!condition) return StatusCodes.Good;
    if (HANDLED_AT_SERVE.includes(name)) return StatusCodes.BadNotSupported;
    if (name !== "Acknowledge") return StatusCodes.Good;
    return this.acknowledge(context, condition, words);
  }

  private async acknowledge(context: ISessionContext, condition: Condition, words: Variant[]): Promise<StatusCode> {
    const who = this.users.name_of(context.session);
    try {
      const token = this.users.token_of(context.session);
      if (token === undefined) throw new Refused(status.forbidden, "sign in with a name and a password to acknowledge alarms");
      const event = words[0]?.value as Buffer | null;
      if (event && !condition.node.findBranchForEventId(event)) return StatusCodes.BadEventIdUnknown;
      if (condition.node.currentBranch().getAckedState()) return StatusCodes.BadConditionBranchAlreadyAcked;
      const reason = (words[1]?.value as LocalizedText | null)?.text ?? "";
      await this.client.post(board_path(condition.board, "/alarms/ack"), { alarms: [condition.alarm], reason }, token);
      condition.node.currentBranch().setClientUserId(who);
      condition.reported = condition.reported === "returned" ? "normal" : "acknowledged";
      return StatusCodes.Good;
    } catch (error) {
      log(`${condition.board}: ${who} may not acknowledge ${condition.alarm}: ${message_of(error)}`);
      return code_of(error);
    }
  }
}
