// SPDX-License-Identifier: Apache-2.0
// Plain topics: the value of each variable as JSON, the state of boards, and commands of users.

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "doors/mqtt/broker/outlet.h"
#include "doors/mqtt/model/board.h"
#include "doors/mqtt/serve/commands.h"

namespace indurop::mqtt {

struct PlainSettings {
  std::string prefix = "indurop";
  Retain retain = Retain::Yes;
  std::vector<UserToken> users;  // who may command, with the rights that they have at the server
};

// Used by the thread of the main loop.
class Plain {
 public:
  // `submit` executes a command.
  Plain(PlainSettings settings, Outlet& outlet, std::function<void(Command)> submit)
      : settings_(std::move(settings)), outlet_(&outlet), submit_(std::move(submit)) {}

  // The topic that says whether this program is connected.
  [[nodiscard]] std::string status_topic() const { return settings_.prefix + "/online"; }

  // The connection was made: states and values are published again.
  void connected(const std::vector<const Board*>& boards);
  void publish_state(const std::string& board, bool alive);
  void publish(const Board& board, const std::vector<Change>& changes);
  void receive(const std::string& topic, const std::string& payload, bool retained);
  // The values of a variable that is gone are removed from the broker.
  void forget(const Board& board);

 private:
  [[nodiscard]] std::string topic_of(const std::string& board, const std::string& variable) const;
  void publish_value(const Board& board, std::size_t variable);
  void answer(const std::string& board, const std::string& user, const base::Json& id, const CommandResult& result);

  PlainSettings settings_;
  Outlet* outlet_;
  std::function<void(Command)> submit_;
};

}  // namespace indurop::mqtt
