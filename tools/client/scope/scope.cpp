// SPDX-License-Identifier: Apache-2.0
#include "tools/client/scope/scope.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/rt/clock.h"
#include "store/vars/store.h"
#include "tools/client/node/node_choice.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kAutoNs = 500'000'000;

Failure no_tape(const std::string& node, const Error& error) {
  if (error.code == Errc::NotFound) {
    return {kFailed, fmt::format("node '{}' keeps no tape: start it without --tape 0", node)};
  }
  return {exit_code_of(error), fmt::format("the tape of node '{}' cannot be read: {}", node, error.where)};
}

std::uint64_t rows_of(const ScopeOrder& order) {
  return order.pre + 1 + order.post;
}

std::optional<Failure> too_much(const ScopeOrder& order, const ScopePlan& plan) {
  std::uint64_t lines = 0;
  for (const ScopeChannel& channel : plan.channels) {
    lines += channel.lines.size();
  }
  if (lines == 0) {
    return Failure{kUsage, "which variables? Name them (see: indurop help scope)"};
  }
  const std::uint64_t most = std::min(kMostScopeRows, kMostScopeNumbers / lines);
  if (order.pre >= most || order.post >= most || rows_of(order) > most) {
    return Failure{kUsage,
                   fmt::format("at most {} ticks of so many values; take fewer of either, or indurop record", most)};
  }
  return std::nullopt;
}

}  // namespace

Result<Scope, Failure> Scope::open(const std::string& node, const ScopeOrder& order) {
  auto chosen = open_run(node);
  if (!chosen) {
    return std::move(chosen).error();
  }
  auto store = vars::Store::attach(chosen->node, vars::Mode::ReadOnly);
  if (!store) {
    return Failure{exit_code_of(store.error()), explain_open_error(store.error(), chosen->node, false)};
  }
  auto follower = tape::Follower::open(chosen->node, true);
  if (!follower) {
    return no_tape(chosen->node, follower.error());
  }
  if (follower->header().node_pid != chosen->run.block().node_pid.load()) {
    return no_tape(chosen->node, Error{Errc::NotFound, 0, "of another run"});
  }
  if (follower->header().layout_hash != store->header().layout_hash) {
    return Failure{kFailed, "the node's variables have just changed: try again"};
  }
  auto plan = plan_scope(store->schema(), order.channels, order.trigger);
  if (!plan) {
    return Failure{kFailed, plan.error().text};
  }
  if (auto refused = too_much(order, *plan)) {
    return *std::move(refused);
  }
  auto sampler = TickSampler::create(std::move(follower).value(), chosen->run, *store, plan->inputs);
  if (!sampler) {
    return Failure{kFailed, sampler.error().text};
  }
  Scope scope(chosen->node, order, std::move(plan).value(), std::move(chosen->run), std::move(sampler).value());
  scope.real_minus_node_ns_ = rt::wall_ns() - rt::to_ns(store->now());
  return scope;
}

bool Scope::over() const {
  const auto state = run_.block().state.load();
  return state == scheduler::NodeState::Stopped || state == scheduler::NodeState::Failed || !run_.node_alive();
}

// Returns true if the capture is complete with this tick.
bool Scope::add(std::uint64_t tick, std::span<const double> inputs) {
  std::vector<double> row;
  if (rows_.size() >= rows_of(order_)) {
    row = std::move(rows_.front());
    rows_.pop_front();
    row.clear();
  }
  for (const ScopeChannel& channel : plan_.channels) {
    for (const ScopeLine& line : channel.lines) {
      row.push_back(line.formula.value(inputs));
    }
  }
  rows_.push_back(std::move(row));
  newest_tick_ = tick;
  const bool hit = !plan_.trigger || plan_.trigger->evaluate(inputs);
  if (!live_ && !(order_.past && tick > order_.after_tick)) {
    return false;
  }
  ++ticks_;
  if (!fired_ && hit) {
    fired_ = tick;
  }
  if (fired_) {
    return tick - *fired_ >= order_.post;
  }
  const auto wait = static_cast<std::uint64_t>(kAutoNs / sampler_.period_ns());
  due_tick_ = due_tick_ == 0 ? tick + std::max(rows_of(order_), wait) : due_tick_;
  return order_.mode == ScopeMode::Auto && tick >= due_tick_;
}

Capture Scope::picture() {
  Capture capture;
  capture.channels = plan_.channels;
  capture.trigger = order_.trigger;
  capture.period_ns = sampler_.period_ns();
  capture.first_tick = newest_tick_ + 1 - rows_.size();
  capture.first_ns = sampler_.time_of(capture.first_tick);
  capture.first_wall_ns = capture.first_ns + real_minus_node_ns_;
  capture.lost_runs = sampler_.lost() - lost_before_;
  if (fired_ && plan_.trigger) {
    capture.trigger_row = static_cast<std::size_t>(*fired_ - capture.first_tick);
  }
  capture.lines.resize(rows_.front().size());
  for (std::size_t line = 0; line < capture.lines.size(); ++line) {
    for (const std::vector<double>& row : rows_) {
      capture.lines[line].push_back(row[line]);
    }
  }
  fired_.reset();
  due_tick_ = 0;
  lost_before_ = sampler_.lost();
  return capture;
}

std::optional<Capture> Scope::poll() {
  sampler_.take();
  std::uint64_t tick = 0;
  for (auto inputs = sampler_.next(tick); !inputs.empty(); inputs = sampler_.next(tick)) {
    if (add(tick, inputs)) {
      return picture();
    }
  }
  live_ = true;
  return std::nullopt;
}

}  // namespace indurop::tools
