// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/discovered_boards.h"

#include "core/rt/clock.h"
#include "tools/client/process/interrupt.h"

namespace indurop::tools {

void DiscoveredBoards::refresh(const std::string& only) {
  roster.listen(*link, rt::now_ns());
  reports.clear();
  for (const auto& [key, entry] : roster.all()) {
    if (only.empty() || key.first == only) {
      reports.push_back(entry.report);
    }
  }
}

Result<DiscoveredBoards, Failure> discover_boards(Context& context, deploy::LinkSettings& link,
                                                  const std::string& only) {
  constexpr std::int64_t kDiscoverNs = 3'000'000'000;  // agents report twice a second
  DiscoveredBoards boards{open_link(context.out, link), {}, {}};
  if (boards.link == nullptr) {
    return Failure{kUnreachable, {}};
  }
  const BoardRoster& roster = boards.roster;
  boards.roster.gather(*boards.link, kDiscoverNs,
                       [&] { return only.empty() ? roster.complete() : roster.find(only) != nullptr; });
  if (interrupted()) {
    return Failure{interrupt_code(), {}};
  }
  boards.refresh(only);
  if (boards.reports.empty()) {
    return with_keys_hint({kUnreachable, only.empty() ? "no board was heard" : "board " + only + " was not heard"},
                          link);
  }
  return boards;
}

}  // namespace indurop::tools
