// SPDX-License-Identifier: Apache-2.0
// The PLC program as it runs: power flow in ladders and function blocks, active steps, values next to lines of text.

import { useEffect, useMemo } from "preact/hooks";
import { board_path, get } from "../../api/http";
import type { PlcBody, PlcBodyLive, PlcChart, PlcLive, PlcNetwork, PlcNetworkLive, PlcProgram, Variables } from "../../api/types";
import { NoBoard } from "../../shell/no_board";
import { plant, useBoard } from "../../shell/plant";
import { address, change_query, place } from "../../ui/address";
import { Panel, Waiting } from "../../ui/parts";
import { part_named } from "../../ui/paths";
import { useRequest, useStore } from "../../ui/store";
import { Detail } from "../variables/detail";
import { Forces } from "../variables/forces";
import { useLive } from "../variables/live";

const PURPOSE = "This view shows a PLC program as it runs: power flow in ladders and function blocks, active steps of charts, values next to lines of text. Variables can be set and forced in the drawing.";
const EVERY_MS = 200;
const SWITCH_PX = 27;
const SWITCH_HIGH_PX = 22;
const MIN_SCALE = 0.62;  // a drawing that is wider than the screen is scaled down to this, and stays readable

type Find = (name: string) => string | null;  // the shared variable that a name of the program means

function is_set(bits: string | undefined, i: number): boolean {
  return bits?.[i] === "1";
}

// A name means a shared variable of the program's namespace, or the one with this full name, or the only one with this last
// name. Case is ignored.
function finder(space: string, names: string[]): Find {
  const known = new Map(names.map((name) => [name.toLowerCase(), name]));
  const last = new Map<string, string | null>();
  for (const name of names) {
    const key = name.slice(name.lastIndexOf("::") + 1).replace(/^:/, "").toLowerCase();
    last.set(key, last.has(key) ? null : name);
  }
  return (text) => {
    const name = text.toLowerCase().replaceAll(".", "::");
    const [first, ...rest] = text.split(".");
    return (known.get(`${space.toLowerCase()}::${first.toLowerCase()}`) ?? last.get(first.toLowerCase()))?.concat(...rest.map((part) => `.${part}`))
      ?? known.get(name) ?? null;
  };
}

interface Place {
  find: Find;
  address_of: (variable: string) => string;
  forced: Set<string>;
}

// The coils of a network as text, for screens on which its right end is not visible.
function Coils({ network, live, place: { find, address_of } }: { network: PlcNetwork; live: PlcNetworkLive | undefined; place: Place }) {
  const coils = network.switches.map((one, i) => ({ ...one, is_on: is_set(live?.closed, i) })).filter(({ coil }) => coil);
  return (
    <p class="coils">{coils.map(({ name, is_on, x, y }) => {
      const variable = find(name);
      const chip = <span class={`chip ${is_on ? "good" : "quiet"}`}>{name} {is_on ? "on" : "off"}</span>;
      return variable ? <a key={`${x} ${y}`} href={address_of(variable)}>{chip}</a> : <span key={`${x} ${y}`}>{chip}</span>;
    })}</p>);
}

