// SPDX-License-Identifier: Apache-2.0
#include "config/check/io_fmu.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <map>
#include <set>
#include <utility>

#include "control/io/fmu/fmu_file.h"
#include "core/base/text.h"

namespace indurop::config {

namespace {

namespace fmu = io::fmu;
using fmu::Causality;
using fmu::Variability;

constexpr std::size_t kMaxPoints = 100'000;

std::vector<std::string> names_of(const fmu::Description& description) {
  std::vector<std::string> names;
  for (const fmu::Variable& variable : description.variables) {
    names.push_back(variable.name);
  }
  return names;
}

// "joint[1].phi": joint_1_phi.
std::string identifier_of(const std::string& name) {
  std::string text;
  for (const char c : name) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 && static_cast<unsigned char>(c) < 0x80;
    if (is_plain || (!text.empty() && text.back() != '_')) {
      text += is_plain ? c : '_';
    }
  }
  while (text.ends_with('_')) {
    text.pop_back();
  }
  return text.empty() || std::isdigit(static_cast<unsigned char>(text.front())) != 0 ? "v" + text : text;
}

bool is_declared(const fmu::Variable& variable) {
  return fmu::is_number(variable.type) &&
         (variable.causality == Causality::Input || variable.causality == Causality::Output);
}

// The names of the declared variables, by their index in the description; unique.
std::map<std::size_t, std::string> declared_names(const IoDevice& device, const fmu::Description& description) {
  std::map<std::size_t, std::string> names;
  std::set<std::string> known;
  for (std::size_t i = 0; i < description.variables.size(); ++i) {
    const fmu::Variable& variable = description.variables[i];
    if (is_declared(variable)) {
      std::string name = identifier_of(variable.name);
      while (!known.insert(name).second) {
        name += fmt::format("_{}", variable.reference);
      }
      names.emplace(i, fmt::format("{}::{}", device.fmu.variables, name));
    }
  }
  return names;
}

// "[1][2]", from 0 as in shared variables.
std::string shared_indices(const fmu::Variable& variable, std::size_t element) {
  std::string indices;
  for (auto dim = variable.dims.rbegin(); dim != variable.dims.rend(); ++dim) {
    indices = fmt::format("[{}]{}", element % *dim, indices);
    element /= *dim;
  }
  return indices;
}

schema::Base base_of(fmu::Type type) {
  using schema::Base;
  switch (type) {
    case fmu::Type::Float32:
      return Base::Float;
    case fmu::Type::Int8:
      return Base::Int8;
    case fmu::Type::UInt8:
      return Base::UInt8;
    case fmu::Type::Int16:
      return Base::Int16;
    case fmu::Type::UInt16:
      return Base::UInt16;
    case fmu::Type::Int32:
    case fmu::Type::Enumeration:
      return Base::Int32;
    case fmu::Type::UInt32:
      return Base::UInt32;
    case fmu::Type::Int64:
      return Base::Int64;
    case fmu::Type::UInt64:
      return Base::UInt64;
    case fmu::Type::Boolean:
      return Base::Bool;
    case fmu::Type::Float64:
    case fmu::Type::String:
    case fmu::Type::Binary:
    case fmu::Type::Clock:
      break;
  }
  return Base::Double;
}

// The start value as `indurop set` takes it; of vectors, too.
std::string initial_text(const fmu::Variable& variable) {
  std::string text;
  for (std::size_t i = 0; i < variable.size(); ++i) {
    const auto number = fmu::read_number(variable, variable.start[i < variable.start.size() ? i : 0]).value_or(0);
    const bool is_bool = variable.type == fmu::Type::Boolean;
    text +=
        fmt::format("{}{}", i == 0 ? "" : ", ", is_bool ? number != 0 ? "true" : "false" : fmt::format("{}", number));
  }
  return variable.dims.empty() ? text : "[" + text + "]";
}

schema::Variable declare(const fmu::Variable& variable, const std::string& name, const IoDevice& device) {
  schema::Variable declared;
  declared.name = name;
  declared.type.base = base_of(variable.type);
  declared.type.element_size = declared.type.align = schema::size_of(declared.type.base);
  for (const std::uint64_t dim : variable.dims) {
    declared.type.dims.push_back(static_cast<std::uint32_t>(dim));
  }
  declared.kind = variable.dims.empty() ? abi::Kind::Scalar : abi::Kind::Ring;
  declared.type_hash = schema::hash_of(declared.type);
  declared.unit = variable.unit;
  declared.description = variable.description;
  declared.source = device.fmu.as_written;
  if (variable.min && variable.max && *variable.min <= *variable.max) {
    declared.range = schema::Range{*variable.min, *variable.max};
  }
  if (variable.causality == Causality::Input && !variable.start.empty() && variable.dims.size() < 2) {
    declared.initial.resize(declared.type.size());
    declared.given = true;
    if (!schema::parse_value(declared.type, initial_text(variable), declared.initial)) {
      declared.initial.clear();
    }
  }
  return declared;
}

// Checks points and start values of a device with the description of its FMU.
class FmuCheck {
 public:
  FmuCheck(const IoDevice& device, const fmu::Description& description, base::Diagnostics& report)
      : device_(device), description_(description), report_(report) {}

