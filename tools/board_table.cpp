// SPDX-License-Identifier: Apache-2.0
#include "tools/board_table.h"

#include <fmt/format.h>

#include <set>

#include "tools/units.h"

namespace indurop::tools {
namespace {

Style style_of(deploy::NodeCondition condition) {
  switch (condition) {
    case deploy::NodeCondition::Running:
      return Style::Good;
    case deploy::NodeCondition::Failed:
      return Style::Bad;
    case deploy::NodeCondition::None:
    case deploy::NodeCondition::Stopped:
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

}  // namespace

Table board_table(const BoardRoster& roster, std::int64_t now) {
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
  for (const auto& [key, entry] : roster.all()) {
    table.add(row(roster, entry, now));
  }
  return table;
}

std::vector<std::string> boards_not_heard(const BoardRoster& roster) {
  std::set<std::string> missing;
  for (const auto& [key, entry] : roster.all()) {
    for (const std::string& member : entry.report.members) {
      if (!entry.report.current.empty() && roster.find(member) == nullptr) {
        missing.insert(member);
      }
    }
  }
  return {missing.begin(), missing.end()};
}

}  // namespace indurop::tools