function Network({ network, live, place }: { network: PlcNetwork; live: PlcNetworkLive | undefined; place: Place }) {
  const { number, remarks, svg, width, height, rail, wires, switches, values } = network;
  const wide = width + 94;
  return (
    <figure class="network">
      <figcaption><span class="rung">{number}</span> {remarks.join(" ")}</figcaption>
      <div class="scroll" tabIndex={0} role="region" aria-label={`Network ${number}`}>
        <svg viewBox={`-4 -4 ${width + 90} ${height + 8}`} style={{ width: `${wide}px`, maxWidth: `max(100%, ${wide * MIN_SCALE}px)`, height: "auto" }}
          role="group" aria-label={`Network ${number}: ${state_text(network, live)}`}>
          {rail && live && <line class="power" x1={4.5} y1={0} x2={4.5} y2={height} />}
          {wires.map(([x1, y1, x2, y2], i) => is_set(live?.power, i) && <line key={i} class="power" x1={x1} y1={y1} x2={x2} y2={y2} />)}
          {switches.map(({ x, y }, i) => is_set(live?.closed, i) &&
            <rect key={i} class="closed" x={x} y={y - SWITCH_HIGH_PX / 2} width={SWITCH_PX} height={SWITCH_HIGH_PX} rx={4} />)}
          <g class="drawn" dangerouslySetInnerHTML={{ __html: svg }} />
          {values.map(([x, y], i) => live?.values[i] && <text key={i} class="value" x={x} y={y - 5}>{live.values[i]}</text>)}
          {switches.map(({ x, y, name }, i) => {
            const variable = place.find(name);
            const is_forced = variable !== null && place.forced.has(variable);
            return variable && (
              <a key={i} href={place.address_of(variable)} aria-label={`${variable}, ${is_set(live?.closed, i) ? "passes power" : "does not pass power"}${is_forced ? ", forced" : ""}`}>
                <title>{`${variable}: show, set, force${is_forced ? "; forced" : ""}`}</title>
                <rect class={`hit ${is_forced ? "forced" : ""}`} x={x - 6} y={y - 32} width={SWITCH_PX + 12} height={44} />
                {is_forced && <text class="forced" x={x + SWITCH_PX / 2} y={y + 23} text-anchor="middle">forced</text>}
              </a>);
          })}
        </svg>
      </div>
      <Coils network={network} live={live} place={place} />
    </figure>);
}

// For users who cannot distinguish the colours.
function state_text({ switches }: PlcNetwork, live: PlcNetworkLive | undefined): string {
  if (!live) return "no values yet";
  return switches.map(({ name }, i) => `${name} ${is_set(live.closed, i) ? "on" : "off"}`).join(", ");
}

function Chart({ chart, live, title }: { chart: PlcChart; live: PlcBodyLive | undefined; title: string }) {
  return (
    <>
      <div class="scroll" tabIndex={0} role="region" aria-label={`Chart ${title}`}>
        <svg viewBox={`-4 -4 ${chart.width + 60} ${chart.height + 8}`} width={chart.width + 64} height={chart.height + 8} role="img"
          aria-label={`Active: ${chart.steps.filter((_, i) => is_set(live?.active, i)).map(({ name }) => name).join(", ") || "no step"}`}>
          <g class="drawn" dangerouslySetInnerHTML={{ __html: chart.svg }} />
          {chart.steps.map(({ name, box: [x, y, width, height] }, i) => is_set(live?.active, i) && (
            <g key={name}>
              <rect class="active" x={x} y={y} width={width} height={height} rx={3} />
              <text class="value" x={x} y={y - 4}>{live?.times?.[i]}</text>
            </g>))}
        </svg>
      </div>
      <table class="data-table"><tbody>{chart.conditions.map((condition, i) => (
        <tr key={i}><th scope="row"><code>{condition}</code></th><td>{live?.conditions?.[i]}</td></tr>))}</tbody></table>
    </>);
}

function Lines({ lines, values, title }: { lines: string[]; values: string[] | undefined; title: string }) {
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label={`Text of ${title}`}>
      <table class="code"><tbody>{lines.map((line, i) => (
        <tr key={i}><td class="line-number">{i + 1}</td><td><code>{line}</code></td><td class="line-value"><code>{values?.[i]}</code></td></tr>))}</tbody></table>
    </div>);
}

function Body({ body, live, place }: { body: PlcBody; live: PlcBodyLive | undefined; place: Place }) {
  const title = body.action ? `${body.title}, action ${body.action}` : body.title;
  return (
    <Panel title={title} state={body.language} good>
      {body.networks?.map((network, i) => <Network key={network.number} network={network} live={live?.networks?.[i]} place={place} />)}
      {body.chart && <Chart chart={body.chart} live={live} title={title} />}
      {body.lines && <Lines lines={body.lines} values={live?.values} title={title} />}
    </Panel>);
}

