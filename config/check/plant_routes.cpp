// SPDX-License-Identifier: Apache-2.0
// Determines the owners of variables and the boards to which they are sent.

#include <algorithm>
#include <optional>

#include "config/check/plant_parts.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

std::set<std::size_t> boards_of(const std::vector<User>& users) {
  std::set<std::size_t> boards;
  for (const User& user : users) {
    boards.insert(user.board);
  }
  return boards;
}

std::vector<User> only_on(const std::vector<User>& users, std::size_t board, bool on) {
  std::vector<User> some;
  std::copy_if(users.begin(), users.end(), std::back_inserter(some),
               [board, on](const User& user) { return (user.board == board) == on; });
  return some;
}

class RouteFinder {
 public:
  RouteFinder(PlantContext& context, PlantCheck& result)
      : context_(context),
        uses_(context.uses),
        report_(context.report),
        owners_(result.owners),
        standbys_(result.standbys) {}

  std::vector<Route> find() {
    for (const auto& [name, users] : uses_.variables()) {
      const VariableRule* rule = rule_for(context_.plant, name);
      const auto owner = owner_of(name, users, rule);
      if (owner) {
        add_route(name, users, *owner, rule);
      }
    }
    check_rules_used();
    check_unknown_readers();
    return std::move(routes_);
  }

 private:
  // Returns the board that owns the variable; nothing if there is none, or after an error.
  std::optional<std::size_t> owner_of(const std::string& name, const Users& all, const VariableRule* rule) {
    Users users = all;
    std::erase_if(users.writers, [this](const User& writer) { return uses_.module(writer).is_standby; });
    if (rule != nullptr && !rule->owner.empty()) {
      return named_owner(name, users, *rule);
    }
    const std::set<std::size_t> writing = boards_of(users.writers);
    if (writing.size() > 1) {
      const User& first = users.writers.front();
      const auto other = std::find_if(users.writers.begin(), users.writers.end(),
                                      [&](const User& writer) { return writer.board != first.board; });
      report_.error(uses_.module(*other).places.file,
                    base::in_quotes(name) + " is written by " + base::enumerate(uses_.names(users.writers)) +
                        ", but one board must own it; name the owner with <variable name=\"" + name + "\" owner=\"" +
                        uses_.board(first).name + "\"/>, or use separate variables on the other boards");
    }
    if (writing.empty() && !users.readers.empty() && rule != nullptr &&
        rule->external == VariableRule::External::Write) {
      return users.readers.front().board;  // tools set it there
    }
    return writing.size() == 1 ? std::optional<std::size_t>(*writing.begin()) : std::nullopt;
  }

  std::optional<std::size_t> named_owner(const std::string& name, const Users& users, const VariableRule& rule) {
    const auto found = std::find_if(context_.boards.begin(), context_.boards.end(),
                                    [&](const BoardView& board) { return board.name == rule.owner; });
    const auto owner = static_cast<std::size_t>(found - context_.boards.begin());
    const std::vector<User> others = only_on(users.writers, owner, false);
    if (schema::find_variable(found->result.schema, name) == nullptr) {
      report_.error(rule.owner_place, "owner: no module of board " + base::in_quotes(rule.owner) + " has " +
                                          base::in_quotes(name) + better_owner(others));
      return std::nullopt;
    }
    const bool writes = others.size() < users.writers.size() || !found->result.unknown_writers.empty();
    if (!writes && !others.empty()) {
      report_.error(rule.owner_place, "owner: no module of board " + base::in_quotes(rule.owner) + " writes " +
                                          base::in_quotes(name) + ", but " + base::enumerate(uses_.names(others)) +
                                          (others.size() == 1 ? " does" : " do") + better_owner(others));
      return std::nullopt;
    }
    if (!writes) {
      report_.warning(rule.owner_place, base::in_quotes(name) +
                                            " is written by no module; it keeps its initial value unless "
                                            "set by hand on board " +
                                            base::in_quotes(rule.owner));
    } else if (!others.empty()) {
      report_lost_writes(name, users, others, rule);
    }
    return owner;
  }

  std::string better_owner(const std::vector<User>& writers) const {
    return writers.empty() ? "; name a board whose modules use it"
                           : "; write owner=\"" + uses_.board(writers.front()).name + "\"";
  }

