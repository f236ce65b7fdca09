// SPDX-License-Identifier: Apache-2.0
#include "tools/client/scope/trigger.h"

#include <array>
#include <cmath>
#include <utility>

namespace indurop::tools {

Result<Trigger, base::Problem> Trigger::parse(std::string_view text, const FindOperand& find) {
  constexpr std::array<std::pair<std::string_view, Edge>, 3> kWords{
      {{" rises", Edge::Rises}, {" falls", Edge::Falls}, {" changes", Edge::Changes}}};
  while (text.ends_with(' ')) {
    text.remove_suffix(1);
  }
  Edge edge = Edge::Rises;
  for (const auto& [word, meaning] : kWords) {
    if (text.ends_with(word)) {
      edge = meaning;
      text.remove_suffix(word.size());
      break;
    }
  }
  auto formula = Formula::parse(text, find);
  if (!formula) {
    return base::Problem{formula.error().text +
                         "; a trigger is an expression (and or not == != < <= > >= + - * / abs "
                         "sqrt min max), then rises, falls or changes (default: rises)"};
  }
  return Trigger(std::move(formula).value(), edge);
}

bool Trigger::evaluate(std::span<const double> inputs) {
  const double now = formula_.value(inputs);
  if (std::isnan(now)) {
    return false;  // the previous value remains valid
  }
  const std::optional<double> before = std::exchange(before_, now);
  if (!before) {
    return false;
  }
  switch (edge_) {
    case Edge::Rises:
      return *before == 0 && now != 0;
    case Edge::Falls:
      return *before != 0 && now == 0;
    case Edge::Changes:
      return *before != now;
  }
  return false;
}

}  // namespace indurop::tools
