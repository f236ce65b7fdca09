// SPDX-License-Identifier: Apache-2.0
// What a deployment does to each module of each board, as the boards report it before anything is changed.

#pragma once

#include <map>
#include <string>

#include "deploy/transaction/board_plan.h"
#include "deploy/words/deployment_words.h"
#include "tools/cli/command/verb.h"
#include "tools/client/text/table.h"

namespace indurop::tools {

class DeploymentPlan {
 public:
  void receive(const deploy::BoardReport& report);
  [[nodiscard]] bool empty() const noexcept { return boards_.empty(); }
  // Prints a line for each module, and why the nodes are restarted if they are; once.
  void print(Context& context);
  // Prints in which tick each board has exchanged its modules, and taken over its schedule.
  void print_ticks(Context& context) const;
  [[nodiscard]] JsonValue json() const;

 private:
  // Returns why all boards are restarted: one of them has to be; empty: none.
  [[nodiscard]] std::string restart() const;
  [[nodiscard]] deploy::BoardPlan shown(const deploy::BoardPlan& plan) const;

  struct Board {
    std::string text;
    deploy::BoardPlan plan;
  };
  std::map<std::string, Board> boards_;
  bool printed_ = false;
};

}  // namespace indurop::tools
