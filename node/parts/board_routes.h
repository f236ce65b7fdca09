// SPDX-License-Identifier: Apache-2.0
// What a board exchanges with the others of its plant: at the start, and by the manifests of later deployments, as far
// as the running node can follow them. Called by the thread that supervises the node.

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/check/check.h"
#include "config/model/config.h"
#include "network/mirror/frames/settings.h"
#include "scheduler/engine.h"

namespace indurop::node {

class BoardRoutes {
 public:
  BoardRoutes() = default;
  // `at_start`: its writers are not named yet.
  explicit BoardRoutes(mirror::Routes at_start) : first_(at_start), now_(std::move(at_start)) {}

  // The modules of the node by the indices of its run block, and who writes and reads what by a check of them. All are
  // borrowed; the engine for as long as the routes are used.
  struct Modules {
    const config::Config& config;
    const config::CheckResult& check;
    const scheduler::Engine& engine;
  };
  // Marks which of the outgoing variables are written by one band only. Variables that one band writes now are sent
  // together, also when another schedule has its modules in several.
  const mirror::Routes& name_writers(const Modules& modules);

  // Where a variable stands on this board.
  struct Standing {
    std::function<bool(const std::string&)> is_used;   // by a module that runs
    std::function<bool(const std::string&)> is_first;  // the node has had it from the start
    std::function<bool(const std::string&)> will_be_used;
  };
  // Returns a sentence about the first variable whose exchange cannot change while the node runs; empty: there is none.
  // Variables may be sent that were not, also in addition to others. What a module of this board uses keeps the board
  // that it comes from.
  [[nodiscard]] std::string difference(const mirror::Routes& next, const Standing& standing) const;

  [[nodiscard]] bool sends(const std::string& variable) const;

  // From now on what is exchanged by both manifests is exchanged, until it is settled.
  const mirror::Routes& extend(const mirror::Routes& next, const Modules& modules);
  [[nodiscard]] bool is_extended() const noexcept { return next_.has_value(); }
  const mirror::Routes& settle(bool keeps_next);

 private:
  // The modules that write variables of a band, or a module that the schedule does not have yet.
  struct Group {
    const scheduler::Band* band = nullptr;  // null: it is not to be joined
    std::vector<std::uint32_t> modules;     // sorted
    bool notifies = true;
    std::int64_t patience_ns = 0;
  };
  void name(std::vector<mirror::Outgoing>& outgoing, const Modules& modules);
  int group_of(const std::string& variable, const Modules& modules, std::size_t fixed);

  std::vector<Group> groups_;  // as the writers of now_
  mirror::Routes first_;
  mirror::Routes now_;
  std::optional<std::vector<mirror::Incoming>> next_;  // of the manifest that follows; none: now_ is of one
  std::vector<mirror::Incoming> before_;
};

}  // namespace indurop::node
