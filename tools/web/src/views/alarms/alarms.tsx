// SPDX-License-Identifier: Apache-2.0
// Alarms of a board: those that need somebody first, what to do about them, and what happened before.

import { useEffect, useState } from "preact/hooks";
import { board_path, get, post, words } from "../../api/http";
import type { Alarm, AlarmEvent, Alarms as All, Message } from "../../api/types";
import { plant, useBoard } from "../../shell/plant";
import { address } from "../../ui/address";
import { clock, plural, span } from "../../ui/format";
import { Figures, Panel, Waiting } from "../../ui/parts";
import { useAsked, useStore } from "../../ui/store";

const EVERY_MS = 5000;  // besides what the stream tells at once
const HOUR_NS = 3600e9;
const SHELVE_FOR: [string, number][] = [["1 hour", HOUR_NS], ["8 hours", 8 * HOUR_NS], ["1 day", 24 * HOUR_NS], ["1 week", 168 * HOUR_NS]];
const STATES = { normal: "normal", unacknowledged: "active, not acknowledged", acknowledged: "active, acknowledged",
  returned: "over, not acknowledged", shelved: "shelved" };

type Order = (what: "ack" | "shelve" | "unshelve", body: object) => void;

function Orders({ alarm, for_ns, order }: { alarm: Alarm; for_ns: number; order: Order }) {
  const alarms = [alarm.alarm];
  const needs = alarm.state === "unacknowledged" || alarm.state === "returned";
  return (
    <span class="orders">
      {needs && <button type="button" class="main" aria-label={`Acknowledge ${alarm.alarm}`} onClick={() => order("ack", { alarms })}>acknowledge</button>}
      {alarm.state === "shelved"
        ? <button type="button" aria-label={`Unshelve ${alarm.alarm}`} onClick={() => order("unshelve", { alarms })}>unshelve</button>
        : <button type="button" aria-label={`Shelve ${alarm.alarm}`} onClick={() => order("shelve", { alarms, for_ns })}>shelve</button>}
    </span>);
}

function More({ alarm }: { alarm: Alarm }) {
  const { state, who, reason, until_wall_ns } = alarm;
  const by = who ? `by ${who}${reason ? `: ${reason}` : ""}` : "";
  return <>{STATES[state]}{state === "shelved" && until_wall_ns ? ` until ${clock(until_wall_ns)}` : ""}{by && <small>{by}</small>}</>;
}

function List({ board, alarms, for_ns, order }: { board: string; alarms: Alarm[]; for_ns: number; order: Order | null }) {
  return (
    <Figures label="Alarms" more="alarms">
      <thead>
        <tr><th scope="col">Priority</th><th scope="col">Alarm</th><th scope="col">State</th><th scope="col">Since</th>
          <th scope="col">Value</th><th scope="col" class="number">Raised</th>{order && <th scope="col">Orders</th>}</tr>
      </thead>
      <tbody>
        {alarms.map((alarm) => (
          <tr key={alarm.alarm} class={alarm.state === "normal" || alarm.state === "shelved" ? "is-quiet" : ""}>
            <td class="how"><span class={`priority ${alarm.priority}`}>{alarm.priority}</span></td>
            <th scope="row" class="what message">{alarm.text}
              <small>{alarm.name ? <a href={address("variables", { board, v: alarm.name })}>{alarm.alarm}</a> : alarm.alarm}
                {alarm.unit && ` ${alarm.unit}`}{alarm.delay_ns > 0 && `, after ${span(alarm.delay_ns)}`}</small></th>
            <td class="what wide"><More alarm={alarm} /></td>
            <td class="when">{alarm.since_wall_ns ? clock(alarm.since_wall_ns) : "-"}</td>
            <td>{alarm.value || "-"}</td>
            <td class="number">{plural(alarm.count, "time")}</td>
            {order && <td class="wide"><Orders alarm={alarm} for_ns={for_ns} order={order} /></td>}
          </tr>))}
      </tbody>
    </Figures>);
}

function History({ board, revision }: { board: string; revision: string }) {
  const { value, error, again } = useAsked(board, EVERY_MS, () => get<{ events: AlarmEvent[] }>(board_path(board, "/alarms/history?count=200")), words);
  useEffect(again, [revision]);
  if (error) return <p class="bad">{error}</p>;
  if (!value) return <Waiting />;
  if (value.events.length === 0) return <p class="quiet">Nothing happened yet.</p>;
  return (
    <Figures label="Events" more="events">
        <thead><tr><th scope="col">Time</th><th scope="col">Event</th><th scope="col">Alarm</th><th scope="col">Value</th><th scope="col">Who and why</th></tr></thead>
        <tbody>
          {[...value.events].reverse().map((one, i) => (
            <tr key={`${one.wall_ns} ${i}`}>
              <td>{clock(one.wall_ns)}</td><td class={one.event === "raised" ? "bad" : ""}>{one.event}</td>
              <td class="message">{one.text} <span class="quiet">({one.alarm})</span></td><td>{one.value ?? "-"}</td>
              <td>{[one.who, one.reason].filter(Boolean).join(": ") || "-"}</td>
            </tr>))}
        </tbody>
    </Figures>);
}

