// SPDX-License-Identifier: Apache-2.0
// The chains from one variable to another through modules and boards of a configuration, and the age of the data at
// their end.

#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "config/check/chain_age.h"
#include "config/check/uses.h"
#include "core/base/problem.h"
#include "tools/client/config/checked_config.h"

namespace indurop::tools {

struct Chain {
  using Node = std::pair<std::size_t, std::size_t>;  // indices of the board in the views and of the module in it
  std::vector<Node> modules;
  std::vector<std::string> variables;  // those between the modules
};

class Chains {
 public:
  // `boards` and `uses` are borrowed. `owners`: owning board of variables that are sent between boards, by name;
  // `every`: minimum interval of sending.
  Chains(std::span<const config::BoardView> boards, const config::Uses& uses, std::map<std::string, std::size_t> owners,
         std::map<std::string, base::Nanos> every);

  // Each chain begins with a module that writes `from` and ends with one that writes `to`. Both must be in `uses`.
  // Empty: there is no chain.
  [[nodiscard]] std::vector<Chain> find(const std::string& from, const std::string& to) const;
  // "table@sensor -cell::encoder-> controller@control"
  [[nodiscard]] std::string name(const Chain& chain) const;
  [[nodiscard]] base::Nanos period(Chain::Node one) const { return uses_.module({one.first, one.second}).period; }

  // Sets the maximum execution time of a module that does not declare one; and the maximum latency of the first module
  // of a tick.
  void measured(Chain::Node one, base::Nanos execution);
  void measured_start(std::size_t board, base::Nanos basic_period, base::Nanos late);
  [[nodiscard]] config::ChainAge age(const Chain& chain, base::Nanos network) const;

 private:
  using Node = Chain::Node;
  struct Search;
  static Node node(const config::User& user) { return {user.board, user.module}; }
  [[nodiscard]] bool periodic(const config::User& user) const;
  [[nodiscard]] bool leads(const std::string& variable, const config::User& writer, const config::User& reader) const;
  [[nodiscard]] std::size_t owner_of(const std::string& variable) const;
  void order(const config::BoardView& board);
  void follow(Search& search) const;

  std::span<const config::BoardView> boards_;
  const config::Uses& uses_;
  std::map<std::string, std::size_t> owners_;
  std::map<std::string, base::Nanos> every_;
  std::map<Node, std::vector<std::pair<std::string, Node>>> edges_;
  std::map<Node, std::size_t> place_;
  std::vector<std::vector<config::Timed>> timed_;  // by board, in order of execution
};

// A checked file for which chains are requested.
class ChainPlant {
 public:
  // A module.xml or plant.xml; `options` as for `indurop check`.
  ChainPlant(const std::string& file, const config::CheckOptions& options);

  [[nodiscard]] bool ok() const;
  [[nodiscard]] const std::vector<base::Diagnostic>& diagnostics() const;
  [[nodiscard]] std::span<const config::BoardView> boards() const noexcept { return views_; }
  [[nodiscard]] const config::Uses& uses() const noexcept { return *uses_; }  // if ok
  [[nodiscard]] Chains chains() const;
  // Returns the full name of a variable that a module reads or writes, else a message with a suggestion.
  [[nodiscard]] Result<std::string, base::Problem> variable(const std::string& typed) const;

 private:
  std::unique_ptr<CheckedConfig> config_;
  std::unique_ptr<CheckedPlant> plant_;
  std::vector<config::BoardView> views_;
  std::unique_ptr<config::Uses> uses_;
};

}  // namespace indurop::tools