  std::vector<IoPoint> points() {
    for (const auto& [index, name] : declared()) {
      const fmu::Variable& variable = description_.variables[index];
      IoPoint point;
      point.output = variable.causality == Causality::Input;
      point.variable = name;
      point.at = variable.name;
      point.type = WireType::Float64;
      point.place = point.variable_place = point.at_place = device_.fmu.variables_place;
      add(point, {index, 0, true});
    }
    for (const IoPoint& point : device_.points) {
      if (const auto place = find(point.at, point.at_place);
          place && check(point, description_.variables[place->variable])) {
        add(point, *place);
      }
    }
    if (points_.size() > kMaxPoints) {
      report_.error(device_.place, fmt::format("{} points; an FMU has at most {}", points_.size(), kMaxPoints));
      points_.clear();
    }
    return std::move(points_);
  }

  void check_starts() {
    for (const IoFmuStart& start : device_.fmu.starts) {
      if (const auto place = find(start.at, start.at_place)) {
        check(start, *place);
      }
    }
  }

 private:
  [[nodiscard]] std::map<std::size_t, std::string> declared() const {
    return device_.fmu.variables.empty() ? std::map<std::size_t, std::string>() : declared_names(device_, description_);
  }

  std::optional<fmu::Place> find(const std::string& name, base::SourcePlace where) {
    auto place = fmu::find_place(description_, name);
    if (!place && !name.empty()) {
      const std::string near = report_.full() ? std::string() : base::closest_name(name, names_of(description_));
      report_.error(
          where,
          fmt::format("at: {0} has no variable {1}; {2}", device_.fmu.as_written, base::in_quotes(name),
                      near.empty() ? "`indurop io import` lists them" : "did you mean " + base::in_quotes(near) + "?"));
    }
    return place;
  }

  bool check(const IoPoint& point, const fmu::Variable& variable) {
    const auto wrong = [&](const std::string& text) {
      report_.error(point.at_place, fmt::format("at: {} is {}", base::in_quotes(point.at), text));
      return false;
    };
    const bool is_text = variable.type == fmu::Type::String && variable.dims.empty();
    if (!fmu::is_number(variable.type) && !is_text) {
      return wrong(fmt::format("{}{}; a point is a number, a bool, an enumerator or a text",
                               variable.dims.empty() ? "a " : "an array of ", fmu::name_of(variable.type)));
    }
    const bool is_tunable = variable.causality == Causality::Parameter && variable.variability == Variability::Tunable;
    if (!point.output || variable.causality == Causality::Input || is_tunable) {
      return true;
    }
    if (variable.causality == Causality::Parameter) {
      return wrong("a parameter that does not change while the FMU runs; give its value by <set>");
    }
    return wrong(
        fmt::format("of causality {}; an <output> goes to an input or a tunable parameter of the FMU. What the "
                    "FMU gives is an <input>",
                    fmu::name_of(variable.causality)));
  }

