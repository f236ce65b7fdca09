// SPDX-License-Identifier: Apache-2.0
// The node's interface to third-party tools: which of its variables they see, with which types. Errors of this part are
// reported and never keep modules from running.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/check/check_plant.h"
#include "network/mirror/external/external.h"
#include "node/modules/type_library.h"
#include "node/run/console.h"
#include "store/vars/store.h"

namespace indurop::node {

class ExternalPart {
 public:
  // For a board of a plant: the variables it owns or is a standby for. `board`: index into plant.boards.
  void configure(const config::Plant& plant, const config::PlantCheck& check, std::size_t board, bool one_host);
  // For a module.xml: all variables.
  void configure(const config::Config& config, const config::CheckResult& check);

  // Loads the types and starts. `store` and `plant` (null: none) are borrowed until stop(). `cores`: cores the threads
  // may run on.
  void start(const std::string& node, vars::Store& store, const mirror::MirrorBlock* plant, std::vector<int> cores,
             Console& console);
  void stop() noexcept { external_.reset(); }
  // Returns true if there are topics of its variables.
  [[nodiscard]] bool is_wanted() const noexcept { return wanted_; }

 private:
  void add(const std::vector<config::VariableRule>& rules, const std::string& variable,
           std::vector<std::string> rivals = {});
  void find_types(const schema::Schema& schema, Console& console);

  bool wanted_ = false;
  mirror::ExternalSettings settings_;
  config::TypeFiles types_;
  TypeLibraries libraries_;
  std::optional<mirror::External> external_;  // destroyed before its types
};

}  // namespace indurop::node
