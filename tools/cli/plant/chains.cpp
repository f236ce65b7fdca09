// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/chains.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/check/access_map.h"
#include "config/xml/plant_reader.h"
#include "tools/client/text/suggest.h"
#include "tools/client/text/units.h"

namespace indurop::tools {

using base::Nanos;
using config::User;

namespace {

constexpr std::size_t kMostChains = 50;
constexpr std::size_t kLongest = 16;  // maximum number of modules

}  // namespace

struct Chains::Search {
  std::set<Node> goals;
  Chain chain;
  std::vector<Chain> found;
};

Chains::Chains(std::span<const config::BoardView> boards, const config::Uses& uses,
               std::map<std::string, std::size_t> owners, std::map<std::string, Nanos> every)
    : boards_(boards), uses_(uses), owners_(std::move(owners)), every_(std::move(every)) {
  std::set<std::pair<Node, Node>> known;
  for (const auto& [name, users] : uses_.variables()) {
    for (const User& writer : users.writers) {
      for (const User& reader : users.readers) {
        if (leads(name, writer, reader) && known.insert({node(writer), node(reader)}).second) {
          edges_[node(writer)].push_back({name, node(reader)});
        }
      }
    }
  }
  for (const config::BoardView& board : boards_) {
    order(board);
  }
}

std::vector<Chain> Chains::find(const std::string& from, const std::string& to) const {
  Search search;
  const config::Users& begin = uses_.variables().at(from);
  for (const User& writer : uses_.variables().at(to).writers) {
    search.goals.insert(node(writer));
  }
  for (const User& writer : begin.writers) {
    if (periodic(writer) && search.goals.contains(node(writer))) {
      search.found.push_back({{node(writer)}, {}});
    }
    for (const User& reader : begin.readers) {
      if (leads(from, writer, reader)) {
        search.chain = {{node(writer), node(reader)}, {from}};
        follow(search);
      }
    }
  }
  return std::move(search.found);
}

void Chains::follow(Search& search) const {
  Chain& chain = search.chain;
  const Node here = chain.modules.back();
  if (search.found.size() >= kMostChains) {
    return;
  }
  if (search.goals.contains(here)) {
    search.found.push_back(chain);
    return;
  }
  const auto edges = edges_.find(here);
  if (edges == edges_.end()) {
    return;
  }
  for (const auto& [variable, next] : edges->second) {
    const bool again = std::find(chain.modules.begin(), chain.modules.end(), next) != chain.modules.end();
    if (again || chain.modules.size() >= kLongest) {
      continue;
    }
    chain.modules.push_back(next);
    chain.variables.push_back(variable);
    follow(search);
    chain.modules.pop_back();
    chain.variables.pop_back();
  }
}

std::string Chains::name(const Chain& chain) const {
  const auto one = [&](Node module) { return uses_.name({module.first, module.second}); };
  std::string way = one(chain.modules[0]);
  for (std::size_t i = 0; i < chain.variables.size(); ++i) {
    way += fmt::format(" -{}-> {}", chain.variables[i], one(chain.modules[i + 1]));
  }
  return way;
}

void Chains::measured(Node one, Nanos execution) {
  config::Timed& timed = timed_[one.first][place_.at(one)];
  if (uses_.module({one.first, one.second}).wcet == Nanos::zero()) {
    timed.execution = execution;
  }
}

// The tick's own latency until the first module precedes all of them.
void Chains::measured_start(std::size_t board, Nanos basic_period, Nanos late) {
  std::vector<config::Timed>& all = timed_[board];
  all.insert(all.begin(), {basic_period, Nanos{}, late, all.empty() ? 0 : all.front().core});
  for (auto& [node, place] : place_) {
    place += node.first == board ? 1U : 0U;
  }
}

config::ChainAge Chains::age(const Chain& chain, Nanos network) const {
  std::vector<config::ChainLink> links;
  for (std::size_t i = 0; i < chain.modules.size(); ++i) {
    const auto& [board, module] = chain.modules[i];
    const auto rate = i < chain.variables.size() ? every_.find(chain.variables[i]) : every_.end();
    links.push_back({board, place_.at({board, module}), rate == every_.end() ? Nanos{} : rate->second});
  }
  return config::chain_age(timed_, links, {Nanos{}, network});
}

bool Chains::periodic(const User& user) const {
  const config::Module& module = uses_.module(user);
  return module.operation == scheduler::Operation::Periodic && module.period > Nanos::zero();
}

bool Chains::leads(const std::string& variable, const User& writer, const User& reader) const {
  const bool travels = writer.board == reader.board || owner_of(variable) == writer.board;
  return periodic(writer) && periodic(reader) && travels && node(writer) != node(reader);
}

std::size_t Chains::owner_of(const std::string& variable) const {
  const auto found = owners_.find(variable);
  return found == owners_.end() ? 0 : found->second;
}

void Chains::order(const config::BoardView& board) {
  const std::size_t number = timed_.size();
  std::vector<config::Timed> modules;
  for (const std::size_t i : config::execution_order(board.result)) {
    const config::Module& module = board.config.modules[i];
    if (module.operation == scheduler::Operation::Periodic && module.period > Nanos::zero()) {
      place_[{number, i}] = modules.size();
      modules.push_back({module.period, module.offset, module.wcet, module.core});
    }
  }
  timed_.push_back(std::move(modules));
}

ChainPlant::ChainPlant(const std::string& file, const config::CheckOptions& options) {
  if (config::is_plant_file(file)) {
    plant_ = std::make_unique<CheckedPlant>(load_plant(file, options));
    if (plant_->ok()) {
      views_ = config::views_of(plant_->plant, plant_->check);
    }
  } else {
    config_ = std::make_unique<CheckedConfig>(load_config(file, options));
    if (config_->ok()) {
      views_.push_back({"", config_->config, config_->check});
    }
  }
  uses_ = std::make_unique<config::Uses>(views_);
}

bool ChainPlant::ok() const {
  return plant_ ? plant_->ok() : config_->ok();
}

const std::vector<base::Diagnostic>& ChainPlant::diagnostics() const {
  return plant_ ? plant_->diagnostics : config_->diagnostics;
}

Chains ChainPlant::chains() const {
  std::map<std::string, Nanos> every;
  if (plant_) {
    for (const config::Route& route : plant_->check.routes) {
      every[route.variable] = route.every;
    }
  }
  return {views_, *uses_, plant_ ? plant_->check.owners : std::map<std::string, std::size_t>(), std::move(every)};
}

Result<std::string, base::Problem> ChainPlant::variable(const std::string& typed) const {
  std::vector<std::string> names;
  for (const auto& [name, users] : uses_->variables()) {
    names.push_back(name);
  }
  const std::vector<std::string> meant = variables_named(typed, names);
  if (meant.size() == 1) {
    return meant.front();
  }
  return base::Problem{
      meant.empty() ? fmt::format("no module reads or writes '{}'.{}", printable(typed), did_you_mean(typed, names))
                    : which_variable(printable(typed), meant)};
}

}  // namespace indurop::tools
