// SPDX-License-Identifier: Apache-2.0
#include "deploy/plant_transaction.h"

#include <fmt/format.h>

#include <algorithm>

#include "deploy/board_transaction.h"

namespace indurop::deploy {
namespace {

bool same_progress(const BoardReport& a, const BoardReport& b) {
  return a.phase == b.phase && a.bytes_done == b.bytes_done && a.files_done == b.files_done && a.deployer == b.deployer;
}

}  // namespace

PlantTransaction::PlantTransaction(Order order, std::int64_t patience_ns, std::int64_t now_ns)
    : order_(std::move(order)), patience_ns_(patience_ns), moved_ns_(now_ns) {
  order_.step = Step::Prepare;
}

void PlantTransaction::abort(Verdict verdict, const std::string& board, const std::string& reason,
                             std::int64_t now_ns) {
  if (!board.empty()) {
    reasons_.try_emplace(board, reason);
  }
  if (order_.step == Step::Abort || order_.step == Step::Commit) {
    return;
  }
  verdict_ = switched_ && verdict == Verdict::Refused ? Verdict::RolledBack : verdict;
  order_.step = Step::Abort;
  ending_ns_ = now_ns;
}

void PlantTransaction::hear(const BoardReport& report, std::int64_t now_ns) {
  if (std::find(order_.boards.begin(), order_.boards.end(), report.board) == order_.boards.end()) {
    return;
  }
  const auto [known, first] = reports_.try_emplace(report.board, report);
  if (!first) {
    if (known->second.agent != report.agent) {
      abort(Verdict::Refused, report.board, "its agent was started again, or a second one has its name", now_ns);
    }
    if (!same_progress(known->second, report)) {
      moved_ns_ = now_ns;
    }
  }
  const bool was_ours = !first && ours(known->second) && known->second.phase != Phase::Steady;
  known->second = report;
  gone_.erase(report.board);
  if (was_ours && report.phase == Phase::Steady && order_.step != Step::Commit && order_.step != Step::Abort) {
    abort(Verdict::Refused, report.board, report.message.empty() ? "it gave up" : report.message, now_ns);
  }
  judge(report.board, report, now_ns);
}

void PlantTransaction::judge(const std::string& board, const BoardReport& report, std::int64_t now_ns) {
  if (report.refused == order_.deployer) {
    abort(Verdict::Refused, board, report.refusal, now_ns);
  }
  if (report.phase == Phase::Failed && ours(report)) {
    const bool check = report.stage == Phase::Checking;
    abort(check ? Verdict::CheckFailed : Verdict::Refused, board, report.message, now_ns);
  }
  if (report.phase == Phase::Steady || ours(report)) {
    busy_since_.erase(board);
  } else if (order_.step == Step::Prepare) {
    busy_since_.try_emplace(board, now_ns);
  }
}

void PlantTransaction::board_gone(const std::string& board, std::uint64_t agent, std::int64_t now_ns) {
  const auto known = reports_.find(board);
  if (known == reports_.end() || known->second.agent != agent) {
    return;
  }
  gone_.insert(board);
  abort(Verdict::Refused, board, "it is not heard any more", now_ns);
}

void PlantTransaction::rival(const Order& order, std::int64_t now_ns) {
  const bool common = std::any_of(order.boards.begin(), order.boards.end(), [this](const std::string& board) {
    return std::find(order_.boards.begin(), order_.boards.end(), board) != order_.boards.end();
  });
  const bool active = order.step == Step::Prepare || order.step == Step::Switch;
  if (common && active && order_.step == Step::Prepare &&
      (order.step == Step::Switch || order.deployer < order_.deployer)) {
    abort(Verdict::Busy, order.boards.front(),
          fmt::format("busy with deployment {} of {}", shown_id(order.deployment), order.host), now_ns);
  }
}

void PlantTransaction::give_up(std::int64_t now_ns) {
  abort(Verdict::Interrupted, {}, {}, now_ns);
}

bool PlantTransaction::all_in(Phase phase) const {
  return std::all_of(order_.boards.begin(), order_.boards.end(), [&](const std::string& board) {
    const auto found = reports_.find(board);
    return found != reports_.end() && ours(found->second) && found->second.phase == phase;
  });
}

bool PlantTransaction::wound_up() {
  unconfirmed_.clear();
  for (const std::string& board : order_.boards) {
    const auto found = reports_.find(board);
    if (found == reports_.end() || gone_.contains(board)) {
      // Nobody waits for it to go back: it does so by itself. A commit may still reach it.
      if (order_.step == Step::Commit) {
        unconfirmed_.push_back(board);
      }
      continue;
    }
    const BoardReport& report = found->second;
    const bool committed = report.current == order_.deployment && report.generation >= order_.generation;
    const bool done = order_.step == Step::Commit ? committed : !ours(report) || report.phase == Phase::Steady;
    const bool settled = order_.step == Step::Commit || !switched_ || report.node == NodeCondition::Running ||
                         report.node == NodeCondition::None || report.node == NodeCondition::Failed ||
                         report.node == NodeCondition::Stopped;
    if (!done || !settled) {
      unconfirmed_.push_back(board);
    }
  }
  return unconfirmed_.empty();
}

bool PlantTransaction::time(std::int64_t now_ns, std::int64_t wall_ns) {
  const Step before = order_.step;
  order_.said_at_ns = wall_ns;
  if (order_.step == Step::Prepare) {
    for (const auto& [board, since] : busy_since_) {
      if (now_ns - since > kBusyNs) {
        const BoardReport& report = reports_.at(board);
        abort(Verdict::Busy, board,
              report.deployer_host.empty()
                  ? "busy taking over a deployment it missed"
                  : fmt::format("busy with deployment {} of {}", shown_id(report.proposed), report.deployer_host),
              now_ns);
        break;
      }
    }
  }
  if (order_.step == Step::Prepare && all_in(Phase::Prepared)) {
    order_.step = Step::Switch;
    order_.switch_at_ns = wall_ns + kSwitchAheadNs;
    switched_ = true;
    moved_ns_ = now_ns;
  } else if (order_.step == Step::Switch && all_in(Phase::Healthy)) {
    order_.step = Step::Commit;
    verdict_ = Verdict::Committed;
    ending_ns_ = now_ns;
  } else if (order_.step == Step::Prepare || order_.step == Step::Switch) {
    const std::int64_t limit =
        patience_ns_ + (order_.step == Step::Switch ? order_.health_ns + BoardTransaction::kSlowStartNs : 0);
    if (now_ns - moved_ns_ > limit) {
      const Phase wanted = order_.step == Step::Prepare ? Phase::Prepared : Phase::Healthy;
      for (const std::string& board : order_.boards) {
        const auto found = reports_.find(board);
        if (found == reports_.end() || !ours(found->second) || found->second.phase != wanted) {
          const char* at = found == reports_.end() ? "never heard" : to_text(found->second.phase);
          abort(Verdict::Refused, board,
                fmt::format("nothing happened for {} s ({})", (now_ns - moved_ns_) / 1'000'000'000, at), now_ns);
          reasons_.try_emplace(board, at);
        }
      }
    }
  } else {
    finished_ = wound_up() || now_ns - ending_ns_ > kWindUpNs;
  }
  return before != order_.step;
}

}  // namespace indurop::deploy
