// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/arm/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace indurop::ros {

Result<Commands, base::Problem> Commands::find(const Node& node, const std::string& group) {
  auto commands = Variable::find(node, group + "::MC_COMMAND");
  auto answers = Variable::find(node, group + "::MC_ANSWER");
  auto profiles = Variable::find(node, group + "::MC_PROFILE");
  for (const auto* const found : {&commands, &answers, &profiles}) {
    if (!*found) {
      return base::Problem{found->error().text};
    }
  }
  if (commands->layout().count() != answers->layout().count() || !commands->has("[0].dTo[0]") ||
      !answers->has("[0].eState") || !profiles->has("[0].dTime[0]")) {
    return base::Problem{group + "::MC_COMMAND is of another release; use the plc_robot.glb of this one"};
  }
  return Commands(std::move(*commands), std::move(*answers), std::move(*profiles));
}

std::vector<std::size_t> Commands::free_places() const {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < commands_.layout().count(); ++i) {
    const auto of = [i](const char* field) { return fmt::format("[{}].{}", i, field); };
    const double number = commands_.number(of("nNumber"));
    const bool has_ended = answers_.number(of("nNumber")) == number &&
                           answers_.number(of("eState")) >= static_cast<int>(robot::CommandState::Done);
    if (number == 0 || has_ended) {
      places.push_back(i);
    }
  }
  return places;
}

void Commands::put(std::size_t place, const Order& order) {
  const auto set = [this, place](const std::string& field, double value) {
    commands_.set(fmt::format("[{}].{}", place, field), value);
  };
  for (const char* const field : {"eBufferMode", "eDirection", "eCoordSystem", "nOption", "dAcceleration",
                                  "dDeceleration", "dJerk", "dTransition"}) {
    set(field, 0);
  }
  set("eOpCode", order.code);
  set("nAxis", order.axis);
  set("nJob", order.table);
  set("bExecute", 0);
  set("dVelocity", order.velocity);
  for (std::size_t i = 0; i < robot::Command{}.to.size(); ++i) {
    set(fmt::format("dTo[{}]", i), i < order.to.size() ? order.to[i] : 0);
    set(fmt::format("dAux[{}]", i), 0);
  }
  set("nNumber", order.number);
}

void Commands::put_table(std::size_t number, const robot::ProfileTable& table, std::uint32_t command) {
  const auto set = [this, number](const std::string& field, double value) {
    profiles_.set(fmt::format("[{}].{}", number, field), value);
  };
  set("nCommand", command);
  set("nPoints", table.points);
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.points); ++i) {
    set(fmt::format("dTime[{}]", i), table.time[i]);
    set(fmt::format("dValue[{}]", i), table.value[i]);
  }
}

std::string Commands::send(std::vector<Order>& orders, const std::vector<robot::ProfileTable>& tables,
                           const char* reason) {
  if (!commands_.read() || !answers_.read() || !profiles_.read()) {
    return irp_error();
  }
  const std::vector<std::size_t> places = free_places();
  if (places.size() < orders.size() || tables.size() > profiles_.layout().count()) {
    return "the robot has more commands to execute than there is room for; wait until some have ended";
  }
  for (std::size_t i = 0; i < commands_.layout().count(); ++i) {
    last_ = std::max(last_, static_cast<std::uint32_t>(commands_.number(fmt::format("[{}].nNumber", i))));
  }
  for (std::size_t i = 0; i < orders.size(); ++i) {
    orders[i].number = ++last_;
    put(places[i], orders[i]);
    if (orders[i].table > 0) {
      const auto table = static_cast<std::size_t>(orders[i].table) - 1;
      put_table(table, tables[table], orders[i].number);
    }
  }
  // The tables first: a command whose table is not there is refused.
  if (std::string wrong = tables.empty() ? std::string() : profiles_.write(reason); !wrong.empty()) {
    return wrong;
  }
  return commands_.write(reason);
}

OrderState Commands::state_of(const Order& order) const {
  for (std::size_t i = 0; i < answers_.layout().count(); ++i) {
    if (static_cast<std::uint32_t>(answers_.number(fmt::format("[{}].nNumber", i))) == order.number) {
      return {static_cast<robot::CommandState>(answers_.number(fmt::format("[{}].eState", i))),
              static_cast<robot::ErrorCode>(answers_.number(fmt::format("[{}].nError", i)))};
    }
  }
  return {};
}

}  // namespace indurop::ros
