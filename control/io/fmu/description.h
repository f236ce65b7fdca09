// SPDX-License-Identifier: Apache-2.0
// The modelDescription.xml of an FMU (FMI 2.0 and 3.0) as data, as far as co-simulation needs it.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/base/diagnostic.h"

namespace indurop::io::fmu {

enum class Version { Fmi2, Fmi3 };
const char* name_of(Version version) noexcept;

// Those of FMI 3. FMI 2: Real is Float64, Integer is Int32.
enum class Type {
  Float32,
  Float64,
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Boolean,
  Enumeration,
  String,
  Binary,
  Clock
};
const char* name_of(Type type) noexcept;
// A number, a bool or an enumerator: what a point of I/O dispatch can be.
constexpr bool is_number(Type type) noexcept {
  return type < Type::String;
}

enum class Causality {
  Input,
  Output,
  Parameter,
  CalculatedParameter,
  StructuralParameter,
  Local,
  Independent,
};
const char* name_of(Causality causality) noexcept;
enum class Variability { Constant, Fixed, Tunable, Discrete, Continuous };

struct Item {  // of an enumeration
  std::string name;
  std::int64_t value = 0;
};

struct Variable {
  std::string name;
  std::uint32_t reference = 0;
  Type type = Type::Float64;
  Causality causality = Causality::Local;
  Variability variability = Variability::Continuous;
  bool has_settable_start = false;  // initial="exact" or "approx"
  std::vector<std::uint64_t> dims;  // FMI 3, outermost first; empty: one value
  std::vector<std::string> start;   // as written: none, one for all elements, or one for each
  std::string unit;
  std::string description;
  std::optional<double> min;
  std::optional<double> max;
  std::vector<Item> items;  // Enumeration
  base::SourcePlace place;
  [[nodiscard]] std::size_t size() const noexcept;  // of all elements
};

struct Description {
  Version version = Version::Fmi2;
  std::string model;
  std::string token;       // guid, instantiationToken
  std::string identifier;  // name of the library
  bool any_step = false;   // steps may have different lengths
  std::vector<std::string> log_categories;
  std::vector<Variable> variables;
  std::unordered_map<std::string, std::size_t> by_name;  // indices into variables
};

// One element of a variable.
struct Place {
  std::size_t variable = 0;  // index into Description::variables
  std::size_t element = 0;
  bool is_whole = true;  // the name is that of the variable: all its elements
};
// "cylinder.s", or an element of an array of FMI 3: "x[1,2]", counted from 1. A variable that has this name goes before
// an element.
std::optional<Place> find_place(const Description& description, std::string_view name);
// The name of an element: "x[1,2]"; that of the variable if it is no array.
std::string element_name(const Variable& variable, std::size_t element);

// The number of a text of this type: "true", "2.5e3", the name of an item. Nothing if it is none, or does not fit.
std::optional<long double> read_number(const Variable& variable, std::string_view text);
// The numbers of all elements: one for all, or one for each, separated by blanks. Empty: they are none, or too many.
std::vector<long double> read_numbers(const Variable& variable, const std::string& text);

struct ReadDescription {
  Description description;
  std::vector<base::Diagnostic> diagnostics;
};
// Reads any bytes; `file` is named in messages. Reports all errors at once. Not real-time safe.
ReadDescription read_description(std::string_view xml, const std::string& file);

}  // namespace indurop::io::fmu
