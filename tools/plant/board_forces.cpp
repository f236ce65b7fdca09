// SPDX-License-Identifier: Apache-2.0
#include "tools/plant/board_forces.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/command/units.h"
#include "tools/plant/board_commander.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kPatienceNs = 5'000'000'000;

int command(Context& context, BoardForces& options, deploy::Action action, const std::string& target) {
  auto commander = BoardCommander::make(context, options.board.link.keys);
  if (!commander) {
    return report(context.out, commander.error());
  }
  const auto board = find_board(context, options.board);
  if (!board) {
    return report(context.out, board.error());
  }
  const deploy::BoardReport& there = (*board)->report;
  const auto answered =
      commander->give(*options.board.open, options.board.link.self, there, action, target, kPatienceNs);
  if (!answered) {
    context.out.error(fmt::format("board {}: {}", there.board, answered.error().text));
    return answered.error().code;
  }
  if (answered->reply.outcome != deploy::Outcome::Done) {
    context.out.error(fmt::format("board {}: {}", there.board, printable(answered->reply.text)));
    return kFailed;
  }
  return kOk;
}

}  // namespace

void add_board_force_options(base::Options& app, BoardForces& options) {
  add_board_options(app, options.board);
}

int force_on_board(Context& context, BoardForces& options, std::vector<std::string> assignments, std::int64_t for_ns) {
  if (assignments.size() == 2 && assignments[0].find('=') == std::string::npos) {
    assignments = {assignments[0] + "=" + assignments[1]};
  }
  return command(context, options, deploy::Action::Force, fmt::format("{}\n{}", for_ns, fmt::join(assignments, "\n")));
}

int unforce_on_board(Context& context, BoardForces& options, const std::vector<std::string>& names) {
  return command(context, options, deploy::Action::Unforce,
                 names.empty() ? "*" : fmt::format("{}", fmt::join(names, "\n")));
}

}  // namespace indurop::tools
