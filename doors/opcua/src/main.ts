// SPDX-License-Identifier: Apache-2.0
// indurop-opcua: the boards of an `indurop serve` over OPC UA; with --client, other servers for I/O modules. Begin reading here: options, the server, the boards, clients.

import type { Namespace } from "node-opcua";

import { run_client } from "./client/client";
import { log, message_of, take_messages } from "./log";
import { read_options, UsageError, type ClientOptions, type Options } from "./options";
import { Programs } from "./plc/programs";
import { Robots } from "./robotics/robots";
import { read_token, ServeClient } from "./serve/http";
import type { ServerStatus } from "./serve/types";
import { Alarms } from "./server/alarms";
import { make_call } from "./server/call";
import { Every } from "./server/every";
import { History } from "./server/history";
import { Items } from "./server/items";
import { make_server, set_permissions, warn_about } from "./server/server";
import { Users } from "./server/users";
import { make_write } from "./server/write";
import { Boards } from "./space/boards";
import { Methods } from "./space/methods";
import type { Space } from "./space/tree";
import { Types } from "./space/types";
import type { PartNode } from "./space/variable";

const EXIT_USAGE = 2;

async function run(options: Options): Promise<void> {
  const client = new ServeClient(options.serve, options.serve_ca, options.token_file ? read_token(options.token_file) : "");
  const about = await client.get<ServerStatus>("status");
  warn_about(options);
  const users = new Users(client, about.users);
  const server = await make_server(options, users);
  const address_space = server.engine.addressSpace!;
  const namespace = address_space.getNamespace(set_permissions(server)) as Namespace;
  const boards = new Boards(client, options.rate_hz);
  const by_node = new Map<string, PartNode>();
  const types = new Types(address_space, namespace);
  const space: Space = {
    address_space, namespace, by_node, types,
    follow: boards.follow,
    rate_hz: options.rate_hz,
    writable: about.write,
    write: make_write(client, users, by_node),
    read_history: new History(client, by_node, (board) => boards.trees.get(board)?.layout, types.construct).make_read(),
  };
  boards.space = space;
  boards.methods = new Methods(space, make_call(client, users, types.construct));
  boards.robots = new Robots(client, space, about.version);
  boards.programs = new Programs(client, space, about.version);
  const alarms = new Alarms(client, users, boards, space);
  await boards.begin();
  if (options.check) {
    process.stdout.write(`${boards.trees.size} boards, ${by_node.size} variables and parts, ${boards.programs.size} of PLC programs\n`);
    boards.stop();
    await server.shutdown(0);
    return;
  }
  const every = new Every(client, (board) => boards.trees.get(board)?.layout, types.construct);
  new Items({
    part: (node) => by_node.get(node),
    any: (node) => by_node.get(node) ?? boards.robots.find(node) ?? boards.programs.find(node),
  }, boards.follow, every, options.rate_hz).begin(server);
  users.begin(server);
  alarms.begin();
  await server.start();
  process.stdout.write(`${server.getEndpointUrl()}\n`);

  let ending = false;
  const end = async (): Promise<void> => {
    if (ending) return;
    ending = true;
    alarms.stop();
    every.stop();
    boards.stop();
    await users.stop();
    await server.shutdown(0);
    process.exit(0);
  };
  process.on("SIGTERM", () => void end());
  process.on("SIGINT", () => void end());
}

async function main(): Promise<void> {
  let options: Options | ClientOptions | string;
  try {
    options = read_options(process.argv.slice(2));
  } catch (error) {
    if (!(error instanceof UsageError)) throw error;
    process.stderr.write(`indurop-opcua: ${error.message}; --help lists all options\n`);
    process.exit(EXIT_USAGE);
  }
  if (typeof options === "string") {
    process.stdout.write(options);
    return;
  }
  // One client's message must not end the program for all: node-opcua throws at some that are malformed.
  process.on("uncaughtException", (error) => log(`a message was not understood: ${error.message}`));
  process.on("unhandledRejection", (error) => log(`a message was not understood: ${message_of(error)}`));
  take_messages();
  await ("socket" in options ? run_client(options) : run(options));
}

main().catch((error) => {
  process.stderr.write(`indurop-opcua: ${message_of(error)}\n`);
  process.exit(1);
});
