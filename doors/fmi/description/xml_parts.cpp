// SPDX-License-Identifier: Apache-2.0
#include "doors/fmi/description/xml_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "core/base/printable.h"
#include "core/schema/leaf.h"
#include "doors/fmi/description/units.h"

namespace indurop::fmi {
namespace {

// Returns the bytes of the initial value of a part.
std::vector<std::uint8_t> initial_bytes(const ChosenVariable& variable) {
  const std::vector<std::uint8_t>& whole = variable.shared->declaration->initial;
  const std::size_t size = variable.part.type->element_size;
  if (whole.empty()) {
    return std::vector<std::uint8_t>(size);
  }
  const auto begin = whole.begin() + variable.part.offset;
  return {begin, begin + static_cast<std::ptrdiff_t>(size)};
}

// Returns a number as XML Schema writes it.
template <class T>
std::string number_text(T value) {
  if constexpr (std::is_floating_point_v<T>) {
    if (!std::isfinite(value)) {
      return std::isnan(value) ? "NaN" : value > 0 ? "INF" : "-INF";
    }
  }
  return fmt::format("{}", value);
}

struct Limits {
  double least = 0;
  double most = 0;
};
Limits limits_of_type(schema::Base base) {
  Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const std::uint64_t none = 0;
  schema::with_number(base, reinterpret_cast<const std::uint8_t*>(&none), [&limits](auto number) {
    using Number = decltype(number);
    if constexpr (std::is_integral_v<Number>) {
      limits = {static_cast<double>(std::numeric_limits<Number>::min()),
                static_cast<double>(std::numeric_limits<Number>::max())};
    }
  });
  return limits;
}

}  // namespace

std::string attribute(std::string_view name, std::string_view text) {
  std::string value;
  for (const char c : base::printable(text, "\n\t")) {
    switch (c) {
      case '&':
        value += "&amp;";
        break;
      case '<':
        value += "&lt;";
        break;
      case '>':
        value += "&gt;";
        break;
      case '"':
        value += "&quot;";
        break;
      case '\n':
      case '\t':
        value += fmt::format("&#{};", static_cast<int>(c));
        break;
      default:
        value += c;
    }
  }
  return fmt::format(" {}=\"{}\"", name, value);
}

std::string attribute_if(std::string_view name, std::string_view text) {
  return text.empty() ? std::string() : attribute(name, text);
}

std::string start_of(const ChosenVariable& variable) {
  const std::vector<std::uint8_t> bytes = initial_bytes(variable);
  const schema::Base base = variable.part.type->base;
  if (base == schema::Base::Text) {
    return {bytes.begin(), std::find(bytes.begin(), bytes.end(), 0)};
  }
  if (base == schema::Base::Bool) {
    return bytes[0] != 0 ? "true" : "false";
  }
  const schema::Base stored = base == schema::Base::Enum   ? schema::Base::Int32
                              : base == schema::Base::Char ? schema::Base::UInt8
                                                           : base;
  std::string text;
  schema::with_number(stored, bytes.data(), [&text](auto number) { text = number_text(number); });
  return text;
}

std::string limits_of(const ChosenVariable& variable) {
  const schema::Base base = variable.part.type->base;
  const auto& range = variable.part.range;
  const bool real = base == schema::Base::Double || base == schema::Base::Float;
  if (!range || base == schema::Base::Bool || base == schema::Base::Enum || base == schema::Base::Text) {
    return {};
  }
  const auto initial = schema::as_number<double>(base, initial_bytes(variable).data());
  if (!initial || !(*initial >= range->min && *initial <= range->max)) {
    return {};  // the standard demands that min <= start <= max
  }
  const Limits type = limits_of_type(base);
  std::string text;
  if (range->min > type.least) {
    text += attribute("min", real ? number_text(range->min) : fmt::format("{:.0f}", std::ceil(range->min)));
  }
  if (range->max < type.most) {
    text += attribute("max", real ? number_text(range->max) : fmt::format("{:.0f}", std::floor(range->max)));
  }
  return text;
}

std::string unit_definitions(const Description& description, bool (*has_unit)(schema::Base base)) {
  std::set<std::string> units;
  for (const ChosenVariable& variable : description.variables) {
    if (!variable.part.unit.empty() && has_unit(variable.part.type->base)) {
      units.insert(variable.part.unit);
    }
  }
  std::string text;
  for (const std::string& unit : units) {
    const auto si = unit_in_si(unit);
    if (!si) {
      text += fmt::format("    <Unit{}/>\n", attribute("name", unit));
      continue;
    }
    std::string in_si;
    for (std::size_t i = 0; i < kSiNames.size(); ++i) {
      in_si += si->exponents[i] == 0 ? "" : attribute(kSiNames[i], fmt::format("{}", si->exponents[i]));
    }
    in_si += si->factor == 1 ? "" : attribute("factor", number_text(si->factor));
    in_si += si->offset == 0 ? "" : attribute("offset", number_text(si->offset));
    text += fmt::format("    <Unit{}><BaseUnit{}/></Unit>\n", attribute("name", unit), in_si);
  }
  return text.empty() ? text : fmt::format("  <UnitDefinitions>\n{}  </UnitDefinitions>\n", text);
}

std::map<std::string, const schema::Type*> enumerations_of(const Description& description) {
  std::map<std::string, const schema::Type*> all;
  for (const ChosenVariable& variable : description.variables) {
    if (variable.part.type->base == schema::Base::Enum) {
      all.emplace(variable.part.type->name, variable.part.type);
    }
  }
  return all;
}

std::string items_of(const schema::Type& enumeration) {
  std::set<std::int64_t> known;
  std::string text;
  for (const schema::Enumerator& one : enumeration.enumerators) {
    if (known.insert(one.value).second) {
      text += fmt::format("        <Item{}{}/>\n", attribute("name", one.name),
                          attribute("value", fmt::format("{}", one.value)));
    }
  }
  return text;
}

std::string log_categories() {
  std::string text = "  <LogCategories>\n";
  for (const auto& [name, words] :
       {std::pair("logStatusWarning", "modules that faulted"),
        std::pair("logStatusDiscard", "values that a variable does not take"),
        std::pair("logStatusError", "why a call failed"), std::pair("node", "what the node and its modules print")}) {
    text += fmt::format("    <Category{}{}/>\n", attribute("name", name), attribute("description", words));
  }
  return text + "  </LogCategories>\n";
}

std::string default_experiment(const Description& description) {
  return fmt::format("  <DefaultExperiment startTime=\"0\" stepSize=\"{}\"/>\n", description.period_s);
}

}  // namespace indurop::fmi
