// SPDX-License-Identifier: Apache-2.0
// The frame around all views: navigation, the selected board, and a notice if the server or the board cannot be reached.

import type { ComponentChildren } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { token, token_was_rejected } from "../api/http";
import { address, change_query, place } from "../ui/address";
import { useStore } from "../ui/store";
import { how_to_write, plant, useBoard } from "./plant";
import { sign_out, SignIn } from "./sign_in";
import { set_theme, theme, THEMES, type Theme } from "./theme";

export interface View {
  name: string;
  title: string;
  icon: string;  // a path in a box of 24 by 24
}

function Icon({ path }: { path: string }) {
  return <svg class="icon" viewBox="0 0 24 24" aria-hidden="true"><path d={path} /></svg>;
}

function Navigation({ views }: { views: View[] }) {
  const { view, query } = useStore(place);
  const board = query.get("board");
  const alarms = useBoard()?.alarms.unacknowledged ?? 0;
  return (
    <nav aria-label="Views">
      <ul>
        {views.map(({ name, title, icon }) => (
          <li key={name}>
            <a href={address(name, board ? { board } : {})} aria-current={view === name ? "page" : undefined}>
              <Icon path={icon} /><span>{title}</span>
              {name === "alarms" && alarms > 0 && <span class="badge" title={`${alarms} not acknowledged`}>{alarms}</span>}
            </a>
          </li>))}
      </ul>
    </nav>);
}

// Why the page cannot show current values, the most severe reason first; empty: it can.
function why_not_current(): string {
  const { link, status, boards, error, admitted } = plant.get();
  const unknown = token_was_rejected() ? "The server does not know the token of this page: the session has ended, or the server was restarted or has other tokens. " : "";
  if (!admitted) return `${unknown}Sign in at the top right, or open the address that the server prints, which ends in #token=...`;
  if (link === "lost") return "The server cannot be reached. The page shows the last values, and reconnects automatically.";
  if (error) return `${error} Trying again.`;
  if (!status || !boards) return "";
  if (unknown && !status.may_write) return `${unknown}The page is read-only. To write, ${how_to_write(status)}.`;
  if (boards.length === 0 && !status.plant) return "No node is running on this host. Start one with: indurop run module.xml";
  return "";
}

function Notice() {
  useStore(plant);
  const board = useBoard();
  const what = why_not_current();
  const where = board && !board.here ? `Board ${board.board} is ${board.state}` : `Node ${board?.board} is not running`;
  const ended = !what && board && !board.alive ? `${where}. The page shows its last values, and resumes when it is back.` : "";
  return <div role="status" class="notices">{(what || ended) && <p class="notice">{what || ended}</p>}</div>;
}

function BoardChoice() {
  const { boards } = useStore(plant);
  const board = useBoard();
  if (!boards || boards.length < 2 || !board) return board && <span class="board-name" title={board.board}>{board.board}</span>;
  return (
    <label class="choice">Board{" "}
      <select value={board.board} onChange={(event) => change_query({ board: event.currentTarget.value })}>
        {boards.filter(({ alive, here }) => alive || !here).map((one) => <option key={one.board} value={one.board}>{one.board}{one.alive ? "" : " (silent)"}</option>)}
        {boards.some(({ alive, here }) => !alive && here) && (
          <optgroup label="Ended">
            {boards.filter(({ alive, here }) => !alive && here).map(({ board: name }) => <option key={name} value={name}>{name}</option>)}
          </optgroup>)}
      </select>
    </label>);
}

function LinkState() {
  const { link, status, admitted } = useStore(plant);
  const text = admitted ? { open: "connected", connecting: "connecting", lost: "not connected" }[link] : "not signed in";
  return (
    <span class={`link ${link}`}>
      <span class="dot" aria-hidden="true" /><span class="state">{text}</span>
      {status && admitted && <span class="rights">{status.may_write ? `, writing as ${status.who || "unknown user"}` : status.who ? `, ${status.who}, read-only` : ", read-only"}</span>}
    </span>);
}

function UserChoice() {
  const { status, admitted } = useStore(plant);
  const [asking, set_asking] = useState(false);
  if (!status?.users && admitted) return null;
  if (admitted && token()) return <button type="button" class="user" onClick={() => void sign_out()}>Sign out</button>;
  return (
    <>
      <button type="button" class="user" onClick={() => set_asking(true)}>Sign in</button>
      {asking && <SignIn close={() => set_asking(false)} />}
    </>);
}

function ThemeChoice() {
  const now = useStore(theme);
  return (
    <label class="choice theme"><span class="hidden">Colours</span>
      <select value={now} onChange={(event) => set_theme(event.currentTarget.value as Theme)}>
        {THEMES.map((one) => <option key={one} value={one}>{one}</option>)}
      </select>
    </label>);
}

export function Shell({ views, title, children }: { views: View[]; title: string; children: ComponentChildren }) {
  const main = useRef<HTMLElement>(null);
  const first = useRef(true);
  useEffect(() => {
    document.title = `${title} - InduRoP`;
    // A screen reader announces the new view; not at the start, when the user has not navigated.
    if (!first.current) main.current?.focus();
    first.current = false;
  }, [title]);
  return (
    <>
      <a class="skip" href="#main" onClick={(event) => { event.preventDefault(); main.current?.focus(); }}>Skip to content</a>
      <header>
        <span class="brand">InduRoP</span>
        <BoardChoice />
        <span class="space" />
        <LinkState />
        <UserChoice />
        <ThemeChoice />
      </header>
      <Navigation views={views} />
      <main id="main" tabIndex={-1} ref={main}>
        <Notice />
        <h1>{title}</h1>
        {children}
      </main>
    </>);
}
