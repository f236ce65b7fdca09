// SPDX-License-Identifier: Apache-2.0
// Which orders of deployers a board takes; the others get the reason in its reports.

#pragma once

#include <cstdint>
#include <string>

#include "core/base/log.h"
#include "core/rt/clock.h"
#include "deploy/agent/board_deployment.h"
#include "deploy/agent/deploy_keys.h"
#include "deploy/transaction/board_transaction.h"

namespace indurop::deploy {

class OrderGate {
 public:
  // All are borrowed.
  OrderGate(const AgentState& state, const DeployKeys& keys, const BoardDeployment& deployment,
            const BoardTransaction& transaction, const base::Log& log)
      : state_(state), keys_(keys), deployment_(deployment), transaction_(transaction), log_(log) {}

  // Orders addressed to this board are accepted from deployers with permission. `updates`: the platform of the board is
  // being updated.
  bool accepts(const Order& order, bool updates);
  // The order that was rejected last.
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }
  [[nodiscard]] const std::string& reason() const noexcept { return reason_; }

 private:
  [[nodiscard]] std::string unsigned_by(const Order& order) const;
  bool decides(const Order& order);

  const AgentState& state_;
  const DeployKeys& keys_;
  const BoardDeployment& deployment_;
  const BoardTransaction& transaction_;
  const base::Log& log_;
  std::uint64_t refused_ = 0;
  std::string reason_;
  std::string keys_at_begin_;  // text of the deploy.pub that was valid when the deployment under way began
  rt::MonoTime decides_until_;
};

}  // namespace indurop::deploy
