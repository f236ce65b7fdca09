// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/send_list.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/exit_code.h"
#include "tools/client/board/board_table.h"
#include "tools/client/text/units.h"

namespace indurop::tools {

int send_list(Context& context, deploy::DeployLink& link, std::uint64_t self, BoardCommander& commander,
              const BoardRoster& roster, const Addressed& boards, const SentList& list) {
  int code = kOk;
  for (const auto& [key, entry] : roster.all()) {
    const bool belongs = entry.report.plant == boards.plant || (boards.idle && entry.report.plant.empty());
    if (!belongs) {
      continue;
    }
    const auto answered = commander.send(link, self, entry.report, list.action, list.text, kSendNs);
    if (answered && answered->reply.outcome == deploy::Outcome::Done) {
      context.out.line(fmt::format("{} {}", key.first, list.taken));
    } else if (answered && answered->reply.outcome == deploy::Outcome::Unchanged) {
      context.out.line(fmt::format("{} {}", key.first, list.unchanged));
    } else {
      context.out.error(fmt::format("{} was not changed: {}", key.first,
                                    printable(answered ? answered->reply.text : answered.error().text)));
      code = answered ? kFailed : answered.error().code;
    }
  }
  for (const std::string& board : missing_boards(roster)) {
    if (std::find(boards.revoked.begin(), boards.revoked.end(), board) != boards.revoked.end()) {
      continue;
    }
    context.out.error(fmt::format(
        "{} was not heard: it keeps the list it has until it is there, and then takes this one from another board",
        board));
    code = kUnreachable;
  }
  return code;
}

}  // namespace indurop::tools
