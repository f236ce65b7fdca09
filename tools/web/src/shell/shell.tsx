// SPDX-License-Identifier: Apache-2.0
// The frame around all views: where one can go, which board is looked at, and in words what is missing.

import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { token_was_refused } from "../api/http";
import { address, change_query, place } from "../ui/address";
import { useStore } from "../ui/store";
import { plant, useBoard } from "./plant";
import { choose_theme, theme, THEMES, type Theme } from "./theme";

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

// What keeps the page from showing what is, in order of how much is missing; empty if nothing does.
function missing(): string {
  const { link, status, boards, error, let_in } = plant.get();
  const unknown = token_was_refused() ? "The server does not know the token of this page: it was started again, or has other tokens. " : "";
  if (!let_in) return `${unknown}It wants a token: open the address that it prints, which ends in #token=...`;
  if (link === "lost") return "The server is gone: looking for it again. What you see is old.";
  if (error) return `${error} Asking again.`;
  if (!status || !boards) return "";
  if (unknown && !status.may_write) return `${unknown}You only look. To write, open the address that it prints.`;
  if (boards.length === 0 && !status.plant) return "There is no node on this host yet. Start one with: indurop run module.xml";
  return "";
}

function Notice() {
  useStore(plant);
  const board = useBoard();
  const what = missing();
  const where = board && !board.here ? `Board ${board.board} is ${board.state}` : `Node ${board?.board} is gone`;
  const gone = !what && board && !board.alive ? `${where}: looking for it again. Values are its last ones.` : "";
  return <div role="status" class="notices">{(what || gone) && <p class="notice">{what || gone}</p>}</div>;
}

function BoardChoice() {
  const { boards } = useStore(plant);
  const board = useBoard();
  if (!boards || boards.length < 2 || !board) return board && <span class="board-name">{board.board}</span>;
  return (
    <label class="choice">Board{" "}
      <select value={board.board} onChange={(event) => change_query({ board: event.currentTarget.value })}>
        {boards.filter(({ alive, here }) => alive || !here).map((one) => <option key={one.board} value={one.board}>{one.board}{one.alive ? "" : " (not heard)"}</option>)}
        {boards.some(({ alive, here }) => !alive && here) && (
          <optgroup label="Ended">
            {boards.filter(({ alive, here }) => !alive && here).map(({ board: name }) => <option key={name} value={name}>{name}</option>)}
          </optgroup>)}
      </select>
    </label>);
}

function LinkState() {
  const { link, status, let_in } = useStore(plant);
  const text = let_in ? { open: "connected", connecting: "connecting", lost: "server gone" }[link] : "no token";
  return (
    <span class={`link ${link}`}>
      <span class="dot" aria-hidden="true" />{text}
      {status && let_in && <span class="rights">{status.may_write ? `, writing as ${status.who || "nobody known"}` : ", only looking"}</span>}
    </span>);
}

function ThemeChoice() {
  const now = useStore(theme);
  return (
    <label class="choice theme"><span class="hidden">Colours</span>
      <select value={now} onChange={(event) => choose_theme(event.currentTarget.value as Theme)}>
        {THEMES.map((one) => <option key={one} value={one}>{one}</option>)}
      </select>
    </label>);
}

export function Shell({ views, title, children }: { views: View[]; title: string; children: ComponentChildren }) {
  const main = useRef<HTMLElement>(null);
  const first = useRef(true);
  useEffect(() => {
    document.title = `${title} - InduRoP`;
    // A reader of the screen hears where it has come to; not at the start, where nobody went anywhere.
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
