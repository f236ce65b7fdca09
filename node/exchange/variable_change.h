// SPDX-License-Identifier: Apache-2.0
// What another version of a module changes in the store: variables that appear, and variables whose type changes, which
// get another place and what can be carried by name. Called by the thread that supervises the node.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "config/check/check.h"
#include "config/model/config.h"
#include "core/schema/schema.h"
#include "node/modules/module_library.h"
#include "scheduler/exchange.h"
#include "store/operate/reload.h"
#include "store/vars/store.h"

namespace indurop::node {

class VariableChange {
 public:
  VariableChange() = default;
  // Compares what the code of a version uses with what the store has. `declared`: the variables of its .glb files;
  // those that the store does not have appear. The store must have places for all of them when it comes to values.
  static VariableChange of(const vars::Store& store, const ModuleLibrary::Uses& uses,
                           std::span<const schema::Variable> declared);

  // The same for a version that has run before.
  static VariableChange back_to(vars::Store& store, const ModuleLibrary::Uses& uses);

  // Variables that the store must have places for.
  [[nodiscard]] std::vector<schema::Variable> places() const;
  [[nodiscard]] bool changes_types() const noexcept { return !changed_.empty(); }
  // Declarations of the variables whose type changes, as they are now and as they will be.
  struct Changed {
    schema::Variable from;
    schema::Variable to;
  };
  [[nodiscard]] const std::vector<Changed>& changed() const noexcept { return changed_; }
  // Lists it in the plan. Returns true if something is lost, by the declarations or because a value does not fit now.
  bool list(const vars::Store& store, operate::ReloadPlan& plan) const;

  // All processes see the variables that appear from now on, with their initial values. Returns false if they have
  // appeared meanwhile with other types.
  bool let_appear(vars::Store& store);

  [[nodiscard]] bool changes_type_of(std::uint64_t name_hash) const noexcept;

  // The types change at a boundary between two runs; nothing of this has an effect if none does. Prepares what has to
  // be stored then. Returns false if there is no memory for it.
  bool prepare(vars::Store& store, scheduler::Exchange::Settings& settings);
  // Copies what can be carried to the new places. Returns why not; empty: it is done. `lossy`: values that do not fit
  // are left out.
  [[nodiscard]] std::string carry(vars::Store& store, bool lossy) const;
  // Name of a variable that is forced, so that its type cannot change; empty: there is none.
  [[nodiscard]] std::string forced(const vars::Store& store) const;
  // The words were stored.
  void follow(vars::Store& store);
  // All of this while no version runs. Returns why not.
  [[nodiscard]] std::string change_at_once(vars::Store& store, bool lossy);

 private:
  std::vector<schema::Variable> appearing_;
  std::vector<Changed> changed_;
  bool back_ = false;  // to places that have had values before
  std::optional<vars::NextCatalog> next_;
};

// Variables that a module uses by the configuration (ioconfig.xml, <access>) and not by its code, whatever its version.
using ConfiguredUses = std::set<std::uint64_t>;
// `index`: of the module in the checked configuration.
ConfiguredUses configured_uses_of(const config::CheckResult& check, std::size_t index, const std::string& module);

// Why types cannot change, one line for each variable: another module that stays uses its present layout, it is forced,
// or it has a fail-safe value. All are borrowed.
struct TypeUsers {
  const vars::Store& store;
  const config::Config& config;
  std::span<const ModuleLibrary> libraries;    // the versions that run
  std::span<const ConfiguredUses> configured;  // by module
  std::uint32_t module = 0;                    // that changes them
};
std::vector<std::string> objections(const VariableChange& change, const TypeUsers& users);

}  // namespace indurop::node
