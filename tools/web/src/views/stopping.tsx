// SPDX-License-Identifier: Apache-2.0
// The question before a module is stopped: what that affects, derived from the names and the readers of its variables.

import { board_path, get } from "../api/http";
import type { Variable, Variables } from "../api/types";
import { plural } from "../ui/format";
import { Confirm, Waiting } from "../ui/parts";
import { useRequest } from "../ui/store";
import { JOB_STATES } from "./robot/names";

interface Effect {
  text: string;
  bad: boolean;
}

function list_text(names: string[]): string {
  return names.length < 2 ? names.join("") : `${names.slice(0, -1).join(", ")} and ${names.at(-1)}`;
}

function last_of(name: string): string {
  return name.slice(name.lastIndexOf("::") + 1).replace(/^:/, "");
}

// For each robot whose ROBOT_ARM the module writes: what its job does now.
async function effects_on_robots(board: string, module: string, written: Variable[]): Promise<Effect[]> {
  const arms = written.filter(({ name }) => last_of(name) === "ROBOT_ARM").map(({ name }) => name.slice(0, -"ROBOT_ARM".length));
  return await Promise.all(arms.map(async (space) => {
    const fetch_value = async (name: string) => await get<Variable & { value: any }>(board_path(board, `/variables/${encodeURIComponent(space + name)}`));
    const [{ value: job, form }, { value: arm }] = await Promise.all([fetch_value("ROBOT_JOB"), fetch_value("ROBOT_ARM")]);
    // The value of an enumeration is its name.
    const names = form.fields?.find(({ name }) => name === "eState")?.type.enumerators;
    const doing = JOB_STATES[names?.[job.eState] ?? Number(job.eState)] ?? "";
    if (["running", "waiting", "paused", "resuming"].includes(doing)) return { text: `The robot is in the middle of a job: ${job.name || "its job"} is ${doing} in line ${job.nLine}. The robot will stop where it is.`, bad: true };
    if (arm.tool_speed > 0) return { text: "The robot is moving. It will stop where it is.", bad: true };
    return { text: `${module} is the robot task: the robot cannot move without it.`, bad: false };
  }));
}

async function effects_of(board: string, module: string): Promise<Effect[]> {
  const { variables, uses_known } = await get<Variables>(board_path(board, "/variables?values=false"));
  if (!uses_known) return [{ text: "Which modules read its variables is not known.", bad: false }];
  const written = variables.filter(({ writers }) => writers?.includes(module));
  const effects: Effect[] = [];
  const stop = written.find(({ name }) => last_of(name) === "EMERGENCY_STOP");
  if (stop) {
    const followers = (stop.readers ?? []).filter((one) => one !== module);
    effects.push({ text: `${module} is the emergency stop: it writes ${stop.name}, read by ${list_text(followers) || "no module"}. While it is stopped, a pressed emergency stop has no effect.`, bad: true });
  }
  effects.push(...await effects_on_robots(board, module, written));
  const needed = written.filter(({ readers }) => readers?.some((one) => one !== module));
  const readers = [...new Set(needed.flatMap(({ readers: all }) => all ?? []))].filter((one) => one !== module).sort();
  effects.push({ text: readers.length > 0
    ? `${list_text(readers)} ${readers.length === 1 ? "reads" : "read"} ${plural(needed.length, "variable")} that it writes. Its variables keep their last values, or get their fail-safe values.`
    : "No other module reads what it writes.", bad: false });
  return effects;
}

interface Props {
  board: string;
  module: string;
  act: string;  // stop, restart
  agree: () => void;
  close: () => void;
}

export function StopQuestion({ board, module, act, agree, close }: Props) {
  const { value, error } = useRequest(`${board} ${module}`, 1000, () => effects_of(board, module));
  const verb = act[0].toUpperCase() + act.slice(1);
  return (
    <Confirm title={`${verb} module ${module} of ${board}?`} yes={`${verb} ${module}`} no="Leave it running" agree={agree} close={close}>
      {!value && !error && <Waiting />}
      {error && <p class="bad">{error}</p>}
      <ul class="problems">{value?.map(({ text, bad }) => <li key={text} class={bad ? "error" : "note"}>{text}</li>)}</ul>
      <p class="quiet">The schedule of the other modules does not change. {act === "stop" ? `${module} stays stopped until it is started here or the node is restarted.` : `${module} starts again immediately.`}</p>
    </Confirm>);
}
