// SPDX-License-Identifier: Apache-2.0
// Explains why a board is gone, or its node has ended.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "history/explain/questions.h"
#include "history/explain/words.h"

namespace indurop::explain {
namespace {

// The board is silent; its own facts are known.
Answer silent(const Facts& facts, const Facts& its, const BoardFact& peer, std::vector<std::string> evidence) {
  const std::string& board = peer.name;
  std::int64_t last = 0;
  std::int64_t first = INT64_MAX;
  for (const RunFact& run : its.runs) {
    first = std::min(first, on_clock_of(facts, its, run.start_ns));
    last = std::max(last, on_clock_of(facts, its, run.end_ns));
  }
  evidence.push_back(
      fmt::format("the last run of {} itself that is known was in {} of {}", board, when(facts, last), facts.board));
  const std::int64_t slack = std::max<std::int64_t>(facts.lease_ns, 2 * its.basic_period_ns) + 20'000'000;
  // If nothing is read from a board, it is not known when it fell silent; one that was absent was never received while
  // both ran.
  const bool listened = peer.heard_ns > 0 || peer.state == "absent";
  const std::int64_t since = peer.heard_ns > 0 ? peer.heard_ns : std::max(first, facts.epoch_ns);
  const bool went_on = listened && std::min(last, facts.now_ns) > since + slack;
  if (went_on || its.alive) {
    const BoardFact* back = its.find_peer(facts.board);
    if (back != nullptr) {
      evidence.push_back(fmt::format("{} sees {} as {}", board, facts.board, back->state));
    }
    return {
        Cause::Network, board,
        fmt::format("{} kept running, but nothing was received from it: the network between the two carried nothing",
                    board),
        evidence};
  }
  if (!listened && !its.stop_reason.empty() && last + slack > facts.now_ns) {
    Answer answer = not_known(
        fmt::format("{} reads nothing from {} and does not know when it fell silent; {} itself ran until about the end",
                    facts.board, board, board));
    answer.evidence = evidence;
    return answer;
  }
  if (!its.stop_reason.empty()) {
    return {Cause::Board, board, fmt::format("the node of {} ended: {}", board, its.stop_reason), evidence};
  }
  if (its.closed) {
    Answer answer =
        not_known(fmt::format("the recording of {} ends about then and does not say that it stopped", board));
    answer.evidence = evidence;
    return answer;
  }
  return {Cause::Board, board,
          fmt::format("{} stopped in the middle of its work: it crashed, was killed or lost its power", board),
          evidence};
}

}  // namespace

Answer why_ended(const Facts& facts) {
  if (facts.alive) {
    return {Cause::AllIsWell, {}, fmt::format("the node of {} runs", facts.board), {}};
  }
  std::int64_t last = 0;
  for (const RunFact& run : facts.runs) {
    last = std::max(last, run.end_ns);
  }
  const std::string when_last = last > 0 ? fmt::format("the last run that is known was in {}", when(facts, last))
                                         : std::string("no run of it is known");
  if (!facts.stop_reason.empty()) {
    return {Cause::Board,
            facts.board,
            fmt::format("the node of {} ended: {}", facts.board, facts.stop_reason),
            {when_last}};
  }
  Answer answer = not_known(fmt::format(
      "the recording does not say that {} stopped; give those of other boards, which received from it", facts.board));
  answer.evidence.push_back(when_last);
  return answer;
}

Answer why_gone(std::span<const Facts> plant, std::size_t asked, const std::string& board) {
  const Facts& facts = plant[asked];
  const BoardFact* peer = facts.find_peer(board);
  if (peer == nullptr) {
    return not_known(fmt::format("{} has nothing to do with a board '{}'", facts.node, board));
  }
  std::vector<std::string> evidence;
  if (peer->heard_ns > 0) {
    evidence.push_back(
        fmt::format("{} was last received in {} of {}", board, when(facts, peer->heard_ns), facts.board));
  }
  if (peer->state == "alive") {
    return {Cause::AllIsWell,
            {},
            fmt::format("{} is connected{}", board,
                        peer->losses > 0 ? fmt::format("; it was lost {} times", peer->losses) : std::string()),
            evidence};
  }
  if (peer->state == "mismatched") {
    return {Cause::Board, board, fmt::format("{} is connected, but does not match: {}", board, peer->problem),
            evidence};
  }
  const Facts* its = find_board(plant, board);
  if (its == nullptr) {
    Answer answer =
        not_known(fmt::format("{} is silent, and no data of {} itself is available: it may have ended, or be "
                              "cut off; give its recording too, or ask on its host",
                              board, board));
    answer.evidence = evidence;
    return answer;
  }
  if (its->runs.empty()) {
    return not_known(fmt::format("{} is silent, and its recording holds no run", board));
  }
  return silent(facts, *its, *peer, std::move(evidence));
}

}  // namespace indurop::explain
