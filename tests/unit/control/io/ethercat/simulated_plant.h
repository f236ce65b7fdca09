// SPDX-License-Identifier: Apache-2.0
// A master and simulated drives on one wire, in virtual time, and what happened on it.

#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "control/io/ethercat/master/master.h"
#include "control/io/ethercat/simulator/bus.h"
#include "slaves.h"

namespace indurop::io::ethercat {

inline constexpr Clock kTick = std::chrono::milliseconds(1);

inline std::vector<SlavePlan> drive_plans(std::size_t count) {
  std::vector<SlavePlan> plans;
  for (std::size_t i = 0; i < count; ++i) {
    plans.push_back(plan_of(drive_sii(), static_cast<std::uint32_t>(0x10000 + 0x100 * i)));
    plans.back().start_objects.push_back({0x6060, 0, false, {8}});
    plans.back().start_objects.push_back(
        {0x2000, 0, false, std::vector<std::uint8_t>(150, static_cast<std::uint8_t>(i))});
    plans.back().safe_outputs = {0x06, 0, 0, 0, 0, 0};
  }
  return plans;
}

// The simulated slave to one of these plans.
inline SlaveConfig config_of(const SlavePlan& plan) {
  SlaveConfig config = drive_config();
  if (!plan.uses_lrw) {
    config.esc.features |= kNoLrw;
  }
  return config;
}

// Plans for slaves of which some do not run LRW: those whose bit is set.
inline std::vector<SlavePlan> without_lrw(std::vector<SlavePlan> plans, std::uint64_t slaves) {
  for (std::size_t i = 0; i < plans.size(); ++i) {
    plans[i].uses_lrw = (slaves >> i & 1U) == 0;
  }
  return plans;
}

inline bool all_operate(const Master& master) {
  for (std::size_t i = 0; i < master.size(); ++i) {
    if (!master.slave(i).operates()) {
      return false;
    }
  }
  return true;
}

class Plant {
 public:
  explicit Plant(std::size_t count, std::vector<SlavePlan> plans) : applied_(count) {
    for (std::size_t i = 0; i < count; ++i) {
      bus_.segment().add(config_of(plans[i]), [this, i](Bytes outputs, std::span<std::uint8_t> inputs) {
        if (!outputs.empty()) {
          applied_[i].assign(outputs.begin(), outputs.end());
          reflect(outputs, inputs);
        }
      });
    }
    master_ = std::make_unique<Master>(bus_, std::move(plans), kTick);
  }
  explicit Plant(std::size_t count) : Plant(count, drive_plans(count)) {}
  // With the slaves that `build` adds.
  Plant(std::vector<SlavePlan> plans, const std::function<void(Segment&)>& build) : applied_(plans.size()) {
    build(bus_.segment());
    master_ = std::make_unique<Master>(bus_, std::move(plans), kTick);
  }

  void tick() {
    now_ += kTick + Clock(master_->clocks().tick_correction());
    bus_.advance(now_);
    master_->cycle(now_);
    bus_.segment().compute();
    Event event;
    while (master_->next_event(event)) {
      events_.push_back(event);
    }
  }
  void run(unsigned ticks) {
    for (unsigned i = 0; i < ticks; ++i) {
      tick();
    }
  }
  [[nodiscard]] bool all_operate() const { return io::ethercat::all_operate(*master_); }
  // Ticks until all slaves operate; `limit` if they do not.
  unsigned run_until_all_operate(unsigned limit) {
    unsigned ticks = 0;
    for (; ticks < limit && !all_operate(); ++ticks) {
      tick();
    }
    return ticks;
  }
  [[nodiscard]] bool happened(std::size_t slave, Problem problem) const {
    return std::any_of(events_.begin(), events_.end(),
                       [&](const Event& event) { return event.slave == slave && event.problem == problem; });
  }
  [[nodiscard]] std::string story() const {
    std::string text;
    for (const Event& event : events_) {
      text += std::to_string(event.time.count() / 1'000'000) + " ms: " + describe(event, "drive") + "\n";
    }
    return text;
  }

  SimulatedBus& bus() { return bus_; }
  Slave& slave(std::size_t index) { return bus_.segment().slave(index); }
  Master& master() { return *master_; }
  [[nodiscard]] Clock now() const { return now_; }
  std::vector<Event>& events() { return events_; }
  // What the slave did with outputs in OP.
  std::vector<std::uint8_t>& applied(std::size_t index) { return applied_[index]; }

 private:
  SimulatedBus bus_;
  std::unique_ptr<Master> master_;
  Clock now_{0};
  std::vector<Event> events_;
  std::vector<std::vector<std::uint8_t>> applied_;
};

}  // namespace indurop::io::ethercat
