// SPDX-License-Identifier: Apache-2.0
// `indurop-iceoryx`: publishes values of a node as iceoryx topics. Only reads the node's memory; whatever happens to
// this program, to RouDi or to subscribers does not affect the node.

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cstddef>
#include <cstring>

#include "core/rt/clock.h"
#include "tools/client/process/gentle.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/values/watch_source.h"
#include "tools/console/context.h"
#include "tools/iceoryx/publisher.h"
#include "tools/iceoryx/supervisor.h"

namespace indurop::iceoryx {
namespace {

constexpr const char* kDetails = R"(Topics: service "InduRoP", instance NODE, event the full name of the variable;
the bytes are those of the C struct. A value is sent when it changed; who
subscribes later gets the last one (ask for a history of 1).

Needs iceoryx's daemon: iox-roudi. Waits for it and survives its restart.
  indurop-iceoryx --node cell 'knu::*'
)";

// Reports variables that iceoryx cannot publish; returns true if there are none.
bool publishable(tools::Context& context, const tools::WatchSource& source) {
  bool fine = true;
  for (const auto& value : source.values()) {
    const std::string& whole = value.item.place.variable->name;
    if (value.item.name != whole) {
      context.out.error(fmt::format("{} is a part; variables are published whole: {}", value.item.name, whole));
      fine = false;
    } else if (whole.size() > longest_name()) {
      context.out.error(fmt::format("the name of {} has {} letters, iceoryx allows {}; leave it out with a GLOB", whole,
                                    whole.size(), longest_name()));
      fine = false;
    }
  }
  if (source.values().size() > most_topics()) {
    context.out.error(fmt::format("{} variables are selected, iceoryx has publishers for {}; select fewer with a GLOB",
                                  source.values().size(), most_topics()));
    fine = false;
  }
  return fine;
}

// A second gateway of the same node would disconnect the first from RouDi. The lock ends with the last process of a
// gateway: this waits for the remaining processes of one that was killed.
bool only_one(tools::Context& context, const std::string& node) {
  const int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = "indurop-iceoryx-" + node;  // after a zero: an abstract name, not a file
  std::memcpy(address.sun_path + 1, name.data(), name.size());
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  constexpr std::int64_t kSecond = 1'000'000'000;
  const std::int64_t deadline = rt::now_ns() + (kStuckSeconds + 2) * kSecond;
  while (bind(fd, reinterpret_cast<const sockaddr*>(&address), size) != 0) {
    if (rt::now_ns() > deadline || tools::interrupted()) {
      context.out.error(fmt::format("another indurop-iceoryx publishes node '{}' already; stop it first", node));
      return false;
    }
    tools::wait_until(rt::now_ns() + kSecond / 10);
  }
  return true;  // the socket stays open until the end
}

int run(tools::Context& context, std::vector<std::string> names, int hz) {
  if (names.empty()) {
    names.emplace_back("*");
  }
  tools::WatchSource source(context.node, std::move(names));
  if (const auto opened = source.open(context); !opened) {
    return tools::report(context.out, opened.error());
  }
  if (!publishable(context, source)) {
    return kUsage;
  }
  if (!only_one(context, source.node())) {
    return kFailed;
  }
  tools::be_gentle(source.node());
  return supervise(context, source, hz);
}

}  // namespace
}  // namespace indurop::iceoryx

int main(int argc, char** argv) {
  using namespace indurop;
  tools::catch_interrupts();
  tools::Context context;
  base::Options app("indurop-iceoryx", "Publish shared variables of a node as iceoryx topics");
  app.version(INDUROP_VERSION);
  std::vector<std::string> names;
  int hz = 100;
  app.add("names", "GLOB", names, "Variables, whole; default all").completes(base::Completion::Variable);
  tools::add_node_option(app, context);
  app.add("--hz", "RATE", hz, "How often per second to look for changes (default 100)").range(1, 1000);
  app.details(iceoryx::kDetails);
  app.exit_codes({kOk, kFailed, kUsage, kUnreachable, kInterrupted, kTerminated});
  if (const auto code = app.parse_program(argc, argv)) {
    return *code;
  }
  return iceoryx::run(context, std::move(names), hz);
}