  void check(const IoFmuStart& start, const fmu::Place& place) {
    const fmu::Variable& variable = description_.variables[place.variable];
    const auto wrong = [&](base::SourcePlace where, const std::string& text) {
      report_.error(where, fmt::format("<set>: {} is {}", base::in_quotes(start.at), text));
    };
    const bool is_settable = variable.causality == Causality::Input || variable.causality == Causality::Parameter ||
                             (variable.has_settable_start &&
                              (variable.causality == Causality::Local || variable.causality == Causality::Output));
    if (variable.causality == Causality::StructuralParameter) {
      wrong(start.at_place, "a structural parameter; arrays have the sizes of the FMU. Remove it");
    } else if (!is_settable || variable.variability == Variability::Constant) {
      wrong(start.at_place, fmt::format("{} and has no start value that can be set",
                                        variable.variability == Variability::Constant
                                            ? "constant"
                                            : fmt::format("of causality {}", fmu::name_of(variable.causality))));
    } else if (!place.is_whole) {
      wrong(start.at_place, fmt::format("an element; give the values of all elements, at=\"{}\"", variable.name));
    } else if (variable.type == fmu::Type::String) {
      if (!variable.dims.empty()) {
        wrong(start.at_place, "an array of texts, which cannot be set; leave it out");
      }
    } else if (fmu::read_numbers(variable, start.value).empty()) {
      wrong(start.value_place, value_text(variable) + ", not " + base::in_quotes(start.value));
    }
  }

  static std::string value_text(const fmu::Variable& variable) {
    const std::string type = fmu::name_of(variable.type);
    if (variable.type == fmu::Type::Enumeration && !variable.items.empty()) {
      std::vector<std::string> names;
      for (const fmu::Item& item : variable.items) {
        names.push_back(base::in_quotes(item.name));
      }
      return fmt::format("an Enumeration with {}", base::enumerate(names));
    }
    return variable.dims.empty()
               ? "a " + type
               : fmt::format("{} elements of {}; write all of them, or one for all", variable.size(), type);
  }

  // One point for each element.
  void add(const IoPoint& point, const fmu::Place& place) {
    const fmu::Variable& variable = description_.variables[place.variable];
    const bool is_array = place.is_whole && !variable.dims.empty();
    for (std::size_t i = 0; i < (is_array ? variable.size() : 1) && points_.size() <= kMaxPoints; ++i) {
      IoPoint one = point;
      one.is_text = variable.type == fmu::Type::String;
      if (is_array) {
        one.at = fmu::element_name(variable, i);
        one.variable += shared_indices(variable, i);
      }
      if (point.output) {
        claim(variable, is_array ? i : place.element, one);
      }
      points_.push_back(std::move(one));
    }
  }

  // Variables with the same value reference are one.
  void claim(const fmu::Variable& variable, std::size_t element, const IoPoint& point) {
    const auto [first, is_new] = outputs_.try_emplace({variable.reference, element}, point.place);
    if (!is_new) {
      report_.error(
          point.at_place,
          fmt::format("{} is written by the output in line {} already; one variable of the FMU has one output",
                      base::in_quotes(point.at), first->second.line));
    }
  }

  const IoDevice& device_;
  const fmu::Description& description_;
  base::Diagnostics& report_;
  std::vector<IoPoint> points_;
  std::map<std::pair<std::uint32_t, std::size_t>, base::SourcePlace> outputs_;  // by value reference and element
};

}  // namespace

FmuPoints read_fmu_points(const IoDevice& device, base::Diagnostics& report) {
  FmuPoints read;
  if (device.fmu.file.empty()) {
    return read;  // reported
  }
  fmu::FmuFile file = fmu::read_fmu(device.fmu.file);
  if (!file.ok()) {
    report.error(device.fmu.file_place,
                 fmt::format("file: {} is no FMU that can be used", base::path_in_quotes(device.fmu.as_written)));
    read.diagnostics = std::move(file.diagnostics);
    return read;
  }
  if (const std::string missing = fmu::missing_library(file); !missing.empty()) {
    report.error(device.fmu.file_place,
                 fmt::format("file: {}: {}", base::path_in_quotes(device.fmu.as_written), missing));
  }
  FmuCheck check(device, file.description, report);
  read.points = check.points();
  check.check_starts();
  return read;
}

schema::Schema fmu_variables(const IoConfig& config) {
  schema::Schema declared;
  for (const IoDevice& device : config.devices) {
    if (device.driver != IoDriver::Fmu || device.fmu.variables.empty()) {
      continue;
    }
    const fmu::FmuFile file = fmu::read_fmu(device.fmu.file);
    if (!file.ok()) {
      continue;
    }
    schema::Schema own;
    for (const auto& [index, name] : declared_names(device, file.description)) {
      own.variables.push_back(declare(file.description.variables[index], name, device));
    }
    std::vector<std::string> differences;  // two devices with one namespace: read_fmu_points() finds two writers
    schema::merge(declared, own, differences);
  }
  return declared;
}

}  // namespace indurop::config
