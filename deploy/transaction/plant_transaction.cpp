// SPDX-License-Identifier: Apache-2.0
#include "deploy/transaction/plant_transaction.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "deploy/transaction/board_transaction.h"

namespace indurop::deploy {
namespace {

constexpr std::int64_t kLongestGridNs = 1'000'000'000;  // longer macro periods are not waited for

bool same_progress(const BoardReport& a, const BoardReport& b) {
  return a.phase == b.phase && a.bytes_done == b.bytes_done && a.files_done == b.files_done && a.deployer == b.deployer;
}

}  // namespace

PlantTransaction::PlantTransaction(Order order, std::chrono::nanoseconds patience, rt::MonoTime now,
                                   std::chrono::nanoseconds lost)
    : order_(std::move(order)), patience_(patience), lost_patience_(lost), moved_(now) {
  order_.step = Step::Prepare;
}

void PlantTransaction::abort(Verdict verdict, const std::string& board, const std::string& reason, rt::MonoTime now) {
  if (!board.empty()) {
    reasons_.try_emplace(board, reason);
  }
  if (order_.step == Step::Abort || order_.step == Step::Commit) {
    return;
  }
  verdict_ = switched_ && verdict == Verdict::Refused ? Verdict::RolledBack : verdict;
  order_.step = Step::Abort;
  ending_ = now;
}

void PlantTransaction::receive(const BoardReport& report, rt::MonoTime now) {
  if (std::find(order_.boards.begin(), order_.boards.end(), report.board) == order_.boards.end()) {
    return;
  }
  const auto [known, first] = reports_.try_emplace(report.board, report);
  if (!first) {
    if (known->second.agent != report.agent) {
      abort(Verdict::Refused, report.board, "its agent was started again, or a second one has its name", now);
    }
    if (!same_progress(known->second, report)) {
      moved_ = now;
    }
  }
  const bool was_ours = !first && ours(known->second) && known->second.phase != Phase::Steady;
  known->second = report;
  lost_.erase(report.board);
  if (was_ours && report.phase == Phase::Steady && order_.step != Step::Commit && order_.step != Step::Abort) {
    abort(Verdict::Refused, report.board, report.message.empty() ? "it gave up" : report.message, now);
  }
  judge(report.board, report, now);
}

void PlantTransaction::judge(const std::string& board, const BoardReport& report, rt::MonoTime now) {
  if (report.refused == order_.deployer) {
    abort(Verdict::Refused, board, report.refusal, now);
  }
  if (report.phase == Phase::Failed && ours(report)) {
    const bool check = report.stage == Phase::Checking;
    abort(check ? Verdict::CheckFailed : Verdict::Refused, board, report.message, now);
  }
  if (report.phase == Phase::Steady || ours(report)) {
    busy_since_.erase(board);
  } else if (order_.step == Step::Prepare) {
    busy_since_.try_emplace(board, now);
  }
}

void PlantTransaction::board_lost(const std::string& board, std::uint64_t agent, rt::MonoTime now) {
  const auto known = reports_.find(board);
  if (known == reports_.end() || known->second.agent != agent) {
    return;
  }
  lost_.try_emplace(board, now);
}

void PlantTransaction::miss_lost(rt::MonoTime now) {
  for (auto& [board, silence] : lost_) {
    if (silence.update(now) > lost_patience_) {
      abort(Verdict::Refused, board, "it no longer reports", now);
    }
  }
}

void PlantTransaction::rival(const Order& order, rt::MonoTime now) {
  const bool common = std::any_of(order.boards.begin(), order.boards.end(), [this](const std::string& board) {
    return std::find(order_.boards.begin(), order_.boards.end(), board) != order_.boards.end();
  });
  const bool active = order.step == Step::Prepare || order.step == Step::Switch;
  if (common && active && order_.step == Step::Prepare &&
      (order.step == Step::Switch || order.deployer < order_.deployer)) {
    abort(Verdict::Busy, order.boards.front(),
          fmt::format("busy with deployment {} of {}", shown_id(order.deployment), order.host), now);
  }
}

void PlantTransaction::give_up(rt::MonoTime now) {
  abort(Verdict::Interrupted, {}, {}, now);
}

bool PlantTransaction::all_in(Phase phase) const {
  return std::all_of(order_.boards.begin(), order_.boards.end(), [&](const std::string& board) {
    const auto found = reports_.find(board);
    return found != reports_.end() && !lost_.contains(board) && ours(found->second) && found->second.phase == phase;
  });
}

bool PlantTransaction::all_have_ended() {
  unconfirmed_.clear();
  for (const std::string& board : order_.boards) {
    const auto found = reports_.find(board);
    if (found == reports_.end() || lost_.contains(board)) {
      // This board is not waited for: it rolls back on its own. A commit may still reach it.
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

// An exchange is at an instant at which the macro periods of all boards begin.
void PlantTransaction::all_are_prepared(rt::MonoTime now, rt::WallTime wall) {
  if (order_.way == Way::Compare) {
    abort(Verdict::Compared, {}, {}, now);
    return;
  }
  std::int64_t grid = 1;
  for (const std::string& board : order_.boards) {
    const BoardReport& report = reports_.at(board);
    if (report.way != Way::Exchange) {
      order_.way = Way::Restart;
    }
    const std::int64_t common = report.grid_ns > 0 && report.grid_ns <= kLongestGridNs
                                    ? grid / std::gcd(grid, report.grid_ns) * report.grid_ns
                                    : grid;
    grid = common <= kLongestGridNs ? common : grid;
  }
  const std::int64_t ahead = rt::to_ns(wall + kSwitchAhead);
  order_.step = Step::Switch;
  order_.switch_at_ns = order_.way == Way::Exchange ? (ahead + grid - 1) / grid * grid : ahead;
  switched_ = true;
  moved_ = now;
}

bool PlantTransaction::time(rt::MonoTime now, rt::WallTime wall) {
  order_.said_at_ns = rt::to_ns(wall);
  miss_lost(now);
  if (order_.step == Step::Prepare) {
    for (const auto& [board, since] : busy_since_) {
      if (now - since > kBusy) {
        const BoardReport& report = reports_.at(board);
        abort(Verdict::Busy, board,
              report.deployer_host.empty()
                  ? "busy taking over a deployment it missed"
                  : fmt::format("busy with deployment {} of {}", shown_id(report.proposed), report.deployer_host),
              now);
        break;
      }
    }
  }
  if (order_.step == Step::Prepare && all_in(Phase::Prepared)) {
    all_are_prepared(now, wall);
  } else if (order_.step == Step::Switch && all_in(Phase::Healthy)) {
    order_.step = Step::Commit;
    verdict_ = Verdict::Committed;
    ending_ = now;
  } else if (order_.step == Step::Prepare || order_.step == Step::Switch) {
    std::chrono::nanoseconds limit = patience_;
    if (order_.step == Step::Switch) {
      limit += std::chrono::nanoseconds(order_.health_ns) + BoardTransaction::kSlowStart;
    }
    if (now - moved_ > limit) {
      const Phase wanted = order_.step == Step::Prepare ? Phase::Prepared : Phase::Healthy;
      for (const std::string& board : order_.boards) {
        const auto found = reports_.find(board);
        if (found == reports_.end() || !ours(found->second) || found->second.phase != wanted) {
          const char* at = found == reports_.end() ? "never reported" : to_text(found->second.phase);
          abort(Verdict::Refused, board,
                fmt::format("nothing happened for {} s ({})",
                            std::chrono::floor<std::chrono::seconds>(now - moved_).count(), at),
                now);
          reasons_.try_emplace(board, at);
        }
      }
    }
  } else {
    finished_ = all_have_ended() || now - ending_ > kWindUp;
  }
  return std::exchange(published_, order_.step) != order_.step;
}

}  // namespace indurop::deploy
