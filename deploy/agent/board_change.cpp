// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/board_change.h"

#include <utility>

namespace indurop::deploy {

void BoardChange::resume() {
  keep_folder_of_node();
  BoardExchange::settle(board_, state_);
}

void BoardChange::begin() {
  exchange_.forget_plan();
}

void BoardChange::load(const Order& order) {
  exchange_.load({state_.committed().current, order.deployment, order.way == Way::Compare,
                  process_.condition() == NodeCondition::Running && process_.held().empty()});
}

void BoardChange::enter(const Order& order, rt::MonoTime at, bool alone) {
  log_.info("deployment {}: changing without a restart", shown_id(order.deployment));
  held_before_.clear();
  process_.begin_trial();
  exchange_.enter(at, alone);
}

void BoardChange::restart(const Order& order) {
  log_.info("deployment {}: switching", shown_id(order.deployment));
  exchange_.decide(state_.committed().current);
  held_before_ = process_.held();
  process_.want(deployment_.manifest(order.deployment), order.deployment);
}

void BoardChange::commit(const Order& order) {
  keep_folder_of_node();
  process_.end_trial(true);
  exchange_.decide(order.deployment);
}

void BoardChange::go_back(Way way) {
  keep_folder_of_node();
  const std::string& before = state_.committed().current;
  if (way == Way::Exchange) {
    process_.go_on_as(deployment_.manifest(before), before);
    process_.end_trial(false);
    exchange_.decide(before);
  } else {
    process_.want(deployment_.manifest(before), before);
  }
  if (!held_before_.empty()) {
    process_.hold(held_before_);
  }
}

void BoardChange::forget() {
  keep_folder_of_node();
  process_.end_trial(false);
  exchange_.decide(state_.committed().current);
}

std::optional<BoardExchange::Answer> BoardChange::poll(const Order& order) {
  auto answer = exchange_.poll();
  if (answer && answer->what == BoardExchange::Done::Entered && answer->problem.empty()) {
    log_.info("deployment {}: its modules run", shown_id(order.deployment));
    process_.go_on_as(deployment_.manifest(order.deployment), order.deployment);
  } else if (answer && answer->what == BoardExchange::Done::Decided && !answer->problem.empty()) {
    log_.error("modules cannot be exchanged back: {}; the node starts again", answer->problem);
    process_.renew();
  }
  return answer;
}

BoardProcess::Health BoardChange::health(const Order& order) {
  BoardProcess::Health health = process_.health(order.boards);
  if (std::string returned = exchange_.returned(); !returned.empty()) {
    health.problem = std::move(returned);
  }
  return health;
}

}  // namespace indurop::deploy
