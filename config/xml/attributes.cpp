// SPDX-License-Identifier: Apache-2.0
#include "config/xml/attributes.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "config/xml/element_rules.h"
#include "config/xml/reader.h"
#include "config/xml/values.h"
#include "core/base/text.h"

namespace indurop::config {

const base::Attribute* Attributes::find(const char* name) {
  if (std::find(asked_.begin(), asked_.end(), name) == asked_.end()) {
    asked_.emplace_back(name);
  }
  return find_attribute(element_, name);
}

std::optional<std::string> Attributes::text(const char* name, base::SourcePlace* place) {
  const base::Attribute* found = find(name);
  if (found == nullptr) {
    return std::nullopt;
  }
  if (place != nullptr) {
    *place = found->value_place;
  }
  if (found->value.empty()) {
    report_.error(found->value_place, fmt::format("{} is empty; give a value or leave it out", name));
    return std::nullopt;
  }
  return found->value;
}

std::optional<std::string> Attributes::need(const char* name, std::string_view example, base::SourcePlace* place) {
  const base::Attribute* found = find(name);
  if (found == nullptr || found->value.empty()) {
    report_.error(element_.place, fmt::format("<{}> has no {}; write {}", element_.name, name, example));
    return std::nullopt;
  }
  if (place != nullptr) {
    *place = found->value_place;
  }
  return found->value;
}

std::optional<std::int64_t> Attributes::integer(const char* name, std::int64_t low, std::int64_t high) {
  const base::Attribute* found = find(name);
  if (found == nullptr) {
    return std::nullopt;
  }
  const auto value = read_integer(found->value, low, high);
  if (!value) {
    report_.error(found->value_place, fmt::format("{}: {} is not a whole number from {} to {}", name,
                                                  base::in_quotes(found->value), low, high));
  }
  return value;
}

std::optional<double> Attributes::real(const char* name, double low, double high) {
  const base::Attribute* found = find(name);
  if (found == nullptr) {
    return std::nullopt;
  }
  const std::string& text = found->value;
  const auto value = read_real(text);
  if (!value) {
    report_.error(found->value_place,
                  fmt::format("{}: {} is not a number; write 0.5, for example", name, base::in_quotes(text)));
    return std::nullopt;
  }
  if (*value < low || *value > high) {
    report_.error(found->value_place,
                  fmt::format("{}: {} is not possible; it goes from {} to {}", name, base::in_quotes(text), low, high));
    return std::nullopt;
  }
  return value;
}

std::optional<base::Nanos> Attributes::duration(const char* name, base::Nanos least, base::Nanos most) {
  const base::Attribute* found = find(name);
  if (found == nullptr) {
    return std::nullopt;
  }
  const base::DurationText read = base::read_duration(found->value, true);
  if (!read.value) {
    report_.error(found->value_place, fmt::format("{}: {}", name, read.problem));
  } else if (*read.value < least || *read.value > most) {
    report_.error(found->value_place,
                  fmt::format("{}: {} is not possible; it goes from {} to {}", name, base::in_quotes(found->value),
                              base::format_duration(least), base::format_duration(most)));
    return std::nullopt;
  }
  return read.value;
}

std::optional<std::size_t> Attributes::choose(const char* name, const std::vector<std::string>& words) {
  const base::Attribute* found = find(name);
  if (found == nullptr) {
    return std::nullopt;
  }
  const auto at = std::find(words.begin(), words.end(), found->value);
  if (at == words.end()) {
    report_.error(found->value_place,
                  fmt::format("{}: {} is none of {}", name, base::in_quotes(found->value), fmt::join(words, ", ")));
    return std::nullopt;
  }
  return static_cast<std::size_t>(at - words.begin());
}

void Attributes::finish(const std::string& where) {
  for (const base::Attribute& attribute : element_.attributes) {
    if (std::find(asked_.begin(), asked_.end(), attribute.name) == asked_.end()) {
      report_.error(attribute.place, fmt::format("unknown attribute {} of {}{}", base::in_quotes(attribute.name),
                                                 where.empty() ? "<" + element_.name + ">" : where,
                                                 base::suggestion(attribute.name, asked_)));
    }
  }
}

}  // namespace indurop::config
