// SPDX-License-Identifier: Apache-2.0
// Who a session belongs to. Users and roles are those of `indurop serve`: a name and a password are signed in there, and
// what the user changes is sent with the token of that session, so the server decides and its journal names the user.

import { makeRoles, WellKnownRoles, type NodeId, type OPCUAServer, type ServerSession } from "node-opcua";

import { log, message_of } from "../log";
import { Refused, status, type ServeClient } from "../serve/http";
import type { Client } from "../serve/types";

const CHECK_MS = 10_000;

interface Signed {
  user: string;
  role: Client["role"];
  token: string;
  ends: boolean;  // the token is a session's, not one of a token file
}

function at_least_operator(role: Client["role"]): boolean {
  return role !== "unknown" && role !== "look";
}

export class Users {
  private readonly signed = new Map<ServerSession, Signed>();
  private checking: NodeJS.Timeout | undefined;

  // users: the server has a list of users; else names and passwords are those of its token file.
  constructor(private readonly client: ServeClient, private readonly users: boolean) {}

  begin(server: OPCUAServer): void {
    server.on("session_closed", (session: ServerSession) => this.leave(session));
    this.checking = setInterval(() => void this.check_all(server), CHECK_MS);
  }

  async stop(): Promise<void> {
    clearInterval(this.checking);
    await Promise.all([...this.signed.keys()].map((session) => this.leave(session)));
  }

  async sign_in(session: ServerSession, user: string, password: string): Promise<boolean> {
    await this.leave(session);
    try {
      this.signed.set(session, this.users ? await this.sign_in_by_password(user, password) : await this.sign_in_by_token(user, password));
      log(`${user} has signed in`);
      return true;
    } catch (error) {
      log(`'${user.slice(0, 40)}' cannot sign in: ${message_of(error)}`);
      return false;
    }
  }

  // The token of the session's user, undefined: anonymous.
  token_of(session: unknown): string | undefined {
    return this.signed.get(session as ServerSession)?.token;
  }

  name_of(session: unknown): string {
    return this.signed.get(session as ServerSession)?.user ?? "anonymous";
  }

  roles_of(user: string): NodeId[] {
    for (const one of this.signed.values()) {
      if (one.user !== user) continue;
      return makeRoles(at_least_operator(one.role) ? [WellKnownRoles.AuthenticatedUser, WellKnownRoles.Operator] : [WellKnownRoles.AuthenticatedUser]);
    }
    return user === "anonymous" ? makeRoles([WellKnownRoles.Anonymous]) : [];
  }

  private async sign_in_by_password(user: string, password: string): Promise<Signed> {
    const answer = await this.client.post<Client & { token: string }>("session", { user, password }, "");
    return { user, role: answer.role, token: answer.token, ends: true };
  }

  private async sign_in_by_token(user: string, token: string): Promise<Signed> {
    if (!/^[A-Za-z0-9_-]{20,200}$/.test(token)) throw new Error("the server has no users, so the password is a token of its token file");
    const client = await this.client.get<Client>("session", token);
    if (client.user !== user) throw new Error("the token is not that of this name");
    return { user, role: client.role, token, ends: false };
  }

  private async leave(session: ServerSession): Promise<void> {
    const one = this.signed.get(session);
    this.signed.delete(session);
    if (!one?.ends) return;
    await this.client.post("session/end", undefined, one.token).catch(() => undefined);  // it ends on its own as well
  }

  // A session ends with that of its user: who was removed or has another password now is out. A request now and then also
  // keeps the user's session while the client is connected.
  private async check_all(server: OPCUAServer): Promise<void> {
    await Promise.all([...this.signed].map(async ([session, one]) => {
      try {
        one.role = (await this.client.get<Client>("session", one.token)).role;
      } catch (error) {
        if (!(error instanceof Refused) || error.code !== status.unauthorized) return;
        log(`the session of ${one.user} has ended: ${error.message}`);
        this.signed.delete(session);
        server.engine!.closeSession(session.authenticationToken, true, "Terminated");
      }
    }));
  }
}
