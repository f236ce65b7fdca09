// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/shadow/accepted_differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "core/base/text.h"

namespace indurop::tools {
namespace {

using schema::Comparison;

// Longer symbols first.
constexpr std::array kComparisons{Comparison::Equal, Comparison::LessEqual, Comparison::Less};

// Returns nothing for text that is not a number >= 0.
std::optional<double> limit_of(std::string_view text) {
  double number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  return read.ec == std::errc() && read.ptr == text.data() + text.size() && number >= 0 ? std::optional(number)
                                                                                        : std::nullopt;
}

}  // namespace

Result<AcceptedDifferences::Rule, base::Problem> AcceptedDifferences::parse_rule(std::string_view text) {
  for (const Comparison comparison : kComparisons) {
    const std::string_view symbol = schema::symbol_of(comparison);
    const std::size_t at = text.find(symbol);
    if (at == std::string_view::npos) {
      continue;
    }
    const auto limit = limit_of(base::trimmed(text.substr(at + symbol.size())));
    const std::string_view pattern = base::trimmed(text.substr(0, at));
    if (limit && !pattern.empty()) {
      return Rule{std::string(text), std::string(pattern), comparison, *limit};
    }
    break;
  }
  return base::Problem{fmt::format(
      "'{}' is no rule; write a variable or a glob, == < or <=, and the largest difference: \"O* == 0, joint "
      "< 0.01\"",
      text)};
}

Result<AcceptedDifferences, base::Problem> AcceptedDifferences::parse(std::string_view text) {
  AcceptedDifferences accepted;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(','), text.size());
    auto rule = parse_rule(base::trimmed(text.substr(0, end)));
    if (!rule) {
      return std::move(rule).error();
    }
    accepted.rules_.push_back(std::move(rule).value());
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return accepted;
}

bool AcceptedDifferences::accept(std::string_view variable, double largest) const {
  bool any = false;
  for (const Rule& rule : rules_) {
    if (!schema::glob_match(rule.pattern, variable)) {
      continue;
    }
    any = true;
    const bool holds = rule.comparison == Comparison::Equal       ? largest == rule.limit
                       : rule.comparison == Comparison::LessEqual ? largest <= rule.limit
                                                                  : largest < rule.limit;
    if (!holds) {
      return false;
    }
  }
  return any;
}

std::vector<std::string> AcceptedDifferences::unmatched(const std::vector<std::string>& variables) const {
  std::vector<std::string> texts;
  for (const Rule& rule : rules_) {
    if (std::none_of(variables.begin(), variables.end(),
                     [&](const std::string& name) { return schema::glob_match(rule.pattern, name); })) {
      texts.push_back(rule.text);
    }
  }
  return texts;
}

}  // namespace indurop::tools
