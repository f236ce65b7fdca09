// SPDX-License-Identifier: Apache-2.0
// The boards of the network for a program that keeps looking: who is there, who was, who should be. One thread uses it.

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "base/json.h"
#include "base/problem.h"
#include "deploy/link/deploy_link.h"
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
  std::map<std::string, Gone> seen_;  // all that were ever heard, by name
};

}  // namespace indurop::tools
