// SPDX-License-Identifier: Apache-2.0
#include "tools/client/board/board_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/schema/topic_name.h"
#include "tools/client/node/mirror_view.h"
#include "tools/client/text/units.h"

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

// A message about a deployment that was rolled back is outdated for a board that runs another one well.
Style style_of_message(const deploy::BoardReport& board) {
  const bool well = board.phase == deploy::Phase::Steady && board.node == deploy::NodeCondition::Running;
  return !well ? Style::Bad : board.proposed != board.current ? Style::Dim : Style::Warn;
}

Cell number(std::uint64_t value, Style if_any = Style::None) {
  return {std::to_string(value), value, value > 0 ? if_any : Style::Dim};
}

std::vector<Cell> row(const BoardRoster& roster, const BoardRoster::Entry& entry, std::int64_t now) {
  const deploy::BoardReport& board = entry.report;
  std::string message = printable(board.message);
  Style look = style_of_message(board);
  if (const std::string hosts = roster.twins(board.board, now); !hosts.empty()) {
    message = fmt::format("two agents have this name, on {}", hosts);
    look = Style::Bad;
  }
  const bool steady = board.phase == deploy::Phase::Steady;
  return {Cell(printable(board.board), Style::Bold),
          Cell(printable(board.host)),
          Cell(deploy::to_text(board.node), style_of(board.node)),
          {steady ? "" : deploy::to_text(board.phase), deploy::to_text(board.phase), Style::Warn},
          Cell(printable(board.plant)),
          {board.current.empty() ? "-" : deploy::shown_id(board.current), board.current},
          Cell(printable(board.comment)),
          {"", board.previous},
          {"", board.generation},
          number(board.tick),
          number(board.lost_ticks, Style::Warn),
          number(board.overruns, Style::Warn),
          number(board.faults, Style::Bad),
          {"", board.clock_offset_ns},
          {"", board.release},
          {human_age(now - entry.heard_ns), now - entry.heard_ns},
          Cell(message, look)};
}

Cell read_cell(const std::vector<mirror::MirroredVariable>& variables) {
  std::int64_t oldest = -1;
  for (const mirror::MirroredVariable& variable : variables) {
    oldest = std::max(oldest, variable.age_ns);
  }
  const auto invalid = std::count_if(variables.begin(), variables.end(), [](const auto& v) { return !v.valid; });
  std::string text = std::to_string(variables.size());
  if (invalid > 0) {
    text += fmt::format(", {} not valid", invalid);
  }
  if (oldest >= 0) {
    text += fmt::format(", up to {} old", human_ns(oldest));
  }
  return {text, json_of(variables), invalid > 0 ? Style::Bad : Style::None};
}

Cell pools_cell(const PoolPrograms& programs, std::uint64_t agent) {
  const auto found = programs.find(agent);
  if (found == programs.end()) {
    return {"", JsonValue()};
  }
  const bool running = found->second.state == "running";
  return {printable(found->second.state), json_of(std::optional(found->second)), running ? Style::Good : Style::Warn};
}

}  // namespace

Table board_table(const BoardRoster& roster, std::int64_t now, const BoardAnswers* answers) {
  constexpr Align kRight = Align::Right;
  std::vector<Column> columns({{"BOARD", "board"},
                               {"HOST", "host", Align::Left, 3},
                               {"STATE", "state"},
                               {"DEPLOYING", "phase"},
                               {"PLANT", "plant"},
                               {"DEPLOYMENT", "deployment"},
                               {"COMMENT", "comment", Align::Left, 4},
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
  if (answers != nullptr) {
    columns.insert(columns.end() - 1, {"VARIABLES READ", "variables", Align::Left, 1});
    columns.insert(columns.end() - 1, {"POOLS", "pools", Align::Left, 1});
  }
  Table table(std::move(columns));
  for (const auto& [key, entry] : roster.all()) {
    std::vector<Cell> cells = row(roster, entry, now);
    if (answers != nullptr) {
      const auto reported = answers->read.find(key.second);
      cells.insert(cells.end() - 1,
                   reported == answers->read.end() ? Cell("", JsonValue()) : read_cell(reported->second));
      cells.insert(cells.end() - 1, pools_cell(answers->pools, key.second));
    }
    table.add(std::move(cells));
  }
  return table;
}

void note_others(Messages& messages, const BoardRoster& roster) {
  for (const deploy::OtherAgent& other : roster.others()) {
    messages.error(printable(describe(other, schema::protocol())));
  }
  for (const deploy::Impostor& impostor : roster.impostors()) {
    messages.error(printable(fmt::format("{}; heard {} times", describe(impostor), impostor.reports)));
  }
}

JsonValue json_of_others(const BoardRoster& roster) {
  JsonValue all = JsonValue::array();
  for (const deploy::OtherAgent& other : roster.others()) {
    all.push_back({{"board", other.board}, {"host", other.host}, {"protocol", other.protocol}});
  }
  return all;
}

JsonValue json_of_impostors(const BoardRoster& roster) {
  JsonValue all = JsonValue::array();
  for (const deploy::Impostor& impostor : roster.impostors()) {
    all.push_back({{"claimed", impostor.claimed}, {"board", impostor.board}, {"reports", impostor.reports}});
  }
  return all;
}

std::vector<std::string> missing_boards(const BoardRoster& roster) {
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
