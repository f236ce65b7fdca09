// SPDX-License-Identifier: Apache-2.0
#include "doors/fmi/description/choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/text.h"

namespace indurop::fmi {
namespace {

constexpr std::uint64_t kMostVariables = 100'000;

// Patterns of one option, and which of them had a match.
class Patterns {
 public:
  explicit Patterns(const std::vector<std::string>& patterns) : patterns_(patterns), used_(patterns.size()) {}

  [[nodiscard]] bool empty() const { return patterns_.empty(); }
  bool match(const std::string& variable, const std::string& part) {
    std::string path = part;  // a '.' of a pattern stands for "::"
    for (std::size_t at = path.find('.'); at != std::string::npos; at = path.find('.', at)) {
      path.replace(at, 1, "::");
    }
    bool any = false;
    for (std::size_t i = 0; i < patterns_.size(); ++i) {
      const std::string& pattern = patterns_[i];
      if (pattern == part || schema::glob_match(pattern, variable) || schema::glob_match(pattern, path)) {
        used_[i] = true;
        any = true;
      }
    }
    return any;
  }
  // Returns the first pattern without a match; empty: there is none.
  [[nodiscard]] std::string unmatched() const {
    const auto found = std::find(used_.begin(), used_.end(), false);
    return found == used_.end() ? "" : patterns_[static_cast<std::size_t>(found - used_.begin())];
  }

 private:
  const std::vector<std::string>& patterns_;
  std::vector<bool> used_;
};

std::vector<std::string> boards_of(std::span<const config::BoardView> views, const std::string& variable,
                                   std::size_t owner, bool only_owner) {
  std::vector<std::string> boards{views[owner].name};
  for (std::size_t board = 0; board < views.size() && !only_owner; ++board) {
    if (board != owner && schema::find_variable(views[board].result.schema, variable) != nullptr) {
      boards.push_back(views[board].name);
    }
  }
  return boards;
}

void warn_of_writers(Choice& choice, const SharedVariable& shared) {
  choice.warnings.push_back(fmt::format(
      "{} is an input although {} writes it: a value that is set counts until the module writes the next one",
      shared.declaration->name, base::enumerate(shared.writers)));
}

}  // namespace

std::vector<SharedVariable> shared_variables(std::span<const config::BoardView> views,
                                             const std::map<std::string, std::size_t>& owners,
                                             const std::set<std::string>& routed) {
  const config::Uses uses(views);
  const bool all = !uses.unknown_readers().empty() || !uses.unknown_writers().empty();
  std::vector<SharedVariable> variables;
  for (const auto& [name, owner] : owners) {
    const auto used = uses.variables().find(name);
    if (used == uses.variables().end() && !all) {
      continue;
    }
    SharedVariable shared;
    shared.declaration = schema::find_variable(views[owner].result.schema, name);
    if (used != uses.variables().end()) {
      shared.writers = uses.names(used->second.writers);
      shared.read = !used->second.readers.empty();
    }
    // A value that travels is set on the board that owns it. One that does not has no other way to the readers.
    shared.boards = boards_of(views, name, owner, routed.contains(name) || !shared.writers.empty());
    if (shared.declaration != nullptr) {
      variables.push_back(std::move(shared));
    }
  }
  return variables;
}

Result<Choice, base::Problem> choose(const std::vector<SharedVariable>& variables,
                                     const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
  Patterns in(inputs);
  Patterns out(outputs);
  Choice choice;
  for (const SharedVariable& shared : variables) {
    const std::string& name = shared.declaration->name;
    bool warned = shared.writers.empty();
    const bool unwritten = shared.writers.empty() && shared.read;
    if (count_parts(shared.declaration->type) > kMostVariables) {
      return base::Problem{fmt::format(
          "{} has {} parts; an FMU has at most {} variables: a module can copy what is needed to a smaller one", name,
          count_parts(shared.declaration->type), kMostVariables)};
    }
    for_each_part(*shared.declaration, [&](ShownPart part) {
      const bool input = in.empty() ? unwritten : in.match(name, part.name);
      if (input && !std::exchange(warned, true)) {
        warn_of_writers(choice, shared);
      }
      const bool named = out.match(name, part.name);
      if (input || named || (out.empty() && !(unwritten && !in.empty()))) {
        choice.variables.push_back({std::move(part), &shared, input});
      }
    });
    if (choice.variables.size() > kMostVariables) {
      return base::Problem{fmt::format(
          "the FMU would have more than {} variables: choose some with --inputs and --outputs", kMostVariables)};
    }
  }
  for (const auto& [patterns, option] : {std::pair(&in, "--inputs"), std::pair(&out, "--outputs")}) {
    if (const std::string pattern = patterns->unmatched(); !pattern.empty()) {
      return base::Problem{
          fmt::format("{} {}: no shared variable of the configuration, and no part of one, has such a name", option,
                      base::in_quotes(pattern))};
    }
  }
  return choice.variables.empty() ? Result<Choice, base::Problem>(base::Problem{"the modules share no variables"})
                                  : Result<Choice, base::Problem>(std::move(choice));
}

}  // namespace indurop::fmi
