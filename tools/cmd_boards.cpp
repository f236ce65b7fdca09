// SPDX-License-Identifier: Apache-2.0
// indurop boards: all boards of the network that have an agent, and what they run.
#include <fmt/format.h>

#include "rt/clock.h"
#include "tools/board_roster.h"
#include "tools/repeat.h"
#include "tools/units.h"
#include "tools/verbs.h"

namespace indurop::tools {
namespace {

struct Options {
  mirror::LinkSettings link;
  std::int64_t wait_ns = 1'000'000'000;
  Repeat repeat;
  std::unique_ptr<mirror::DeployLink> open;
  BoardRoster roster;
};

Style style_of(deploy::NodeCondition condition) {
  switch (condition) {
    case deploy::NodeCondition::Running:
      return Style::Good;
    case deploy::NodeCondition::Failed:
      return Style::Bad;
    case deploy::NodeCondition::None:
      return Style::Dim;
    case deploy::NodeCondition::Starting:
    case deploy::NodeCondition::Stopping:
    case deploy::NodeCondition::Restarting:
      break;
  }
  return Style::Warn;
}

Cell number(std::uint64_t value, Style if_any = Style::None) {
  return {std::to_string(value), value, value > 0 ? if_any : Style::Dim};
}

std::vector<Cell> row(const BoardRoster& roster, const BoardRoster::Entry& entry, std::int64_t now) {
  const deploy::BoardReport& board = entry.report;
  std::string message = printable(board.message);
  if (const std::string hosts = roster.twins(board.board, now); !hosts.empty()) {
    message = fmt::format("two agents have this name, on {}", hosts);
  }
  const bool steady = board.phase == deploy::Phase::Steady;
  return {Cell(printable(board.board), Style::Bold),
          Cell(printable(board.host)),
          Cell(deploy::to_text(board.node), style_of(board.node)),
          {steady ? "" : deploy::to_text(board.phase), deploy::to_text(board.phase), Style::Warn},
          Cell(printable(board.plant)),
          {board.current.empty() ? "-" : deploy::shown_id(board.current), board.current},
          {"", board.previous},
          {"", board.generation},
          number(board.tick),
          number(board.lost_ticks, Style::Warn),
          number(board.overruns, Style::Warn),
          number(board.faults, Style::Bad),
          {"", board.clock_offset_ns},
          {"", board.release},
          {human_age(now - entry.heard_ns), now - entry.heard_ns},
          Cell(message, Style::Bad)};
}

int show(Context& context, Options& options) {
  if (options.open == nullptr) {
    options.open = open_link(context, options.link);
    if (options.open == nullptr) {
      return kUnreachable;
    }
    options.roster.gather(*options.open, options.wait_ns, [] { return false; });
  }
  const std::int64_t now = rt::now_ns();
  options.roster.listen(*options.open, now);
  constexpr Align kRight = Align::Right;
  Table table({{"BOARD", "board"},
               {"HOST", "host", Align::Left, 3},
               {"STATE", "state"},
               {"DEPLOYING", "phase"},
               {"PLANT", "plant"},
               {"DEPLOYMENT", "deployment"},
               {"", "previous"},
               {"", "generation"},
               {"TICK", "tick", kRight, 2},
               {"LOST", "lost_ticks", kRight, 2},
               {"OVERRUNS", "overruns", kRight},
               {"FAULTS", "faults", kRight},
               {"", "clock_offset_ns"},
               {"", "release"},
               {"HEARD", "age_ns", kRight, 1},
               {"MESSAGE", "message"}});
  for (const auto& [key, entry] : options.roster.all()) {
    table.add(row(options.roster, entry, now));
  }
  if (table.empty()) {
    context.out.note(
        fmt::format("no board was heard on domain {} within {}; agents are started with indurop-node "
                    "--agent --board NAME",
                    options.link.domain, human_age(options.wait_ns)));
  }
  print_table(context, table, {{"domain", options.link.domain}}, "boards");
  return table.empty() ? kUnreachable : kOk;
}

Action declare(CLI::App& app, Context& context) {
  auto options = std::make_shared<Options>();
  add_link_options(app, options->link);
  add_time_option(app, "--wait", options->wait_ns, "Listen so long before the first table (default: 1s)");
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  add_repeat_options(app, options->repeat);
  return [options](Context& c) { return repeat_rounds(c, options->repeat, [&] { return show(c, *options); }); };
}

}  // namespace

const Verb kBoardsVerb{
    "boards", "Plants", "Show all boards of the network and what they run",
    "HEARD is the time since the board's last word; agents speak twice a second. Exit code 6 if none was heard.\n",
    &declare};

}  // namespace indurop::tools
