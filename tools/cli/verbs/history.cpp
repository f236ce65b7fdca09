// SPDX-License-Identifier: Apache-2.0
// indurop history: earlier deployments, as the boards remember them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <tuple>

#include "core/rt/clock.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/board/board_history.h"
#include "tools/client/board/board_roster.h"
#include "tools/client/board/board_table.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

struct HistoryOptions {
  std::string board;
  deploy::LinkSettings link;
  std::int64_t wait_ns = 3'000'000'000;  // less if all are discovered
};

struct HistoryRow {
  PastDeployment past;
  std::vector<std::string> boards;
  bool current = false;
};

// Merges the reports of several boards about one deployment in one row.
void merge(std::vector<HistoryRow>& rows, const std::string& board, const PastDeployment& past, bool current) {
  const auto same = std::find_if(rows.begin(), rows.end(), [&](const HistoryRow& row) {
    return std::tie(row.past.deployment, row.past.generation, row.past.outcome, row.past.host) ==
           std::tie(past.deployment, past.generation, past.outcome, past.host);
  });
  if (same == rows.end()) {
    rows.push_back({past, {board}, current});
    return;
  }
  if (same->boards.back() != board) {
    same->boards.push_back(board);
  }
  same->current = same->current || current;
}

Table table_of(const std::vector<HistoryRow>& rows) {
  Table table({{"", "generation"},
               {"", "current"},
               {"DEPLOYMENT", "deployment"},
               {"PLANT", "plant"},
               {"WHEN", "wall_ns"},
               {"FROM", "host"},
               {"BOARDS", "boards"},
               {"OUTCOME", "outcome"},
               {"COMMENT", "comment"}});
  for (const HistoryRow& row : rows) {
    const bool committed = row.past.outcome == "committed";
    table.add({{"", row.past.generation},
               {"", row.current},
               {deploy::shown_id(row.past.deployment) + (row.current ? " *" : ""), row.past.deployment, Style::Bold},
               Cell(printable(row.past.plant)),
               {local_time(row.past.wall_ns), row.past.wall_ns},
               Cell(printable(row.past.host)),
               {fmt::format("{}", fmt::join(row.boards, ", ")), row.boards},
               {printable(row.past.outcome), row.past.outcome, committed ? Style::Good : Style::Bad},
               Cell(printable(row.past.comment))});
  }
  return table;
}

int history(Context& context, HistoryOptions& options) {
  auto link = open_link(context.out, options.link);
  if (link == nullptr) {
    return kUnreachable;
  }
  BoardRoster roster;
  roster.gather(*link, options.wait_ns,
                [&] { return options.board.empty() ? roster.complete() : roster.find(options.board) != nullptr; });
  const auto histories = fetch_histories(*link, options.link.self, roster.agents());
  roster.listen(*link, rt::now_ns());
  std::vector<HistoryRow> rows;
  std::vector<std::string> missing = options.board.empty() ? missing_boards(roster) : std::vector<std::string>();
  bool found = false;
  for (const auto& [key, entry] : roster.all()) {
    if (!options.board.empty() && key.first != options.board) {
      continue;
    }
    found = true;
    const auto reported = histories.find(key.second);
    if (reported == histories.end()) {
      missing.push_back(key.first);
      continue;
    }
    for (const PastDeployment& past : reported->second) {
      const bool current = past.deployment == entry.report.current && past.generation == entry.report.generation;
      merge(rows, key.first, past, current && past.outcome == "committed");
    }
  }
  if (!found) {
    context.out.error(
        (options.board.empty() ? "no board was heard" : fmt::format("board {} was not heard", options.board)) +
        keys_hint(options.link));
    return kUnreachable;
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const HistoryRow& a, const HistoryRow& b) { return a.past.generation < b.past.generation; });
  const Table table = table_of(rows);
  for (const std::string& board : missing) {
    context.out.error(
        fmt::format("board {} was not heard or did not answer: its history is not in this list", printable(board)));
  }
  if (table.empty() && missing.empty()) {
    context.out.note("nothing was deployed yet");
  }
  print_table(context, table, {{"missing", missing}}, "deployments");
  return missing.empty() ? kOk : kUnreachable;
}

Action declare_history(base::Options& app, Context& context) {
  auto options = std::make_shared<HistoryOptions>();
  app.add("--board", "NAME", options->board, "Only the history of this board");
  deploy::add_link_options(app, options->link);
  add_time_option(app, "--wait", options->wait_ns, "Maximum time to wait for boards (default: 3s)");
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return history(c, *options); };
}

}  // namespace

const Verb kHistoryVerb{
    "history", "Plants", "Show the deployments of the boards and their outcomes",
    "The oldest is listed first; * marks what runs now. indurop rollback ID goes back to a deployment that was\n"
    "committed. Exit code 6 if a board does not report or answer: it is named, and missing from the list.\n"
    "Examples:\n"
    "  indurop history\n"
    "  indurop history --board press_1 -o json\n",
    &declare_history};

}  // namespace indurop::tools
