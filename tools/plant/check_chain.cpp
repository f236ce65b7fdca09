// SPDX-License-Identifier: Apache-2.0
#include "tools/plant/check_chain.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "config/check/access_map.h"
#include "config/check/chain_age.h"
#include "config/check/uses.h"
#include "config/xml/plant_reader.h"
#include "tools/command/config_file.h"
#include "tools/command/suggest.h"
#include "tools/command/units.h"
#include "tools/values/mirror_view.h"

namespace indurop::tools {
namespace {

using base::Nanos;
using config::User;
using Node = std::pair<std::size_t, std::size_t>;  // board, module

constexpr std::size_t kMostChains = 50;
constexpr std::size_t kLongest = 16;  // modules

struct Chain {
  std::vector<Node> modules;
  std::vector<std::string> variables;  // between them
};

class Finder {
 public:
  Finder(const std::vector<config::BoardView>& boards, const config::Uses& uses,
         std::map<std::string, std::size_t> owners, std::map<std::string, Nanos> every)
      : boards_(boards), uses_(uses), owners_(std::move(owners)), every_(std::move(every)) {
    for (const auto& [name, users] : uses_.variables()) {
      for (const User& writer : users.writers) {
        for (const User& reader : users.readers) {
          if (leads(name, writer, reader) && known_.insert({node(writer), node(reader)}).second) {
            edges_[node(writer)].push_back({name, node(reader)});
          }
        }
      }
    }
    for (const config::BoardView& board : boards_) {
      order(board);
    }
  }

  // Each begins with a module that writes the one and ends with one that writes the other. Empty: none does.
  std::vector<Chain> find(const std::string& from, const std::string& to) {
    const config::Users& begin = uses_.variables().at(from);
    for (const User& writer : uses_.variables().at(to).writers) {
      goals_.insert(node(writer));
    }
    for (const User& writer : begin.writers) {
      if (periodic(writer) && goals_.contains(node(writer))) {
        found_.push_back({{node(writer)}, {}});
      }
      for (const User& reader : begin.readers) {
        if (leads(from, writer, reader)) {
          Chain chain{{node(writer), node(reader)}, {from}};
          follow(chain);
        }
      }
    }
    return std::move(found_);
  }

  [[nodiscard]] config::ChainAge age(const Chain& chain, Nanos network) const {
    std::vector<config::ChainLink> links;
    for (std::size_t i = 0; i < chain.modules.size(); ++i) {
      const auto& [board, module] = chain.modules[i];
      const auto rate = i < chain.variables.size() ? every_.find(chain.variables[i]) : every_.end();
      links.push_back({board, place_.at({board, module}), rate == every_.end() ? Nanos{} : rate->second});
    }
    return config::chain_age(timed_, links, {Nanos{}, network});
  }

  [[nodiscard]] std::string name(Node one) const { return uses_.name({one.first, one.second}); }
  [[nodiscard]] Nanos period(Node one) const { return uses_.module({one.first, one.second}).period; }

 private:
  static Node node(const User& user) { return {user.board, user.module}; }
  [[nodiscard]] bool periodic(const User& user) const {
    const config::Module& module = uses_.module(user);
    return module.operation == scheduler::Operation::Periodic && module.period > Nanos::zero();
  }
  [[nodiscard]] bool leads(const std::string& variable, const User& writer, const User& reader) const {
    const bool travels = writer.board == reader.board || owner_of(variable) == writer.board;
    return periodic(writer) && periodic(reader) && travels && node(writer) != node(reader);
  }
  [[nodiscard]] std::size_t owner_of(const std::string& variable) const {
    const auto found = owners_.find(variable);
    return found == owners_.end() ? 0 : found->second;
  }

