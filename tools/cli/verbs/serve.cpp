// SPDX-License-Identifier: Apache-2.0
// indurop serve: executes indurop-serve in its place.
#include <memory>

#include "tools/cli/command/become_server.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/console/serve_options.h"

namespace indurop::tools {
namespace {

Action declare_serve(base::Options& app, Context& /*context*/) {
  auto options = std::make_shared<ServeOptions>();
  declare_serve_options(app, *options);
  return [options](Context& c) { return become_server(c, *options); };
}

}  // namespace

const Verb kServeVerb{
    "serve", "A running node", "Show boards of this host to browsers and programs, over HTTP and WebSocket",
    "This command becomes indurop-serve and prints its address. It shows running nodes and those that start\n"
    "later, without disturbing them. Without options it can be reached only from this machine, and nothing can be\n"
    "written. With --write it prints a token: clients that have the token may set, force, start and stop. The\n"
    "interface is described in docs/serve.md.\n"
    "Examples:\n"
    "  indurop serve\n"
    "  indurop serve --write --port 9000\n"
    "  indurop serve --bind 0.0.0.0 --write --token-file tokens --cert board.pem --key board.key\n",
    &declare_serve};

}  // namespace indurop::tools
