// SPDX-License-Identifier: Apache-2.0
// Alarms of a board, those that need action first, with their buttons; below them the history and messages of modules.

import { useEffect, useState } from "preact/hooks";
import { board_path, get, message_of, post } from "../../api/http";
import type { Alarm, AlarmEvent, Alarms as All, Message } from "../../api/types";
import { NoBoard } from "../../shell/no_board";
import { useBoard, useMay } from "../../shell/plant";
import { address } from "../../ui/address";
import { clock, plural, span } from "../../ui/format";
import { DataTable, Name, Panel, Waiting } from "../../ui/parts";
import { useRequest } from "../../ui/store";

const PURPOSE = "This view lists conditions that an operator has to act on, until they are acknowledged.";
const EVERY_MS = 5000;  // in addition to changes, which the stream reports at once
const HOUR_NS = 3600e9;
const SHELVE_FOR: [string, number][] = [["1 hour", HOUR_NS], ["8 hours", 8 * HOUR_NS], ["1 day", 24 * HOUR_NS], ["1 week", 168 * HOUR_NS]];
const STATES = { normal: "normal", unacknowledged: "active, not acknowledged", acknowledged: "active, acknowledged",
  returned: "cleared, not acknowledged", shelved: "shelved" };

type Act = (act: "ack" | "shelve" | "unshelve", body: object) => void;

function Actions({ alarm, for_ns, act }: { alarm: Alarm; for_ns: number; act: Act }) {
  const may_shelve = useMay("tune");
  const alarms = [alarm.alarm];
  const needs = alarm.state === "unacknowledged" || alarm.state === "returned";
  return (
    <span class="actions">
      {needs && <button type="button" class="main" aria-label={`Acknowledge ${alarm.alarm}`} onClick={() => act("ack", { alarms })}>acknowledge</button>}
      {may_shelve && (alarm.state === "shelved"
        ? <button type="button" aria-label={`Unshelve ${alarm.alarm}`} onClick={() => act("unshelve", { alarms })}>unshelve</button>
        : <button type="button" aria-label={`Shelve ${alarm.alarm}`} onClick={() => act("shelve", { alarms, for_ns })}>shelve</button>)}
    </span>);
}

function AlarmState({ alarm }: { alarm: Alarm }) {
  const { state, who, reason, until_wall_ns } = alarm;
  const by = who ? `by ${who}${reason ? `: ${reason}` : ""}` : "";
  return <>{STATES[state]}{state === "shelved" && until_wall_ns ? ` until ${clock(until_wall_ns)}` : ""}{by && <small>{by}</small>}</>;
}

function List({ board, alarms, for_ns, act }: { board: string; alarms: Alarm[]; for_ns: number; act: Act | null }) {
  return (
    <DataTable label="Alarms" more="alarms">
      <thead>
        <tr><th scope="col">Priority</th><th scope="col">Alarm</th><th scope="col">State</th><th scope="col">Since</th>
          <th scope="col">Value</th><th scope="col" class="number">Raised</th>{act && <th scope="col">Actions</th>}</tr>
      </thead>
      <tbody>
        {alarms.map((alarm) => (
          <tr key={alarm.alarm} class={alarm.state === "normal" || alarm.state === "shelved" ? "is-quiet" : ""}>
            <td class="how"><span class={`priority ${alarm.priority}`}>{alarm.priority}</span></td>
            <th scope="row" class="what message">{alarm.text}
              <small>{alarm.name ? <a href={address("variables", { board, v: alarm.name })}><Name text={alarm.alarm} /></a> : <Name text={alarm.alarm} />}
                {alarm.unit && ` ${alarm.unit}`}{alarm.delay_ns > 0 && `, after ${span(alarm.delay_ns)}`}</small></th>
            <td class="what wide"><AlarmState alarm={alarm} /></td>
            <td class="when">{alarm.since_wall_ns ? clock(alarm.since_wall_ns) : "-"}</td>
            <td>{alarm.value || "-"}</td>
            <td class="number">{plural(alarm.count, "time")}</td>
            {act && <td class="wide"><Actions alarm={alarm} for_ns={for_ns} act={act} /></td>}
          </tr>))}
      </tbody>
    </DataTable>);
}

function History({ board, revision }: { board: string; revision: string }) {
  const { value, error, refresh } = useRequest(board, EVERY_MS, () => get<{ events: AlarmEvent[] }>(board_path(board, "/alarms/history?count=200")));
  useEffect(refresh, [revision]);
  if (error) return <p class="bad">{error}</p>;
  if (!value) return <Waiting />;
  if (value.events.length === 0) return <p class="quiet">There are no events yet.</p>;
  return (
    <DataTable label="Events" more="events">
        <thead><tr><th scope="col">Time</th><th scope="col">Event</th><th scope="col">Alarm</th><th scope="col">Value</th><th scope="col">User and reason</th></tr></thead>
        <tbody>
          {[...value.events].reverse().map((one, i) => (
            <tr key={`${one.wall_ns} ${i}`}>
              <td>{clock(one.wall_ns)}</td><td class={one.event === "raised" ? "bad" : ""}>{one.event}</td>
              <td class="message">{one.text} <span class="quiet">(<Name text={one.alarm} />)</span></td><td>{one.value ?? "-"}</td>
              <td>{[one.who, one.reason].filter(Boolean).join(": ") || "-"}</td>
            </tr>))}
        </tbody>
    </DataTable>);
}