export function Plc() {
  const board = useBoard();
  const { status } = useStore(plant);
  const name = board && status?.plc ? board.board : "";
  const { query } = useStore(place);
  const chosen = query.get("p") ?? "";
  const wanted = query.get("v") ?? "";
  const which = (program: string) => (program ? `?program=${encodeURIComponent(program)}` : "");
  const program = useRequest(name && `${name} ${board?.layout} ${chosen}`, 0, () => get<PlcProgram>(board_path(name, `/plc${which(chosen)}`)));
  const shared = useRequest(name && `${name} ${board?.layout}`, 0, () => get<Variables>(board_path(name, "/variables?values=false")));
  const now = useRequest(program.value ? `${name} ${board?.layout} ${program.value.program} live` : "", EVERY_MS,
    () => get<PlcLive>(board_path(name, `/plc/live${which(program.value!.program)}`)));
  // Another program may run there now, of which the server reads the files again.
  useEffect(() => { if (now.error) program.refresh(); }, [now.error]);
  const find = useMemo(() => finder(program.value?.namespace ?? "", shared.value?.variables.map((one) => one.name) ?? []), [program.value, shared.value]);
  const variables = shared.value?.variables ?? [];
  const switched = useMemo(() => [...new Set(program.value?.bodies.flatMap(({ networks }) => networks ?? []).flatMap(({ switches }) => switches)
    .map(({ name }) => find(name)).filter((name) => name !== null) ?? [])], [program.value, find]);
  const chosen_part = useMemo(() => (wanted ? part_named(variables, wanted) : null), [variables, wanted]);
  const followed = chosen_part && !switched.includes(chosen_part.variable.name) ? [...switched, chosen_part.variable.name] : switched;
  const values = useLive(board?.board ?? "", followed);
  if (!board) return <NoBoard purpose={PURPOSE} />;
  if (status && !status.plc) {
    return (
      <div class="panel">
        <p>{PURPOSE}</p>
        <p class="quiet">No PLC program was given to the server. Build one with <code>indurop plc build FILE --watch</code>, and start the server with <code>indurop serve --plc FILE</code>.</p>
      </div>);
  }
  if (program.error) {
    return (
      <>
        <p class="bad">{program.error}</p>
        <p><button type="button" onClick={program.refresh}>Try again</button> {chosen && <button type="button" onClick={() => change_query({ p: "" })}>Show another program</button>}</p>
      </>);
  }
  if (!program.value) return <Waiting />;
  const where: Place = {
    find, forced: values.forced,
    address_of: (v) => address("plc", { board: board.board, ...(chosen ? { p: chosen } : {}), v }),
  };
  return (
    <>
      <Forces board={board.board} />
      <div class={`plc variables ${chosen_part ? "with-detail" : ""}`}>
        <div>
          {program.value.programs.length > 1 && (
            <div class="bar"><label class="choice">Program{" "}
              <select value={program.value.program} onChange={(event) => change_query({ p: event.currentTarget.value })}>
                {program.value.programs.map((one) => <option key={one}>{one}</option>)}
              </select></label></div>)}
          <p class="quiet">Green lines have power; green contacts and coils pass it on. Select one to see its variable, and to set or force it.</p>
          {now.error && <p class="bad">{now.error}</p>}
          {now.value && !now.value.alive && <p class="warn">The node is not running: these are its last values.</p>}
          {program.value.others && <p class="quiet">Not shown: {program.value.others}</p>}
          {program.value.bodies.map((body, i) => <Body key={i} body={body} live={now.value?.bodies[i]} place={where} />)}
        </div>
        {chosen_part && <Detail board={board.board} part={chosen_part} live={values} close={() => change_query({ v: "" })} changed={shared.refresh} />}
      </div>
    </>);
}
