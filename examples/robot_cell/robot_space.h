// SPDX-License-Identifier: Apache-2.0
// What robots of a node that share their space report to each other (property other_robots): the variables of
// robot_space.glb, by name. Name them in <access> of module.xml, so that the modules run one after the other, and the
// checks know them.
#pragma once

#include <indurop/channel.h>
#include <indurop/robot/controller.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

class RobotSpace {
 public:
  // Throws if a robot does not have these variables; nothing is read or written if there are no others.
  RobotSpace(const std::string& name, const std::vector<std::string>& others) {
    for (const std::string& other : others) {
      robots_.push_back({names_of(other), {}});
      check(read(robots_.back()), robots_.back().names);
    }
    if (!others.empty()) {
      own_ = names_of(name);
      check(channel::read(handle_, own_.held, sizeof held_, &held_) > 0 &&
                channel::read(handle_, own_.space, sizeof state_, &state_) > 0,
            own_);
    }
  }
  // Real-time safe, like write().
  void read(indurop::robot::Inputs& in) noexcept {
    for (std::size_t i = 0; i < robots_.size() && i < in.others.size(); ++i) {
      in.others[i] = read(robots_[i]) ? &robots_[i].report : nullptr;
    }
  }
  void write(const indurop::robot::Outputs& out) noexcept {
    if (out.space == nullptr) {
      return;
    }
    const Report& report = *out.space;
    state_.known = report.known ? 1 : 0;
    state_.stands = report.stands ? 1 : 0;
    state_.ticket = report.ticket;
    state_.intrusions = report.intrusions;
    state_.intruded = report.intruded;
    state_.waits_for = report.waits_for;
    state_.name = report.name;
    state_.sync = report.sync;
    state_.sync_since = report.sync_since;
    state_.box = report.box;
    std::copy(report.wanted.first.begin(), report.wanted.first.end(), state_.wanted.begin());
    std::copy(report.wanted.last.begin(), report.wanted.last.end(), state_.wanted.begin() + 3);
    static_cast<void>(channel::write(handle_, own_.space, sizeof state_, &state_));
    // It changes only now and then, and each write is recorded.
    if (!written_ || held_ != report.held) {
      held_ = report.held;
      written_ = channel::write(handle_, own_.held, sizeof held_, &held_) > 0;
    }
  }

 private:
  using Report = indurop::robot::SpaceReport;
  // As ROBOT_SPACE in robot_space.glb.
  struct State {
    std::int16_t known = 0, stands = 0;
    std::uint32_t ticket = 0, intrusions = 0;
    indurop::string<32> intruded, waits_for, name, sync;
    std::uint64_t sync_since = 0;
    std::array<double, 6> box{};
    std::array<std::uint8_t, 6> wanted{};
  };
  struct Names {
    std::string space, held;
  };
  struct One {
    Names names;
    Report report;
  };

  static Names names_of(const std::string& robot) { return {robot + "::ROBOT_SPACE", robot + "::ROBOT_HELD"}; }
  static void check(bool found, const Names& names) {
    if (!found) {
      throw std::runtime_error("property other_robots: no variable " + names.space +
                               "; build that robot with its robot_space.glb");  // the node shows 120 characters
    }
  }
  bool read(One& one) noexcept {
    State state;
    Report& report = one.report;
    if (channel::read(handle_, one.names.space, sizeof state, &state) < 0 ||
        channel::read(handle_, one.names.held, sizeof report.held, &report.held) < 0) {
      return false;
    }
    report.known = state.known != 0;
    report.stands = state.stands != 0;
    report.ticket = state.ticket;
    report.intrusions = state.intrusions;
    report.intruded = state.intruded;
    report.waits_for = state.waits_for;
    report.name = state.name;
    report.sync = state.sync;
    report.sync_since = state.sync_since;
    report.box = state.box;
    std::copy_n(state.wanted.begin(), 3, report.wanted.first.begin());
    std::copy_n(state.wanted.begin() + 3, 3, report.wanted.last.begin());
    return true;
  }

  channel::Handle handle_;
  std::vector<One> robots_;
  Names own_;
  State state_;
  indurop::robot::SpaceCells held_{};
  bool written_ = false;
};
