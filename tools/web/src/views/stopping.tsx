// SPDX-License-Identifier: Apache-2.0
// Asked before a module is stopped: what it is for, as far as the names and the users of its variables tell.

import { board_path, get, words } from "../api/http";
import type { Variable, Variables } from "../api/types";
import { plural } from "../ui/format";
import { Confirm, Waiting } from "../ui/parts";
import { useAsked } from "../ui/store";
import { JOB_STATES } from "./robot/words";

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

// Robots whose ROBOT_ARM the module writes: what their job does now.
async function of_robots(board: string, module: string, written: Variable[]): Promise<Effect[]> {
  const arms = written.filter(({ name }) => last_of(name) === "ROBOT_ARM").map(({ name }) => name.slice(0, -"ROBOT_ARM".length));
  return await Promise.all(arms.map(async (space) => {
    const ask = async (name: string) => await get<Variable & { value: any }>(board_path(board, `/variables/${encodeURIComponent(space + name)}`));
    const [{ value: job, form }, { value: arm }] = await Promise.all([ask("ROBOT_JOB"), ask("ROBOT_ARM")]);
    // The value of an enumeration comes by its name.
    const names = form.fields?.find(({ name }) => name === "eState")?.type.enumerators;
    const doing = JOB_STATES[names?.[job.eState] ?? Number(job.eState)] ?? "";
    if (["runs", "waits", "pauses"].includes(doing)) return { text: `The robot is in mid-job: ${job.name || "a job"} ${doing}, in line ${job.nLine}. It comes to rest where it is.`, bad: true };
    if (arm.tool_speed > 0) return { text: "The robot is moving. It comes to rest where it is.", bad: true };
    return { text: `${module} is the robot task: without it the robot cannot be moved.`, bad: false };
  }));
}

async function effects_of(board: string, module: string): Promise<Effect[]> {
  const { variables, uses_known } = await get<Variables>(board_path(board, "/variables?values=false"));
  if (!uses_known) return [{ text: "Who needs what it writes is not known here.", bad: false }];
  const written = variables.filter(({ writers }) => writers?.includes(module));
  const effects: Effect[] = [];
  const stop = written.find(({ name }) => last_of(name) === "EMERGENCY_STOP");
  if (stop) {
    const followers = (stop.readers ?? []).filter((one) => one !== module);
    effects.push({ text: `${module} is the emergency stop: it writes ${stop.name}, read by ${list_text(followers) || "no module"}. While it does not run, a pressed emergency stop is not evaluated.`, bad: true });
  }
  effects.push(...await of_robots(board, module, written));
  const needed = written.filter(({ readers }) => readers?.some((one) => one !== module));
  const readers = [...new Set(needed.flatMap(({ readers: all }) => all ?? []))].filter((one) => one !== module).sort();
  effects.push({ text: readers.length > 0
    ? `${list_text(readers)} ${readers.length === 1 ? "reads" : "read"} ${plural(needed.length, "variable")} that it writes. They keep their last values, or get its fail-safe values.`
    : "No other module reads what it writes.", bad: false });
  return effects;
}

interface Props {
  board: string;
  module: string;
  what: string;  // stop, restart
  agree: () => void;
  close: () => void;
}

export function StopQuestion({ board, module, what, agree, close }: Props) {
  const { value, error } = useAsked(`${board} ${module}`, 1000, () => effects_of(board, module), words);
  const verb = what[0].toUpperCase() + what.slice(1);
  return (
    <Confirm title={`${verb} module ${module} of ${board}?`} yes={`${verb} ${module}`} no="Leave it running" agree={agree} close={close}>
      {!value && !error && <Waiting />}
      {error && <p class="bad">{error}</p>}
      <ul class="troubles">{value?.map(({ text, bad }) => <li key={text} class={bad ? "error" : "note"}>{text}</li>)}</ul>
      <p class="quiet">The other modules keep their places in the schedule. {what === "stop" ? "It stays stopped until it is started here, or the node is." : "It starts again at once."}</p>
    </Confirm>);
}
