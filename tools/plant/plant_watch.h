// SPDX-License-Identifier: Apache-2.0
// The boards of the network for a program that keeps looking: who is there, who was, who should be. One thread uses it.

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/json.h"
#include "base/problem.h"
#include "deploy/link/deploy_link.h"
#include "tools/command/failure.h"
#include "tools/plant/board_commander.h"
#include "tools/plant/board_roster.h"

namespace indurop::tools {

class PlantWatch {
 public:
  explicit PlantWatch(deploy::LinkSettings settings) : settings_(std::move(settings)) {}

  // Takes what has come; the first time it waits until the boards were heard, at most 1.5 s. To be called twice a
  // second.
  void look();
  // As `indurop boards -o json` has it, and "heard": false for those that were there and are not. "problem": why none
  // can be heard; "trouble": what is wrong with the plant, in words, worst first.
  [[nodiscard]] base::Json json() const;
  // Earlier deployments, newest first, as the boards remember them. Asks the agents, which takes up to two seconds
  // each.
  [[nodiscard]] base::Json history();
  // Of two deployments, by their whole ids: see deployment_difference.h.
  [[nodiscard]] Result<base::Json, base::Problem> difference(const std::string& before, const std::string& after);

  // Boards whose agents are heard now, or were: what json() says of each.
  [[nodiscard]] std::vector<base::Json> rows() const;
  // What these boards say by that name (deploy/words/deployment_words.h); within two seconds, without those that do
  // not.
  [[nodiscard]] std::map<std::string, std::string> texts(const char* name, const std::vector<std::string>& boards);

  struct RemoteOrder {
    enum class What : std::uint8_t {
      Set,
      Force,
      Unforce,
      Lock,
      StopModule,
      StartModule,
      RestartModule,
      AckAlarms,
      ShelveAlarms,
      UnshelveAlarms
    };
    What what = What::Set;
    // NAME=VALUE; of Unforce and of alarms names, none: all; else the word of the lock, or the module
    std::vector<std::string> lines;
    std::int64_t for_ns = 0;  // of Force, 0: until it is let go; of ShelveAlarms
    std::string who;
    std::string reason;
  };
  // Given to the board's agent, which looks whether it may be; waits until it is done, a few seconds at most. Boards
  // with keys want those of the settings. Returns what the board says of it.
  Result<std::string, Failure> order(const std::string& board, const RemoteOrder& order);

 private:
  struct Gone {
    base::Json row;
    std::int64_t heard_ns = 0;
  };
  bool open();
  [[nodiscard]] base::Json troubles(const base::Json& boards) const;

  deploy::LinkSettings settings_;
  std::unique_ptr<deploy::DeployLink> link_;
  std::string problem_;
  BoardRoster roster_;
  std::unique_ptr<BoardCommander> commander_;
  std::map<std::string, Gone> seen_;  // all that were ever heard, by name
};

}  // namespace indurop::tools
