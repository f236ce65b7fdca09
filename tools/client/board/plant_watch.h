// SPDX-License-Identifier: Apache-2.0
// The boards of the network for a program that monitors them: those that are present, were present, or should be. Used
// by one thread.

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/json.h"
#include "core/base/problem.h"
#include "deploy/link/deploy_link.h"
#include "tools/client/board/board_commander.h"
#include "tools/client/board/board_roster.h"
#include "tools/client/failure.h"

namespace indurop::tools {

class PlantWatch {
 public:
  explicit PlantWatch(deploy::LinkSettings settings) : settings_(std::move(settings)) {}

  // Processes received messages; the first call waits until the boards are discovered, at most 1.5 s. To be called
  // twice a second.
  void update();
  // The boards as `indurop boards -o json` prints them, with "heard": false for those that were present and are not
  // now. "problem": why none can be discovered; "trouble": what is wrong with the plant, as texts, worst first.
  [[nodiscard]] base::Json json() const;
  // Earlier deployments, newest first, as the boards remember them. Requests them from the agents, which takes up to
  // two seconds each.
  [[nodiscard]] base::Json history();
  // The difference of two deployments given by their full ids: see deployment_difference.h.
  [[nodiscard]] Result<base::Json, base::Problem> difference(const std::string& before, const std::string& after);

  // Boards whose agents are present or were: the entry of json() for each.
  [[nodiscard]] std::vector<base::Json> rows() const;
  // Texts of that name of these boards (deploy/words/deployment_words.h); waits up to two seconds, without boards that
  // have none.
  [[nodiscard]] std::map<std::string, std::string> texts(const char* name, const std::vector<std::string>& boards);

  // What the board's agent reported last, which names the plant that it runs; waits for that up to a second.
  Result<deploy::BoardReport, Failure> report(const std::string& board);

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
    // NAME=VALUE; for Unforce and for alarms names, none: all; else the word of the lock, or the module
    std::vector<std::string> lines;
    std::int64_t for_ns = 0;  // for Force, 0: until released; for ShelveAlarms
    std::string who;
    std::string reason;
  };
  // Sends the command to the board's agent, which checks whether it is allowed; waits until it is done, a few seconds
  // at most. Boards with keys require those of the settings. Returns the board's answer.
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
  std::map<std::string, Gone> seen_;  // all that were ever discovered, by name
};

}  // namespace indurop::tools
