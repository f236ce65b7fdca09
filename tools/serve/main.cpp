// SPDX-License-Identifier: Apache-2.0
// `indurop-serve`: boards of this host over HTTP and WebSocket. Only reads a node's memory unless --write is given.

#include <fmt/format.h>

#include <cstdio>

#include "core/base/exit_code.h"
#include "core/base/print.h"
#include "core/keys/participant_keys.h"
#include "core/rt/clock.h"
#include "tools/client/process/interrupt.h"
#include "tools/serve/admission.h"
#include "tools/serve/server.h"
#include "tools/serve/users/user_book.h"

namespace indurop::serve {
namespace {

constexpr const char* kDetails = R"(What 'indurop serve' becomes. Prints its address, then serves until SIGTERM.
  indurop-serve --write
  indurop-serve --bind 0.0.0.0 --token-file tokens --cert board.pem --key board.key
)";

int run(const tools::ServeOptions& options) {
  auto admission = admission_of(options);
  if (!admission) {
    base::print(stderr, "indurop-serve: error: {}\n", admission.error().text);
    return admission.error().code;
  }
  if (const std::string exposed = keys::exposed_key(options.key); !options.key.empty() && !exposed.empty()) {
    base::print(stderr, "indurop-serve: warning: {}\n", exposed);
  }
  if (!options.users.empty()) {
    if (const std::string problem = UserBook(options.users, &rt::now_ns).problem(); !problem.empty()) {
      base::print(stderr, "{}", problem);
      return kFailed;
    }
  }
  return Server(options, std::move(admission).value(), INDUROP_VERSION).run();
}

}  // namespace
}  // namespace indurop::serve

int main(int argc, char** argv) {
  using namespace indurop;
  tools::catch_interrupts();
  base::Options app("indurop-serve", "Show boards of this host over HTTP and WebSocket");
  app.version(INDUROP_VERSION);
  tools::ServeOptions options;
  tools::declare_serve_options(app, options);
  app.flag("-q,--quiet", options.quiet, "Print errors only");
  app.details(serve::kDetails);
  app.exit_codes({kOk, kFailed, kUsage, kInterrupted, kTerminated});
  if (const auto code = app.parse_program(argc, argv)) {
    return *code;
  }
  return serve::run(options);
}
