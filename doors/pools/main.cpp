// SPDX-License-Identifier: Apache-2.0
// `indurop-pools`: pools of a node to and from other boards, and for tools of DDS.

#include <fmt/format.h>

#include <cstdio>
#include <string_view>
#include <utility>

#include "core/base/exit_code.h"
#include "core/base/print.h"
#include "core/base/stop_signal.h"
#include "doors/pools/door.h"
#include "doors/pools/options.h"

namespace indurop::pool_door {
namespace {

constexpr const char* kDetails =
    R"(Sends a pool as a DDS topic while others read it, or fills a pool from such a topic: modules of the
other board read it as their own. Waits for node and network, and follows a node that is started again.
  indurop-pools --node a --send cell::Vision::camera --hz 10
  indurop-pools --node b --receive cell::Vision::camera
)";

void print_error(std::string_view texts) {
  while (!texts.empty()) {
    const auto end = texts.find('\n');
    base::print(stderr, "indurop-pools: error: {}\n", texts.substr(0, end));
    texts.remove_prefix(end == std::string_view::npos ? texts.size() : end + 1);
  }
}

int run(DoorOptions options) {
  base::StopSignal stop;
  if (options.send.empty() && options.receive.empty()) {
    print_error("nothing to do: name a pool with --send or --receive (indurop get shows those of a node)");
    return kUsage;
  }
  PoolDoor door(std::move(options));
  if (const auto done = door.run(stop); !done) {
    print_error(done.error().text);
    return done.error().code;
  }
  constexpr int kSignalBase = 128;
  return kSignalBase + stop.received();
}

}  // namespace
}  // namespace indurop::pool_door

int main(int argc, char** argv) {
  using namespace indurop;
  base::Options app("indurop-pools", "Pools of a node to and from other boards and DDS tools");
  app.version(INDUROP_VERSION);
  pool_door::DoorOptions options;
  pool_door::declare_options(app, options);
  app.details(pool_door::kDetails);
  app.exit_codes({kOk, kFailed, kUsage, kUnreachable, kSchemaMismatch, kInterrupted, kTerminated});
  if (const auto code = app.parse_program(argc, argv)) {
    return *code;
  }
  return pool_door::run(std::move(options));
}