function Messages({ board }: { board: string }) {
  const { value, error } = useAsked(board, EVERY_MS, () => get<{ epoch_ns: number; messages: Message[] }>(board_path(board, "/messages?count=200")), words);
  if (error) return <p class="bad">{error}</p>;
  if (!value) return <Waiting />;
  if (value.messages.length === 0) return <p class="quiet">No module has printed anything.</p>;
  return (
    <Figures label="Messages" more="events">
        <thead><tr><th scope="col">After</th><th scope="col" class="number">Tick</th><th scope="col">Module</th><th scope="col">Message</th></tr></thead>
        <tbody>
          {[...value.messages].reverse().map((one, i) => (
            <tr key={`${one.time_ns} ${i}`}>
              <td>{span(Math.max(one.time_ns - value.epoch_ns, 0))}</td><td class="number">{one.tick}</td><td>{one.who}</td><td class="message">{one.text}</td>
            </tr>))}
        </tbody>
    </Figures>);
}

export function Alarms() {
  const { status } = useStore(plant);
  const summary = useBoard();
  const board = summary?.board ?? "";
  const [all, show] = useState(false);
  const [shelve, choose] = useState(0);
  const [reason, give] = useState("");
  const [said, say] = useState<{ text: string; bad: boolean }>({ text: "", bad: false });
  const { value, error, again } = useAsked(board && `${board} ${all}`, EVERY_MS, () => get<All>(board_path(board, `/alarms${all ? "?all=true" : ""}`)), words);
  const revision = JSON.stringify(summary?.alarms ?? null) + JSON.stringify(value?.alarms.map(({ state }) => state) ?? null);
  useEffect(again, [JSON.stringify(summary?.alarms ?? null)]);
  if (!summary) return null;
  const order: Order = async (what, body) => {
    try {
      const { alarms } = await post<{ alarms: string[] }>(board_path(board, `/alarms/${what}`), reason ? { ...body, reason } : body);
      say({ text: alarms.length === 0 ? "There was nothing to do." : `${plural(alarms.length, "alarm")} ${{ ack: "acknowledged", shelve: "shelved", unshelve: "unshelved" }[what]}.`, bad: false });
    } catch (problem) {
      say({ text: words(problem), bad: true });
    }
    again();
  };
  const needs = value?.counts.unacknowledged ?? 0;
  return (
    <>
      <Panel title="Alarms" state={!value ? undefined : needs > 0 ? `${needs} not acknowledged` : value.counts.active > 0 ? `${value.counts.active} active` : "all normal"}
        good={needs === 0 && value?.counts.active === 0}>
        {error && <p class="bad">{error}</p>}
        {!value && !error && <Waiting />}
        {value && !value.watched && value.declared > 0 && summary.alive && <p class="warn">Nobody looks at the conditions of these alarms yet.</p>}
        {value && value.declared === 0 && <p class="quiet">Here stands what somebody has to do something about, until it is acknowledged. Modules that do not run are always alarms; no variable
          of this board declares one yet: <code>bool open @alarm("the door is open", high);</code></p>}
        <div class="alarm-parts">
        {value && (value.declared > 0 || value.alarms.length > 0) && (
          <div class="bar">
            <button type="button" aria-pressed={all} onClick={() => show(!all)}>All {value.declared} declared</button>
            {status?.may_write && <>
              <button type="button" disabled={needs === 0} onClick={() => order("ack", { all: true })}>Acknowledge all</button>
              <label>Shelve for <select value={shelve} onChange={(event) => choose(Number(event.currentTarget.value))}>
                {SHELVE_FOR.map(([name], i) => <option key={name} value={i}>{name}</option>)}</select></label>
              <label>Reason <input value={reason} onInput={(event) => give(event.currentTarget.value)} /></label>
            </>}
          </div>)}
        <p role="status" class={said.bad ? "bad" : "good"}>{said.text}</p>
        {value && value.alarms.length > 0 && <List board={board} alarms={value.alarms} for_ns={SHELVE_FOR[shelve][1]} order={status?.may_write ? order : null} />}
        {value && value.alarms.length === 0 && <p class="good">All alarms are normal.</p>}
        </div>
      </Panel>
      <Panel title="Events"><History board={board} revision={revision} /></Panel>
      <Panel title="Messages"><Messages board={board} /></Panel>
    </>);
}
