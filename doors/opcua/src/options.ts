// SPDX-License-Identifier: Apache-2.0
// The command line of indurop-opcua.

import { homedir } from "node:os";
import { join } from "node:path";
import { parseArgs } from "node:util";

declare const INDUROP_VERSION: string;

export const VERSION = INDUROP_VERSION;

export interface Options {
  serve: URL;
  serve_ca: string;
  token_file: string;
  bind: string;
  port: number;
  hosts: string[];
  cert: string;
  key: string;
  ca: string;
  revoked: string;
  anonymous: boolean;
  rate_hz: number;
  sessions: number;
  items: number;
  state: string;
  check: boolean;
}

// Of --client.
export interface ClientOptions {
  socket: string;
  password_file: string;
  state: string;
}

const DEFAULT_SERVE = "http://127.0.0.1:8080";
const RATE_HZ = { usual: 10, least: 0.1, highest: 100 };
const HIGHEST_PORT = 65535;

export const HELP = `Usage: indurop-opcua [OPTIONS]

Shows the boards of an \`indurop serve\` over OPC UA, or reads and writes other servers for their I/O (--client).

  --serve URL          The server; default ${DEFAULT_SERVE}
  --serve-ca FILE      Authority of that server's certificate (https)
  --token-file FILE    First line \`NAME TOKEN\`: read with this token where serve requires one
  --bind ADDRESS       Address to listen on; default 127.0.0.1
  --port NUMBER        TCP port; default 4840, 0: any free port
  --host NAME          Name or address by which clients reach this machine; may be repeated
  --cert FILE          Certificate (RSA) of this server; default: a self-signed one, made at the first start
  --key FILE           Private key of --cert
  --ca FILE            Accept clients with a certificate of this authority; needs --revoked
  --revoked FILE       Revocation list of --ca
  --anonymous          Anyone who can connect may read
  --rate HZ            How often values are sampled, 0.1 to 100; default ${RATE_HZ.usual}
  --sessions NUMBER    Sessions at a time; default 32
  --items NUMBER       Monitored items of all clients together; default 60000
  --state FOLDER       Certificates; default \$INDUROP_STATE_DIR/opcua
  --client             Connect the devices of driver opcua in ioconfig.xml with their servers
  --socket PATH        Where I/O modules reach --client; default indurop-opcua.sock in XDG_RUNTIME_DIR, or /run/indurop/opcua.sock
  --password-file FILE  Lines \`USER PASSWORD\` for devices of --client that name a user
  --check              List what is shown and what a type cannot show, then exit
  --version            Print the version
  -h, --help           Print this help
`;

export class UsageError extends Error {}

function number_of(name: string, text: string, least: number, most: number): number {
  const number = Number(text);
  if (text.trim() === "" || !(number >= least && number <= most)) {
    throw new UsageError(`--${name} is a number of ${least} to ${most}, not '${text}'`);
  }
  return number;
}

function whole_of(name: string, text: string, least: number, most: number): number {
  const number = number_of(name, text, least, most);
  if (!Number.isInteger(number)) throw new UsageError(`--${name} is a whole number, not '${text}'`);
  return number;
}

function state_folder(): string {
  const root = process.env.INDUROP_STATE_DIR
    || (process.getuid?.() === 0 ? "/var/lib/indurop" : join(homedir(), ".local/state/indurop"));
  return join(root, "opcua");
}

function url_of(text: string): URL {
  try {
    const url = new URL(text);
    if (url.protocol === "http:" || url.protocol === "https:") return url;
  } catch {
    // reported below
  }
  throw new UsageError(`--serve is an address such as ${DEFAULT_SERVE}, not '${text}'`);
}

function check_pairs(options: Options): void {
  if (!options.cert !== !options.key) throw new UsageError("--cert and --key belong together");
  if (!options.ca !== !options.revoked) {
    throw new UsageError("--ca and --revoked belong together: without the list, revoked certificates would be accepted");
  }
}

function default_socket(): string {
  return process.env.XDG_RUNTIME_DIR ? join(process.env.XDG_RUNTIME_DIR, "indurop-opcua.sock") : "/run/indurop/opcua.sock";
}

// Returns the options, or the text that was requested instead (help, version). Throws UsageError.
export function read_options(words: string[]): Options | ClientOptions | string {
  const text = { type: "string" } as const;
  const flag = { type: "boolean" } as const;
  let values;
  try {
    ({ values } = parseArgs({
      args: words,
      options: {
        serve: { ...text, default: DEFAULT_SERVE }, "serve-ca": text, "token-file": text, bind: { ...text, default: "127.0.0.1" },
        port: { ...text, default: "4840" }, host: { ...text, multiple: true }, cert: text, key: text, ca: text, revoked: text,
        anonymous: flag, rate: { ...text, default: `${RATE_HZ.usual}` }, sessions: { ...text, default: "32" },
        items: { ...text, default: "60000" }, state: text, client: flag, socket: text, "password-file": text, check: flag, version: flag, help: { ...flag, short: "h" },
      },
    }));
  } catch (error) {
    throw new UsageError((error as Error).message);
  }
  if (values.help) return HELP;
  if (values.version) return `indurop-opcua ${VERSION}\n`;
  const state = values.state ?? state_folder();
  if (values.client) return { socket: values.socket ?? default_socket(), password_file: values["password-file"] ?? "", state };
  if (values.socket !== undefined || values["password-file"] !== undefined) throw new UsageError("--socket and --password-file belong to --client");
  const options: Options = {
    serve: url_of(values.serve!),
    serve_ca: values["serve-ca"] ?? "",
    token_file: values["token-file"] ?? "",
    bind: values.bind!,
    port: whole_of("port", values.port!, 0, HIGHEST_PORT),
    hosts: values.host ?? [],
    cert: values.cert ?? "",
    key: values.key ?? "",
    ca: values.ca ?? "",
    revoked: values.revoked ?? "",
    anonymous: values.anonymous ?? false,
    rate_hz: number_of("rate", values.rate!, RATE_HZ.least, RATE_HZ.highest),
    sessions: whole_of("sessions", values.sessions!, 1, 1000),
    items: whole_of("items", values.items!, 1, 1_000_000),
    state,
    check: values.check ?? false,
  };
  check_pairs(options);
  return options;
}