  void order(const config::BoardView& board) {
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

  void follow(Chain& chain) {
    const Node here = chain.modules.back();
    if (found_.size() >= kMostChains) {
      return;
    }
    if (goals_.contains(here)) {
      found_.push_back(chain);
      return;
    }
    for (const auto& [variable, next] : edges_[here]) {
      const bool again = std::find(chain.modules.begin(), chain.modules.end(), next) != chain.modules.end();
      if (again || chain.modules.size() >= kLongest) {
        continue;
      }
      chain.modules.push_back(next);
      chain.variables.push_back(variable);
      follow(chain);
      chain.modules.pop_back();
      chain.variables.pop_back();
    }
  }

  const std::vector<config::BoardView>& boards_;
  const config::Uses& uses_;
  std::map<std::string, std::size_t> owners_;
  std::map<std::string, Nanos> every_;
  std::set<std::pair<Node, Node>> known_;
  std::map<Node, std::vector<std::pair<std::string, Node>>> edges_;
  std::map<Node, std::size_t> place_;
  std::vector<std::vector<config::Timed>> timed_;
  std::set<Node> goals_;
  std::vector<Chain> found_;
};

// The longest that a beacon was under way, with what is not known of the clocks.
std::optional<Nanos> measured_network(const std::vector<config::BoardView>& boards) {
  std::optional<Nanos> most;
  for (const config::BoardView& board : boards) {
    const auto mirror = board.name.empty() ? std::nullopt : view_mirror(board.name);
    for (const PeerView& peer : mirror ? mirror->peers : std::vector<PeerView>()) {
      if (peer.clock_known && peer.state == "alive") {
        const Nanos one(std::max<std::int64_t>(peer.delay_ns - peer.clock_offset_ns, 0) + peer.clock_bound_ns);
        most = std::max(most.value_or(Nanos{}), one);
      }
    }
  }
  return most;
}

std::string microseconds(Nanos time) {
  return fmt::format("{:.6g} us", static_cast<double>(time.count()) / 1e3);
}

int print(Context& context, const Finder& finder, const std::vector<Chain>& chains, const ChainQuestion& question,
          Nanos network, bool measured) {
  Table table({{"WAY", "way"},
               {"BEST", "best_ns", Align::Right},
               {"WORST", "worst_ns", Align::Right},
               {"CYCLES", "cycles", Align::Right},
               {"NETWORK", "crossings", Align::Right},
               {"", "exact"}});
  bool crosses = false;
  for (const Chain& chain : chains) {
    const config::ChainAge age = finder.age(chain, network);
    std::string way = finder.name(chain.modules[0]);
    for (std::size_t i = 0; i < chain.variables.size(); ++i) {
      way += fmt::format(" -{}-> {}", chain.variables[i], finder.name(chain.modules[i + 1]));
    }
    const double cycles =
        static_cast<double>(age.most.count()) / static_cast<double>(finder.period(chain.modules.back()).count());
    table.add({Cell(way),
               {microseconds(age.least), age.least.count()},
               {microseconds(age.most), age.most.count()},
               {fmt::format("{:.3g}", cycles), JsonValue(cycles)},
               {std::to_string(age.crossings), age.crossings},
               {"", age.exact}});
    crosses = crosses || age.crossings > 0;
  }
  print_table(context, table,
              {{"from", question.from}, {"to", question.to}, {"network_ns", network.count()}, {"measured", measured}},
              "chains");
  if (crosses && context.format == Format::Table) {
    context.out.note(fmt::format("{} for each way through the network, {}", microseconds(network),
                                 question.network ? "as told"
                                 : measured       ? "as boards here measure it"
                                                  : "as nobody has measured it here; see --network"));
  }
  return kOk;
}

int answer(Context& context, const std::vector<config::BoardView>& boards, std::map<std::string, std::size_t> owners,
           std::map<std::string, Nanos> every, const ChainQuestion& question) {
  const config::Uses uses(boards);
  std::vector<std::string> names;
  for (const auto& [name, users] : uses.variables()) {
    names.push_back(name);
  }
  for (const std::string& name : {question.from, question.to}) {
    if (!uses.variables().contains(name)) {
      context.out.error(fmt::format("no module reads or writes '{}'.{}", printable(name), did_you_mean(name, names)));
      return kFailed;
    }
  }
  Finder finder(boards, uses, std::move(owners), std::move(every));
  const std::vector<Chain> chains = finder.find(question.from, question.to);
  if (chains.empty()) {
    context.out.error(fmt::format("nothing leads from {} to {} through periodic modules", question.from, question.to));
    return kFailed;
  }
  const auto measured = question.network ? std::nullopt : measured_network(boards);
  const Nanos network = question.network ? *question.network : measured.value_or(config::kNetworkHop);
  return print(context, finder, chains, question, network, measured.has_value());
}

}  // namespace

int check_chain(Context& context, const std::string& file, const config::CheckOptions& options,
                const ChainQuestion& question) {
  if (!config::is_plant_file(file)) {
    const CheckedConfig checked = load_config(file, options);
    if (!checked.ok()) {
      print_diagnostics(context, checked.diagnostics, false);
      return kCheckFailed;
    }
    return answer(context, {{"", checked.config, checked.check}}, {}, {}, question);
  }
  const CheckedPlant checked = load_plant(file, options);
  if (!checked.ok()) {
    print_diagnostics(context, checked.diagnostics, false);
    return kCheckFailed;
  }
  std::map<std::string, Nanos> every;
  for (const config::Route& route : checked.check.routes) {
    every[route.variable] = route.every;
  }
  return answer(context, config::views_of(checked.plant, checked.check), checked.check.owners, std::move(every),
                question);
}

}  // namespace indurop::tools