  // Reports writes to the variable by boards that do not own it.
  void report_lost_writes(const std::string& name, const Users& users, const std::vector<User>& writers,
                          const VariableRule& rule) {
    const std::set<std::size_t> reading = boards_of(users.readers);
    for (const std::size_t board : boards_of(writers)) {
      const bool reads = reading.contains(board);
      report_.warning(rule.owner_place, base::in_quotes(name) + " is owned by board " + base::in_quotes(rule.owner) +
                                            "; what " + base::enumerate(uses_.names(only_on(writers, board, true))) +
                                            " writes " +
                                            (reads ? "is replaced there by the owner's value" : "stays on its board"));
    }
  }

  void add_route(const std::string& name, const Users& users, std::size_t owner, const VariableRule* rule) {
    Route route;
    route.variable = name;
    route.owner = owner;
    for (const User& writer : users.writers) {
      if (writer.board != owner && uses_.module(writer).is_standby) {
        route.standbys.push_back(writer.board);
      }
    }
    const std::vector<std::size_t>& standbys = route.standbys;
    for (const std::size_t board : boards_of(users.readers)) {
      if (board != owner && std::find(standbys.begin(), standbys.end(), board) == standbys.end()) {
        route.readers.push_back(board);
        arriving_.insert({name, board});
      }
    }
    if (rule != nullptr) {
      route.every = rule->every;
      route.best_effort = rule->best_effort;
    }
    owners_[name] = owner;
    if (!standbys.empty()) {
      standbys_[name] = standbys;
    }
    if (!route.readers.empty()) {
      travelling_.insert(name);
      routes_.push_back(std::move(route));
    }
  }

  // Reports rules without effect, which were probably intended for another variable.
  void check_rules_used() {
    for (const VariableRule& rule : context_.plant.variables) {
      const bool shown = context_.plant.external_domain && !context_.plant.types.empty();
      if (rule.external != VariableRule::External::Read || (shown && rule.every > base::Nanos::zero())) {
        continue;  // a rule for third-party tools
      }
      const auto found = uses_.variables().find(rule.name);
      if (found == uses_.variables().end()) {
        report_.warning(rule.place, "no module uses " + base::in_quotes(rule.name) + "; remove this <variable>");
      } else if (owners_.contains(rule.name) && !travelling_.contains(rule.name) &&
                 boards_of(found->second.writers).size() < 2) {
        report_.warning(rule.place, base::in_quotes(rule.name) +
                                        " does not leave its board, no module of another one reads it; remove this "
                                        "<variable>");
      }
    }
  }

  // Variables that modules read by unknown names are not sent to their board.
  void check_unknown_readers() {
    for (const User& user : uses_.unknown_readers()) {
      std::vector<std::string> missing;
      for (const schema::Variable& variable : uses_.board(user).result.schema.variables) {
        const auto owner = owners_.find(variable.name);
        if (owner != owners_.end() && owner->second != user.board && !arriving_.contains({variable.name, user.board})) {
          missing.push_back(variable.name);
        }
      }
      if (!missing.empty()) {
        constexpr std::size_t kMaxShown = 3;
        report_.warning(uses_.module(user).places.file,
                        uses_.name(user) +
                            " reads by name, so this board receives nothing from other boards, such as " +
                            base::enumerate(missing, kMaxShown) + "; name what it needs in <access><read>");
      }
    }
  }

  PlantContext& context_;
  const Uses& uses_;
  base::Diagnostics& report_;
  std::vector<Route> routes_;
  std::map<std::string, std::size_t>& owners_;
  std::map<std::string, std::vector<std::size_t>>& standbys_;
  std::set<std::string> travelling_;
  std::set<std::pair<std::string, std::size_t>> arriving_;  // and the boards they are sent to
};

}  // namespace

const VariableRule* rule_for(const Plant& plant, const std::string& variable) {
  const auto found = std::find_if(plant.variables.begin(), plant.variables.end(),
                                  [&](const VariableRule& rule) { return rule.name == variable; });
  return found == plant.variables.end() ? nullptr : &*found;
}

std::vector<Route> find_routes(PlantContext& context, PlantCheck& result) {
  return RouteFinder(context, result).find();
}

}  // namespace indurop::config
