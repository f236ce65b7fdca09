// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/order_gate.h"

#include <chrono>
#include <utility>

#include "core/keys/deploy_list.h"

namespace indurop::deploy {
namespace {

constexpr std::chrono::seconds kDecides{60};  // longer than health windows are

}  // namespace

std::string OrderGate::unsigned_by(const Order& order) const {
  std::string why = keys_.refusal(order.plant, order_text(order), order.signature);
  return why.empty()
             ? keys_.refusal(order.plant, grant_text(order.plant, order.deployment, order.generation), order.grant)
             : why;
}

// A deployer who is revoked while boards run his deployment on trial still decides it, so that all boards keep it or
// none does.
bool OrderGate::decides(const Order& order) {
  const Phase phase = transaction_.phase();
  const bool on_trial = (phase == Phase::Trial || phase == Phase::Healthy) && !transaction_.joining() &&
                        transaction_.order().deployer == order.deployer &&
                        transaction_.order().deployment == order.deployment;
  if (!on_trial || !keys::signed_by_any(order_text(order), order.signature, keys_at_begin_)) {
    return false;
  }
  const rt::MonoTime now = rt::MonoClock::now();
  if (decides_until_ == rt::MonoTime{}) {
    decides_until_ = now + kDecides;
  }
  return now < decides_until_;
}

bool OrderGate::accepts(const Order& order, bool updates) {
  if (!deployment_.belongs(order.boards)) {
    return false;
  }
  std::string why = unsigned_by(order);
  if (!why.empty() && decides(order)) {
    return true;
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
  if (accepted && begins) {
    keys_at_begin_ = keys_.trust(order.plant).current().deploy_keys;
    decides_until_ = {};
  }
  if (!accepted && order.step != Step::Abort && refused_ != order.deployer) {
    log_.warning("an order from {} was rejected: {}", order.host, why);
    refused_ = order.deployer;
    reason_ = std::move(why);
  }
  return accepted;
}

}  // namespace indurop::deploy
