// SPDX-License-Identifier: Apache-2.0
#include "control/plc/lower/chart_actions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>
#include <iterator>
#include <unordered_map>
#include <utility>

#include "control/plc/model/elementary.h"
#include "control/plc/model/make.h"
#include "control/plc/st/parser.h"

namespace indurop::plc::lower {
namespace {

constexpr std::array<std::string_view, 5> kTimed{"L", "D", "SD", "DS", "SL"};
constexpr std::array<std::string_view, 8> kUntimed{"N", "R", "S", "P", "P0", "P1", "", network::kWhileActive};

template <class List>
bool contains(const List& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

// The associations of one action.
struct Group {
  std::string name;
  network::Body* body = nullptr;  // null: a variable
  std::vector<std::size_t> associations;
};

class Actions {
 public:
  Actions(const Chart& chart, const ChartSurroundings& around, Diagnostics& diagnostics)
      : chart_(chart), around_(around), diagnostics_(diagnostics) {}

  Lowered run() {
    const std::vector<Group> groups = collect();
    for (std::size_t i = 0; i < groups.size(); ++i) {
      lower(groups[i], i);
    }
    return std::move(code_);
  }

 private:
  std::vector<Group> collect() {
    std::vector<Group> groups;
    std::unordered_map<std::string, std::size_t> known;  // groups by their names in capitals
    for (std::size_t i = 0; i < chart_.actions.size(); ++i) {
      const network::ActionLine& line = *chart_.actions[i].line;
      if (!acceptable(line)) {
        continue;
      }
      const auto found = line.name.empty() ? known.end() : known.try_emplace(upper(line.name), groups.size()).first;
      if (found == known.end() || found->second == groups.size()) {
        network::Body* body = line.name.empty()     ? line.inlined.get()
                              : is_of_another(line) ? &call_of(line)
                                                    : around_.action(line.name);
        groups.push_back({line.name, body, {}});
      }
      groups[found == known.end() ? groups.size() - 1 : found->second].associations.push_back(i);
    }
    return groups;
  }

  // Returns true for Valve.Open of an instance in this POU.
  [[nodiscard]] bool is_of_another(const network::ActionLine& line) const {
    return line.name.find('.') != std::string::npos && (line.only_action || around_.foreign_action(line.name));
  }

  network::Body& call_of(const network::ActionLine& line) {
    network::Body& made = calls_.emplace_back();
    made.language = network::Body::Language::St;
    made.at = line.at;
    made.text = line.name + "();";
    made.text_at = line.at;
    return made;
  }

  bool acceptable(const network::ActionLine& line) {
    const bool timed = contains(kTimed, line.qualifier);
    if (!timed && !contains(kUntimed, line.qualifier)) {
      diagnostics_.error(line.at, fmt::format("qualifier '{}' is none of N S R P P0 P1 L D SD DS SL", line.qualifier));
      return false;
    }
    if (timed && line.duration.empty()) {
      diagnostics_.error(line.at,
                         fmt::format("qualifier {} needs a duration; write one, such as T#2s", line.qualifier));
      return false;
    }
    if (line.only_action && !is_of_another(line) && around_.action(line.name) == nullptr) {
      diagnostics_.error(line.at, fmt::format("there is no action '{}' in this POU; those of others are called by the "
                                              "name of an instance: motor.{}",
                                              line.name, line.name));
      return false;
    }
    if (line.name.empty() && line.inlined == nullptr) {
      diagnostics_.error(line.at, "this action has neither a name nor code");
      return false;
    }
    return true;
  }

  void add(ast::Statement statement) { code_.body.push_back(std::move(statement)); }
  void when(ast::Expression condition, ast::Statement statement) {
    ast::Body body;
    body.push_back(std::move(statement));
    add(make::when(std::move(condition), std::move(body)));
  }
  // Declares a hidden variable of this kind; returns its name.
  std::string hidden(ast::Section section, std::string_view letters, std::size_t number, ast::TypeSpec type) {
    const std::string name = fmt::format("_{}{}", letters, number);
    code_.variables.push_back(make::variable(section, name, std::move(type)));
    return name;
  }

  void lower(const Group& group, std::size_t number) {
    const Place at = chart_.actions[group.associations.front()].line->at;
    const ast::TypeSpec boolean = make::type(at, Elementary::Bool);
    std::vector<ast::Expression> resets;
    for (const std::size_t i : group.associations) {
      const Association& association = chart_.actions[i];
      if (association.line->qualifier == "R") {
        resets.push_back(active(chart_, association.step, at));
      }
    }
    const ast::Expression reset = any_of(std::move(resets), at);
    std::vector<ast::Expression> levels;
    std::vector<ast::Expression> pulses;
    for (const std::size_t i : group.associations) {
      const Association& association = chart_.actions[i];
      const std::string& qualifier = association.line->qualifier;
      if (qualifier == network::kWhileActive) {
        pulses.push_back(active(chart_, association.step, association.line->at));
      } else if (qualifier.starts_with('P')) {
        pulses.push_back(edge(association, qualifier == "P0"));
      } else if (qualifier != "R") {
        levels.push_back(on(association, i, reset));
      }
    }
    ast::Expression level = any_of(std::move(levels), at);
    ast::Expression pulse = any_of(std::move(pulses), at);
    if (!is_false(reset)) {
      level = make::both(std::move(level), make::negation(reset));
    }
    if (group.body == nullptr) {
      level = join(std::move(level), std::move(pulse));
      pulse = make::truth(at, false);
    }
    if (is_false(level) && group.body != nullptr) {
      code(group, number, std::move(pulse));
      return;
    }
    const std::string now = hidden(ast::Section::Temp, "al", number, boolean);
    const std::string before = hidden(ast::Section::Local, "aq", number, boolean);
    add(make::assign(make::name(at, now), std::move(level)));
    ast::Expression runs = join(make::either(make::name(at, now), make::name(at, before)), std::move(pulse));
    if (group.body == nullptr) {
      variable(group, at, now, std::move(runs), reset);
    } else {
      code(group, number, std::move(runs));
    }
    add(make::assign(make::name(at, before), make::name(at, now)));
  }

  void variable(const Group& group, const Place& at, const std::string& now, ast::Expression runs,
                const ast::Expression& reset) {
    auto target = st::parse_expression({group.name, at}, diagnostics_);
    if (!target) {
      return;
    }
    when(std::move(runs), make::assign(*target, make::name(at, now)));
    if (!is_false(reset)) {
      when(reset, make::assign(std::move(*target), make::truth(at, false)));
    }
  }

  void code(const Group& group, std::size_t number, ast::Expression runs) {
    Lowered inner = around_.action_code(*group.body, fmt::format("a{}_", number));
    std::move(inner.variables.begin(), inner.variables.end(), std::back_inserter(code_.variables));
    add(make::when(std::move(runs), std::move(inner.body)));
  }

  // Returns TRUE on entry to, or on exit from, the step.
  ast::Expression edge(const Association& association, bool on_exit) {
    const Place& at = association.line->at;
    ast::Expression now = active(chart_, association.step, at);
    ast::Expression before = make::name(at, step_before(association.step));
    return on_exit ? make::both(std::move(before), make::negation(std::move(now)))
                   : make::both(std::move(now), make::negation(std::move(before)));
  }

  ast::Expression on(const Association& association, std::size_t number, const ast::Expression& reset) {
    const Place& at = association.line->at;
    const std::string& qualifier = association.line->qualifier;
    ast::Expression step = active(chart_, association.step, at);
    if (qualifier == "N" || qualifier.empty()) {
      return step;
    }
    if (qualifier == "L" || qualifier == "D") {
      return timed(association, number, std::move(step), qualifier == "L");
    }
    const std::string stored = hidden(ast::Section::Local, "as", number, make::type(at, Elementary::Bool));
    ast::Expression begins = qualifier == "DS" ? timed(association, number, std::move(step), false) : std::move(step);
    when(std::move(begins), make::assign(make::name(at, stored), make::truth(at, true)));
    if (!is_false(reset)) {
      when(reset, make::assign(make::name(at, stored), make::truth(at, false)));
    }
    if (qualifier == "SD" || qualifier == "SL") {
      return timed(association, number, make::name(at, stored), qualifier == "SL");
    }
    return make::name(at, stored);
  }

  // Returns whether `input` has been true for the duration or, if `limit`, whether it is true for less than the
  // duration.
  ast::Expression timed(const Association& association, std::size_t number, ast::Expression input, bool limit) {
    const Place& at = association.line->at;
    const std::string timer = hidden(ast::Section::Local, "at", number, make::type(at, std::string(kTimerType)));
    auto duration = st::parse_expression({association.line->duration, at}, diagnostics_);
    std::vector<ast::Argument> arguments;
    arguments.push_back(make::argument("IN", input));
    arguments.push_back(make::argument("PT", duration ? std::move(*duration) : make::truth(at, false)));
    add(make::call_statement(make::call(at, make::name(at, timer), std::move(arguments))));
    ast::Expression over = make::member(at, timer, "Q");
    return limit ? make::both(std::move(input), make::negation(std::move(over))) : over;
  }

  static bool is_false(const ast::Expression& expression) noexcept {
    const bool* value = std::get_if<bool>(&expression.value);
    return expression.kind == ast::Expression::Kind::Literal && value != nullptr && !*value;
  }
  static ast::Expression any_of(std::vector<ast::Expression> values, const Place& at) {
    return values.empty() ? make::truth(at, false) : make::any_of(std::move(values));
  }
  static ast::Expression join(ast::Expression left, ast::Expression right) {
    if (is_false(left)) {
      return right;
    }
    return is_false(right) ? std::move(left) : make::either(std::move(left), std::move(right));
  }

  const Chart& chart_;
  const ChartSurroundings& around_;
  Diagnostics& diagnostics_;
  std::deque<network::Body> calls_;  // calls of actions of other POUs
  Lowered code_;
};

}  // namespace

ast::Expression active(const Chart& chart, std::size_t step, const Place& at) {
  return make::member(at, chart.steps[step].name, "X");
}

std::string step_before(std::size_t step) {
  return fmt::format("_sx{}", step);
}

Lowered lower_actions(const Chart& chart, const ChartSurroundings& around, Diagnostics& diagnostics) {
  return Actions(chart, around, diagnostics).run();
}

}  // namespace indurop::plc::lower
