// SPDX-License-Identifier: Apache-2.0
// `indurop-opcua --client`: devices of the driver `opcua` in ioconfig.xml (docs/io.md). The I/O modules of this machine's
// nodes connect to a socket, each device by a connection of its own.

import { chmod, mkdir, readFile, stat, unlink } from "node:fs/promises";
import { connect, createServer, type Socket } from "node:net";
import { dirname, join } from "node:path";

import { make_certificate_manager } from "../certificates";
import { log, message_of } from "../log";
import type { ClientOptions } from "../options";
import { device_of, line_of, lines_of, request_of } from "./protocol";
import { reason_of, Remote, type Trust } from "./remote";

const MOST_DEVICES = 100;

// Lines `USER PASSWORD`; the password may have spaces.
async function read_passwords(file: string): Promise<Map<string, string>> {
  if (!file) return new Map();
  if (((await stat(file)).mode & 0o077) !== 0) throw new Error(`${file}: others can read it; chmod 600 it`);
  const lines = (await readFile(file, "utf8")).split("\n").filter((line) => line.trim() && !line.startsWith("#"));
  return new Map(lines.map((line) => [line.split(" ", 1)[0], line.slice(line.indexOf(" ") + 1)]));
}

// What happens to a device, unless it is what happened last: modules try again and again.
const last = new Map<string, string>();
function report(device: string, what: string): void {
  if (last.get(device) !== what) log(`${device}: ${what}`);
  last.set(device, what);
}

async function serve(socket: Socket, trust: Trust, passwords: Map<string, string>): Promise<void> {
  const lines = lines_of(socket);
  const first = await lines.next();
  if (first.done) return;
  const device = device_of(first.value);
  let remote: Remote | undefined;
  try {
    if (device.user && !passwords.has(device.user)) throw new Error(`no password of user ${device.user}; add it to --password-file`);
    remote = await Remote.connect(device, trust, passwords.get(device.user) ?? "");
    report(device.device, `connected to ${device.url}`);
    socket.write(line_of({ ready: true }));
    for await (const line of lines) socket.write(line_of(await remote.exchange(request_of(line, device.outputs.length))));
  } catch (error) {
    socket.end(line_of({ problem: reason_of(error, device) }));
    report(device.device, reason_of(error, device));
  } finally {
    await remote?.close();
  }
}

// A socket that a killed program left is replaced; that of one that runs is not.
async function make_room(path: string): Promise<void> {
  const found = await stat(path).catch(() => undefined);
  if (!found) return;
  if (!found.isSocket()) throw new Error(`${path} is something else than a socket; name another one with --socket`);
  const is_used = await new Promise<boolean>((done) => {
    const socket = connect(path, () => { socket.destroy(); done(true); });
    socket.on("error", () => done(false));
  });
  if (is_used) throw new Error(`another indurop-opcua --client serves ${path}; name another socket with --socket`);
  await unlink(path);
}

export async function run_client(options: ClientOptions): Promise<void> {
  const trust = await make_certificate_manager(join(options.state, "client"), false);
  const passwords = await read_passwords(options.password_file);
  await mkdir(dirname(options.socket), { recursive: true });
  await make_room(options.socket);
  const server = createServer((socket) => {
    socket.on("error", () => undefined);
    serve(socket, trust, passwords).catch((error) => {
      log(message_of(error));
      socket.destroy();
    });
  });
  server.maxConnections = MOST_DEVICES;
  await new Promise<void>((done, fail) => server.once("error", fail).listen(options.socket, done));
  await chmod(options.socket, 0o660);
  process.stdout.write(`${options.socket}\n`);
  for (const signal of ["SIGTERM", "SIGINT"]) {
    process.on(signal, () => {
      server.close();
      process.exit(0);
    });
  }
}
