// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/board_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "core/base/read_file.h"
#include "core/rt/clock.h"
#include "tools/client/board/board_texts.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/suggest.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kDiscoverNs = 3'000'000'000;  // agents report twice a second

Failure not_found(const BoardChoice& choice) {
  std::vector<std::string> discovered;
  for (const auto& [key, entry] : choice.roster.all()) {
    discovered.push_back(key.first);
  }
  if (choice.board.empty() && !discovered.empty()) {
    return {kUsage, fmt::format("there are several boards; say which with --board: {}", fmt::join(discovered, ", "))};
  }
  const std::string others = discovered.empty() ? "Agents are started with indurop-agent --board NAME"
                                                : fmt::format("Boards heard: {}", fmt::join(discovered, ", "));
  if (choice.board.empty() || !choice.roster.complete()) {
    return {kUnreachable, fmt::format("{} was heard on domain {} within {}. {}",
                                      choice.board.empty() ? "no board" : "nothing of board " + choice.board,
                                      choice.link.network.domain, human_age(kDiscoverNs), others)};
  }
  return {kUnreachable,
          fmt::format("no agent is named {}.{} {}", choice.board, did_you_mean(choice.board, discovered), others)};
}

const BoardRoster::Entry* chosen(const BoardChoice& choice) {
  const auto& all = choice.roster.all();
  return !choice.board.empty() ? choice.roster.find(choice.board) : all.size() == 1 ? &all.begin()->second : nullptr;
}

Result<BoardRun, Failure> kept_in(const std::string& file) {
  const auto text = base::read_file(file);
  if (!text) {
    return Failure{kFailed, base::cannot_read(file, text.error())};
  }
  auto run = read_run(file, *text);
  if (run) {
    run->kept = true;
  }
  return run;
}

}  // namespace

void add_board_options(base::Options& app, BoardChoice& choice, bool link) {
  app.flag("--remote", choice.remote,
           "Use a board in the network, through its agent, instead of a node on this machine");
  app.add("--board", "NAME", choice.board, "Board to use (default: the only one); implies --remote");
  if (link) {
    deploy::add_link_options(app, choice.link);
  }
}

void add_kept_option(base::Options& app, BoardChoice& choice) {
  app.add("--from", "FILE", choice.file, "Show what an agent kept of a node that died (STATE/BOARD/blackbox)");
}

Result<const BoardRoster::Entry*, Failure> find_board(Context& context, BoardChoice& choice) {
  if (!context.node.empty()) {
    return Failure{kUsage, "--node names a node of this machine; a board in the network is chosen with --board"};
  }
  if (choice.open == nullptr) {
    choice.open = open_link(context.out, choice.link);
    if (choice.open == nullptr) {
      return Failure{kUnreachable, {}};
    }
    const auto enough = [&] {
      return (!choice.board.empty() && chosen(choice) != nullptr) || choice.roster.complete();
    };
    choice.roster.gather(*choice.open, kDiscoverNs, enough);
  } else {
    choice.roster.listen(*choice.open, rt::now_ns());
  }
  if (interrupted()) {
    return Failure{interrupt_code(), {}};
  }
  const BoardRoster::Entry* board = chosen(choice);
  if (board == nullptr) {
    return with_keys_hint(not_found(choice), choice.link);
  }
  if (const std::string hosts = choice.roster.twins(board->report.board, rt::now_ns()); !hosts.empty()) {
    return Failure{kFailed,
                   fmt::format("two agents are named {}, on {}; stop one of them", board->report.board, hosts)};
  }
  return board;
}

Result<BoardRun, Failure> open_run(Context& context, BoardChoice& choice) {
  if (!choice.file.empty()) {
    return kept_in(choice.file);
  }
  if (!choice.wanted()) {
    auto here = open_run(context.node);
    return here ? Result<BoardRun, Failure>(BoardRun{std::move(here).value(), std::nullopt, {}})
                : std::move(here).error();
  }
  const auto board = find_board(context, choice);
  if (!board) {
    return board.error();
  }
  const deploy::BoardReport& report = (*board)->report;
  auto answers = fetch_texts(*choice.open, choice.link.self, deploy::kRunBlob, {report.agent});
  if (interrupted()) {
    return Failure{interrupt_code(), {}};
  }
  const auto answer = answers.find(report.agent);
  return answer == answers.end()
             ? Failure{kUnreachable, fmt::format("the agent of board {} does not answer", report.board)}
             : read_run("board " + report.board, answer->second);
}

}  // namespace indurop::tools
