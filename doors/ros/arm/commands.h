// SPDX-License-Identifier: Apache-2.0
// Commands to the robot task as function blocks of PLCopen issue them (MC_COMMAND), and what became of them. No PLC
// program of the robot may use such blocks besides: the commands have one writer.

#pragma once

#include <indurop/result.h>
#include <indurop/robot/commands.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "doors/ros/model/node.h"

namespace indurop::ros {

// What of a command is not 0.
struct Order {
  int axis = 0;  // from 1; 0: the group
  std::int32_t code = 0;
  int table = 0;             // of a profile, from 1
  std::vector<double> to{};  // degrees, mm
  double velocity = 0;       // of the group: % of full speed; 0: full speed
  std::uint32_t number = 0;  // given by send()
};

struct OrderState {
  robot::CommandState state = robot::CommandState::None;
  robot::ErrorCode error = robot::ErrorCode::Ok;
};

// The robot task does not execute commands that are there when it starts, and answers them in the same way.
inline constexpr const char* kNotExecuted =
    "another command replaced it, or the robot task has just started; repeat it";

class Commands {
 public:
  // Errors: the robot has no such variables, or too few tables for its axes.
  static Result<Commands, base::Problem> find(const Node& node, const std::string& group);

  [[nodiscard]] std::size_t tables() const noexcept { return profiles_.layout().count(); }
  // Sends all at once: they take effect in the same tick. Tables belong to the orders with their numbers. Returns why
  // nothing was sent; empty: it was.
  std::string send(std::vector<Order>& orders, const std::vector<robot::ProfileTable>& tables, const char* reason);
  // Of an order that was sent.
  [[nodiscard]] OrderState state_of(const Order& order) const;
  // Reads the answers again. False: the node has changed or ended.
  bool read() { return answers_.read(); }

 private:
  Commands(Variable commands, Variable answers, Variable profiles)
      : commands_(std::move(commands)), answers_(std::move(answers)), profiles_(std::move(profiles)) {}
  [[nodiscard]] std::vector<std::size_t> free_places() const;
  void put(std::size_t place, const Order& order);
  void put_table(std::size_t number, const robot::ProfileTable& table, std::uint32_t command);

  Variable commands_;
  Variable answers_;
  Variable profiles_;
  std::uint32_t last_ = 0;  // number that was given
};

}  // namespace indurop::ros
