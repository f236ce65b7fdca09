// SPDX-License-Identifier: Apache-2.0
// Names and values of what a model description describes.

#include "control/io/fmu/description.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>

namespace indurop::io::fmu {

namespace {

template <class T>
std::optional<T> whole_text(std::string_view text) {
  T value{};
  text.remove_prefix(text.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && !text.empty() ? std::optional(value)
                                                                                   : std::nullopt;
}

template <class T>
std::optional<long double> number_of(std::string_view text) {
  const auto value = whole_text<T>(text);
  return value ? std::optional(static_cast<long double>(*value)) : std::nullopt;
}

std::optional<long double> item_of(const Variable& variable, std::string_view text) {
  const auto item =
      std::find_if(variable.items.begin(), variable.items.end(), [text](const Item& one) { return one.name == text; });
  return item == variable.items.end() ? number_of<std::int64_t>(text)
                                      : std::optional(static_cast<long double>(item->value));
}

// The indices of "x[1,2]" as an element of a variable; from 1 in each dimension.
std::optional<std::size_t> element_of(const Variable& variable, std::string_view indices) {
  std::size_t element = 0;
  for (std::size_t i = 0; i < variable.dims.size(); ++i) {
    const std::size_t comma = indices.find(',');
    const auto index = whole_text<std::uint64_t>(indices.substr(0, comma));
    const bool is_last = i + 1 == variable.dims.size();
    if (!index || *index == 0 || *index > variable.dims[i] || is_last != (comma == std::string_view::npos)) {
      return std::nullopt;
    }
    element = element * variable.dims[i] + (*index - 1);
    indices.remove_prefix(is_last ? indices.size() : comma + 1);
  }
  return element;
}

}  // namespace

const char* name_of(Version version) noexcept {
  return version == Version::Fmi2 ? "FMI 2.0" : "FMI 3.0";
}

const char* name_of(Type type) noexcept {
  constexpr std::array kNames{"Float32", "Float64", "Int8",    "UInt8",       "Int16",  "UInt16", "Int32", "UInt32",
                              "Int64",   "UInt64",  "Boolean", "Enumeration", "String", "Binary", "Clock"};
  return kNames.at(static_cast<std::size_t>(type));
}

const char* name_of(Causality causality) noexcept {
  constexpr std::array kNames{"input", "output",     "parameter", "calculatedParameter", "structuralParameter",
                              "local", "independent"};
  return kNames.at(static_cast<std::size_t>(causality));
}

std::size_t Variable::size() const noexcept {
  std::size_t size = 1;
  for (const std::uint64_t dim : dims) {
    size *= dim;
  }
  return size;
}

std::optional<Place> find_place(const Description& description, std::string_view name) {
  if (const auto found = description.by_name.find(std::string(name)); found != description.by_name.end()) {
    return Place{found->second, 0, true};
  }
  const std::size_t bracket = name.rfind('[');
  if (bracket == std::string_view::npos || !name.ends_with(']')) {
    return std::nullopt;
  }
  const auto found = description.by_name.find(std::string(name.substr(0, bracket)));
  if (found == description.by_name.end() || description.variables[found->second].dims.empty()) {
    return std::nullopt;
  }
  const auto element =
      element_of(description.variables[found->second], name.substr(bracket + 1, name.size() - bracket - 2));
  return element ? std::optional(Place{found->second, *element, false}) : std::nullopt;
}

std::string element_name(const Variable& variable, std::size_t element) {
  std::string indices;
  for (auto dim = variable.dims.rbegin(); dim != variable.dims.rend(); ++dim) {
    indices = fmt::format("{}{}{}", element % *dim + 1, indices.empty() ? "" : ",", indices);
    element /= *dim;
  }
  return indices.empty() ? variable.name : fmt::format("{}[{}]", variable.name, indices);
}

std::optional<long double> read_number(const Variable& variable, std::string_view text) {
  switch (variable.type) {
    case Type::Float32: {
      const auto value = whole_text<double>(text);
      constexpr double kMost = std::numeric_limits<float>::max();
      const bool fits = value && !(std::isfinite(*value) && std::fabs(*value) > kMost);
      return fits ? std::optional<long double>(static_cast<float>(*value)) : std::nullopt;
    }
    case Type::Float64:
      return number_of<double>(text);
    case Type::Int8:
      return number_of<std::int8_t>(text);
    case Type::UInt8:
      return number_of<std::uint8_t>(text);
    case Type::Int16:
      return number_of<std::int16_t>(text);
    case Type::UInt16:
      return number_of<std::uint16_t>(text);
    case Type::Int32:
      return number_of<std::int32_t>(text);
    case Type::UInt32:
      return number_of<std::uint32_t>(text);
    case Type::Int64:
      return number_of<std::int64_t>(text);
    case Type::UInt64:
      return number_of<std::uint64_t>(text);
    case Type::Boolean:
      return text == "true" || text == "1"    ? std::optional<long double>(1)
             : text == "false" || text == "0" ? std::optional<long double>(0)
                                              : std::nullopt;
    case Type::Enumeration:
      return item_of(variable, text);
    case Type::String:
    case Type::Binary:
    case Type::Clock:
      break;
  }
  return std::nullopt;
}

std::vector<long double> read_numbers(const Variable& variable, const std::string& text) {
  std::vector<std::string> words;
  if (variable.dims.empty()) {
    words.push_back(text);
  } else {
    std::istringstream stream(text);
    for (std::string word; stream >> word;) {
      words.push_back(std::move(word));
    }
  }
  std::vector<long double> numbers;
  for (const std::string& word : words) {
    const auto number = read_number(variable, word);
    if (!number) {
      return {};
    }
    numbers.push_back(*number);
  }
  return numbers.size() == 1 || numbers.size() == variable.size() ? numbers : std::vector<long double>();
}

}  // namespace indurop::io::fmu
