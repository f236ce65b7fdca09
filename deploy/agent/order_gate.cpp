// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/order_gate.h"

#include <utility>

namespace indurop::deploy {

bool OrderGate::accepts(const Order& order, bool updates) {
  if (!deployment_.belongs(order.boards)) {
    return false;
  }
  std::string why = keys_.refusal(order.plant, order_text(order), order.signature);
  if (why.empty()) {
    why = keys_.refusal(order.plant, grant_text(order.plant, order.deployment, order.generation), order.grant);
  }
  const bool begins = order.step == Step::Prepare && transaction_.phase() == Phase::Steady;
  if (why.empty() && begins && order.generation <= state_.committed().generation &&
      order.deployer != transaction_.order().deployer) {
    why = "this board has a newer deployment than that; deploy again";
  }
  if (why.empty() && begins && updates) {
    why = "the platform of this board is being updated";
  }
  const bool accepted = why.empty();
  if (!accepted && order.step == Step::Prepare && refused_ != order.deployer) {
    log_.warning("an order from {} was rejected: {}", order.host, why);
    refused_ = order.deployer;
    reason_ = std::move(why);
  }
  return accepted;
}

}  // namespace indurop::deploy