function Messages({ board }: { board: string }) {
  const { value, error } = useRequest(board, EVERY_MS, () => get<{ epoch_ns: number; messages: Message[] }>(board_path(board, "/messages?count=200")));
  if (error) return <p class="bad">{error}</p>;
  if (!value) return <Waiting />;
  if (value.messages.length === 0) return <p class="quiet">No module has printed anything.</p>;
  return (
    <DataTable label="Messages" more="events">
        <thead><tr><th scope="col">Uptime</th><th scope="col" class="number">Tick</th><th scope="col">Module</th><th scope="col">Message</th></tr></thead>
        <tbody>
          {[...value.messages].reverse().map((one, i) => (
            <tr key={`${one.time_ns} ${i}`}>
              <td>{span(Math.max(one.time_ns - value.epoch_ns, 0))}</td><td class="number">{one.tick}</td><td>{one.who}</td><td class="message">{one.text}</td>
            </tr>))}
        </tbody>
    </DataTable>);
}

export function Alarms() {
  const may_acknowledge = useMay("operate");
  const may_shelve = useMay("tune");
  const summary = useBoard();
  const board = summary?.board ?? "";
  const [all, set_all] = useState(false);
  const [shelve, set_shelve] = useState(0);
  const [reason, set_reason] = useState("");
  const [result, set_result] = useState<{ text: string; bad: boolean }>({ text: "", bad: false });
  const { value, error, refresh } = useRequest(board && `${board} ${all}`, EVERY_MS, () => get<All>(board_path(board, `/alarms${all ? "?all=true" : ""}`)));
  const revision = JSON.stringify(summary?.alarms ?? null) + JSON.stringify(value?.alarms.map(({ state }) => state) ?? null);
  useEffect(refresh, [JSON.stringify(summary?.alarms ?? null)]);
  if (!summary) return <NoBoard purpose={PURPOSE} />;
  const act: Act = async (name, body) => {
    try {
      const { alarms } = await post<{ alarms: string[] }>(board_path(board, `/alarms/${name}`), reason ? { ...body, reason } : body);
      set_result({ text: alarms.length === 0 ? "No alarm had to be changed." : `${plural(alarms.length, "alarm")} ${{ ack: "acknowledged", shelve: "shelved", unshelve: "unshelved" }[name]}.`, bad: false });
    } catch (problem) {
      set_result({ text: message_of(problem), bad: true });
    }
    refresh();
  };
  const needs = value?.counts.unacknowledged ?? 0;
  return (
    <>
      <Panel title="Alarms" state={!value ? undefined : needs > 0 ? `${needs} not acknowledged` : value.counts.active > 0 ? `${value.counts.active} active` : "all normal"}
        good={needs === 0 && value?.counts.active === 0}>
        {error && <p class="bad">{error}</p>}
        {!value && !error && <Waiting />}
        {value && !value.watched && value.declared > 0 && summary.alive && <p class="warn">The conditions of these alarms are not being evaluated yet.</p>}
        {value && value.declared === 0 && <p class="quiet">{PURPOSE} A module that does not run is always an alarm.
          No variable of this board declares an alarm yet. A declaration in a <code>.glb</code> file: <code>bool open @alarm("the door is open", high);</code></p>}
        <div class="alarm-parts">
        {value && (value.declared > 0 || value.alarms.length > 0) && (
          <div class="bar">
            <button type="button" aria-pressed={all} onClick={() => set_all(!all)}>Show all {value.declared}</button>
            {may_acknowledge && <>
              <button type="button" disabled={needs === 0} onClick={() => act("ack", { all: true })}>Acknowledge all</button>
              {may_shelve && <label>Shelve for <select value={shelve} onChange={(event) => set_shelve(Number(event.currentTarget.value))}>
                {SHELVE_FOR.map(([name], i) => <option key={name} value={i}>{name}</option>)}</select></label>}
              <label>Reason <input value={reason} onInput={(event) => set_reason(event.currentTarget.value)} /></label>
            </>}
          </div>)}
        <p role="status" class={result.bad ? "bad" : "good"}>{result.text}</p>
        {value && value.alarms.length > 0 && <List board={board} alarms={value.alarms} for_ns={SHELVE_FOR[shelve][1]} act={may_acknowledge ? act : null} />}
        {value && value.alarms.length === 0 && <p class="good">All alarms are normal.</p>}
        </div>
      </Panel>
      <Panel title="Events"><History board={board} revision={revision} /></Panel>
      <Panel title="Messages"><Messages board={board} /></Panel>
    </>);
}
