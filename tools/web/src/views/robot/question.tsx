// SPDX-License-Identifier: Apache-2.0
// The question that a job asks the operator (ROBOT_QUESTION), and the answer to it (ROBOT_ANSWER).

import { useEffect, useState } from "preact/hooks";
import { decode } from "../../api/decode";
import { board_path, message_of, post } from "../../api/http";
import { stream } from "../../api/stream";

const RATE_HZ = 5;

interface Asked {
  number: number;  // 0: no question is open
  text: string;
  choices: string[];  // empty: it asks for a number
  lower: number;
  upper: number;
  step: number;
  left_s: number;  // until it times out; 0: it never does
  acknowledged: number;  // the number of the answer that was received last
  reason: string;  // why that was rejected
}

function asked_of(value: any): Asked {
  return {
    number: value.nNumber, text: value.cText, choices: value.choice.slice(0, value.nChoices).map((one: { text: string }) => one.text),
    lower: value.dLower, upper: value.dUpper, step: value.dStep, left_s: value.dLeft, acknowledged: value.nAcknowledge, reason: value.cReason,
  };
}

function useAsked(board: string, name: string): Asked | null {
  const [asked, set_asked] = useState<Asked | null>(null);
  useEffect(() => {
    set_asked(null);
    return stream.subscribe({
      board, names: [name], rate_hz: RATE_HZ, binary: true,
      frame: (frame, of) => set_asked(asked_of(decode(frame.view, of.variables[0].offset, of.variables[0].form))),
    });
  }, [board, name]);
  return asked;
}

function Answers({ asked, disabled, answer }: { asked: Asked; disabled: boolean; answer: (value: number, text: string) => void }) {
  const [number, set_number] = useState("");
  if (asked.choices.length > 0) {
    return (
      <div class="bar">
        {asked.choices.map((choice, i) => <button key={choice} type="button" class="main" disabled={disabled} onClick={() => answer(i + 1, choice)}>{choice}</button>)}
      </div>);
  }
  return (
    <form class="bar" onSubmit={(event) => { event.preventDefault(); answer(Number(number), number); }}>
      <label>{asked.lower} to {asked.upper}{" "}
        <input type="number" aria-label="Answer" required min={asked.lower} max={asked.upper} step={asked.step} value={number}
          onInput={(event) => set_number(event.currentTarget.value)} /></label>
      <button type="submit" class="main" disabled={disabled}>Answer</button>
    </form>);
}

// Another one than that of any client that answers at the same time: its rejection is not taken for that of this answer.
function new_number(acknowledged: number): number {
  const number = crypto.getRandomValues(new Uint32Array(1))[0];
  return number === 0 || number === acknowledged ? new_number(acknowledged) : number;
}

interface Props {
  board: string;
  scope: string;
  down: string;  // why the robot task does not run; empty: it runs
  may_answer: boolean;
}

export function Question({ board, scope, down, may_answer }: Props) {
  const prefix = scope ? `${scope}::` : "";
  const asked = useAsked(board, `${prefix}ROBOT_QUESTION`);
  const [sent, set_sent] = useState<number | null>(null);
  const [problem, set_problem] = useState("");
  const rejected = asked && asked.acknowledged === sent ? asked.reason : "";
  const message = problem || rejected;
  if (!asked || (asked.number === 0 && !message)) return null;
  const answer = async (value: number, text: string): Promise<void> => {
    const request = new_number(asked.acknowledged);
    set_sent(request);
    set_problem("");
    try {
      await post(board_path(board, "/set"), {
        values: { [`${prefix}ROBOT_ANSWER`]: `{nRequest: ${request}, nQuestion: ${asked.number}, dAnswer: ${value}}` },
        reason: `${asked.text} ${text}`,
      });
    } catch (error) {
      set_problem(message_of(error));
    }
  };
  return (
    <section class="panel question" aria-label="Question of the job">
      <h2>The job asks</h2>
      {asked.number !== 0 && (
        <>
          <p aria-live="assertive" class="why">{asked.text}</p>
          {asked.left_s > 0 && <p class="quiet">{Math.ceil(asked.left_s)} s left to answer.</p>}
          {may_answer ? <Answers key={asked.number} asked={asked} disabled={!!down} answer={answer} />
            : <p class="quiet">A user who may operate the robot can answer.</p>}
        </>)}
      <p role="status" class="warn">{message}</p>
    </section>);
}
