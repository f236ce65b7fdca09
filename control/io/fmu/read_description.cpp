// SPDX-License-Identifier: Apache-2.0
// Reads modelDescription.xml. Tools write it, so only what prevents a co-simulation is an error.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>
#include <sstream>

#include "control/io/fmu/description.h"
#include "core/base/diagnostics.h"
#include "core/base/text.h"
#include "core/base/xml.h"

namespace indurop::io::fmu {

namespace {

using base::Element;

constexpr std::size_t kMaxElements = 1'000'000;  // of one variable
constexpr std::size_t kMaxVariables = 1'000'000;

base::XmlRules rules() {
  constexpr std::size_t kMaxBytes = std::size_t{64} << 20U;
  base::XmlRules rules;
  rules.name = "modelDescription.xml";
  rules.form = "<fmiModelDescription> with <CoSimulation> and <ModelVariables>";
  rules.purpose = "description of an FMU";
  rules.max_bytes = kMaxBytes;
  rules.max_depth = 64;
  rules.max_attributes = 64;
  rules.tolerant = true;
  return rules;
}

const Element* child_of(const Element& element, std::string_view name) {
  const auto found = std::find_if(element.children.begin(), element.children.end(),
                                  [name](const Element& child) { return child.name == name; });
  return found == element.children.end() ? nullptr : &*found;
}

const std::string* attribute_of(const Element& element, std::string_view name) {
  const auto found = std::find_if(element.attributes.begin(), element.attributes.end(),
                                  [name](const base::Attribute& one) { return one.name == name; });
  return found == element.attributes.end() ? nullptr : &found->value;
}

std::string text_of(const Element& element, std::string_view name) {
  const std::string* const text = attribute_of(element, name);
  return text == nullptr ? std::string() : *text;
}

bool is_true(const Element& element, std::string_view name) {
  const std::string text = text_of(element, name);
  return text == "true" || text == "1";
}

template <class T>
std::optional<T> number_of(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && !text.empty() ? std::optional(value)
                                                                                   : std::nullopt;
}

std::optional<Type> type_of(std::string_view element) {
  constexpr std::array<std::pair<std::string_view, Type>, 2> kOfFmi2{
      {{"Real", Type::Float64}, {"Integer", Type::Int32}}};
  for (const auto& [name, type] : kOfFmi2) {
    if (name == element) {
      return type;
    }
  }
  for (auto i = static_cast<int>(Type::Float32); i <= static_cast<int>(Type::Clock); ++i) {
    if (element == name_of(static_cast<Type>(i))) {
      return static_cast<Type>(i);
    }
  }
  return std::nullopt;
}

class DescriptionReader {
 public:
  DescriptionReader(const Element& root, base::Diagnostics& report) : root_(root), report_(report) {}

  Description read() {
    if (!read_version() || !read_kind()) {
      return std::move(description_);
    }
    description_.model = text_of(root_, "modelName");
    description_.token = need(root_, is_fmi2() ? "guid" : "instantiationToken");
    if (const Element* const types = child_of(root_, "TypeDefinitions")) {
      for (const Element& type : types->children) {
        const bool is_nested = is_fmi2() && !type.children.empty();
        types_.emplace(text_of(type, "name"), is_nested ? &type.children.front() : &type);
      }
    }
    if (const Element* const categories = child_of(root_, "LogCategories")) {
      for (const Element& category : categories->children) {
        description_.log_categories.push_back(text_of(category, "name"));
      }
    }
    read_variables();
    return std::move(description_);
  }

 private:
  [[nodiscard]] bool is_fmi2() const { return description_.version == Version::Fmi2; }

  std::string need(const Element& element, const char* name) {
    const std::string* const text = attribute_of(element, name);
    if (text == nullptr || text->empty()) {
      report_.error(element.place,
                    fmt::format("<{}> has no {}; the FMU is damaged, export it again", element.name, name));
      return {};
    }
    return *text;
  }

  bool read_version() {
    if (root_.name != "fmiModelDescription") {
      report_.error(root_.place,
                    fmt::format("the root element is <{}>, not <fmiModelDescription>: this is no FMU", root_.name));
      return false;
    }
    const std::string version = need(root_, "fmiVersion");
    if (version.starts_with("2.") || version == "2") {
      description_.version = Version::Fmi2;
    } else if (version.starts_with("3.")) {
      description_.version = Version::Fmi3;
    } else if (!version.empty()) {
      report_.error(root_.place,
                    fmt::format("the FMU is of FMI {}; export it with FMI 2.0 or 3.0", base::shortened(version, 20)));
    }
    return !report_.failed();
  }

  // The kind of FMU that runs in steps.
  bool read_kind() {
    const Element* const kind = child_of(root_, "CoSimulation");
    if (kind == nullptr) {
      report_.error(root_.place, fmt::format("the FMU is for {} only; export it for co-simulation, with its own solver",
                                             child_of(root_, "ScheduledExecution") != nullptr ? "scheduled execution"
                                                                                              : "model exchange"));
      return false;
    }
    description_.identifier = need(*kind, "modelIdentifier");
    if (description_.identifier.find('/') != std::string::npos) {
      report_.error(kind->place, "modelIdentifier is the name of a library, without folders; export the FMU again");
    }
    description_.any_step = is_true(*kind, "canHandleVariableCommunicationStepSize");
    return true;
  }

  void read_variables() {
    const Element* const all = child_of(root_, "ModelVariables");
    if (all == nullptr) {
      report_.error(root_.place, "there is no <ModelVariables>; the FMU is damaged, export it again");
      return;
    }
    if (all->children.size() > kMaxVariables) {
      report_.error(all->place, fmt::format("{} variables; at most {} are possible: export fewer", all->children.size(),
                                            kMaxVariables));
      return;
    }
    for (const Element& element : all->children) {
      read_variable(element);
    }
    read_dims();
  }

  void read_variable(const Element& element) {
    const Element* typed = &element;
    if (is_fmi2()) {
      const auto found = std::find_if(element.children.begin(), element.children.end(),
                                      [](const Element& child) { return type_of(child.name).has_value(); });
      if (element.name != "ScalarVariable" || found == element.children.end()) {
        report_.error(element.place, fmt::format("<{}> is no variable of FMI 2.0; export the FMU again", element.name));
        return;
      }
      typed = &*found;
    }
    const auto type = type_of(typed->name);
    if (!type) {
      report_.error(element.place, fmt::format("<{}> is no type of FMI 3.0; export the FMU again", element.name));
      return;
    }
    Variable variable;
    variable.type = *type;
    variable.place = element.place;
    variable.name = need(element, "name");
    variable.description = text_of(element, "description");
    const std::string reference = need(element, "valueReference");
    const auto number = number_of<std::uint32_t>(reference);
    if (!number && !reference.empty()) {
      report_.error(element.place, fmt::format("valueReference: {} is no 32-bit number; export the FMU again",
                                               base::in_quotes(base::shortened(reference, 30))));
    }
    variable.reference = number.value_or(0);
    read_kind_of(variable, element);
    read_values_of(variable, *typed);
    for (const Element& alias : element.children) {
      if (alias.name == "Alias") {
        Variable other = variable;
        other.name = text_of(alias, "name");
        aliases_.emplace_back(std::move(other), description_.variables.size());
      }
    }
    add(std::move(variable), element);
  }

  void add(Variable variable, const Element& element) {
    const auto [same, is_new] = description_.by_name.try_emplace(variable.name, description_.variables.size());
    if (!is_new && !variable.name.empty()) {
      report_.error(variable.place, fmt::format("a second variable {}; names are unique: export the FMU again",
                                                base::in_quotes(base::shortened(variable.name, 60))));
      return;
    }
    elements_.push_back(&element);
    description_.variables.push_back(std::move(variable));
  }

  void read_kind_of(Variable& variable, const Element& element) {
    constexpr std::array kVariabilities{"constant", "fixed", "tunable", "discrete", "continuous"};
    const std::string causality = text_of(element, "causality");
    bool known = causality.empty();
    for (auto i = static_cast<int>(Causality::Input); i <= static_cast<int>(Causality::Independent); ++i) {
      if (causality == name_of(static_cast<Causality>(i))) {
        variable.causality = static_cast<Causality>(i);
        known = true;
      }
    }
    if (!known) {
      report_.error(element.place, fmt::format("causality: {} is not known; export the FMU again",
                                               base::in_quotes(base::shortened(causality, 30))));
    }
    const std::string variability = text_of(element, "variability");
    const auto* const word = std::find(kVariabilities.begin(), kVariabilities.end(), variability);
    const bool is_real = variable.type == Type::Float64 || variable.type == Type::Float32;
    variable.variability = word != kVariabilities.end() ? static_cast<Variability>(word - kVariabilities.begin())
                           : is_real                    ? Variability::Continuous
                                                        : Variability::Discrete;
    const std::string initial = text_of(element, "initial");
    variable.has_settable_start = initial == "exact" || initial == "approx";
  }

  // What a variable does not say, its declared type may.
  void read_values_of(Variable& variable, const Element& typed) {
    const auto declared = types_.find(text_of(typed, "declaredType"));
    const Element* const type = declared == types_.end() ? nullptr : declared->second;
    const auto text = [&](const char* name) {
      const std::string* const own = attribute_of(typed, name);
      return own != nullptr ? *own : type != nullptr ? text_of(*type, name) : std::string();
    };
    variable.unit = text("unit");
    variable.min = number_of<double>(text("min"));
    variable.max = number_of<double>(text("max"));
    if (type != nullptr && variable.type == Type::Enumeration) {
      for (const Element& item : type->children) {
        const auto value = number_of<std::int64_t>(text_of(item, "value"));
        if (item.name == "Item" && value) {
          variable.items.push_back({text_of(item, "name"), *value});
        }
      }
    }
    if (const std::string* const start = attribute_of(typed, "start")) {
      if (variable.type == Type::String || is_fmi2()) {
        variable.start.push_back(*start);
      } else {
        std::istringstream words(*start);
        for (std::string word; words >> word;) {
          variable.start.push_back(std::move(word));
        }
      }
    }
    for (const Element& child : typed.children) {
      if (child.name == "Start") {
        variable.start.push_back(text_of(child, "value"));
      }
    }
  }

  // After all variables: a dimension may be a structural parameter, which keeps its start value.
  void read_dims() {
    std::map<std::uint32_t, const Variable*> sizes;
    for (const Variable& variable : description_.variables) {
      if (variable.causality == Causality::StructuralParameter) {
        sizes.emplace(variable.reference, &variable);
      }
    }
    for (std::size_t i = 0; i < description_.variables.size() && !is_fmi2(); ++i) {
      read_dims_of(description_.variables[i], *elements_[i], sizes);
    }
    for (auto& [alias, index] : aliases_) {
      alias.dims = description_.variables[index].dims;
      add(std::move(alias), *elements_[index]);
    }
  }

  void read_dims_of(Variable& variable, const Element& element, const std::map<std::uint32_t, const Variable*>& sizes) {
    std::uint64_t total = 1;
    for (const Element& child : element.children) {
      if (child.name != "Dimension") {
        continue;
      }
      const auto size = dim_of(child, sizes);
      total = size && *size <= kMaxElements ? total * *size : kMaxElements + 1;
      if (total > kMaxElements) {
        report_.error(child.place, fmt::format("the dimension of {} is no size of at most {} elements together",
                                               base::in_quotes(base::shortened(variable.name, 60)), kMaxElements));
        return;
      }
      variable.dims.push_back(*size);
    }
  }

  static std::optional<std::uint64_t> dim_of(const Element& dimension,
                                             const std::map<std::uint32_t, const Variable*>& sizes) {
    if (const std::string* const start = attribute_of(dimension, "start")) {
      return number_of<std::uint64_t>(*start);
    }
    const auto reference = number_of<std::uint32_t>(text_of(dimension, "valueReference"));
    const auto size = reference ? sizes.find(*reference) : sizes.end();
    return size == sizes.end() || size->second->start.empty() ? std::nullopt
                                                              : number_of<std::uint64_t>(size->second->start.front());
  }

  const Element& root_;
  base::Diagnostics& report_;
  Description description_;
  std::map<std::string, const Element*> types_;
  std::vector<const Element*> elements_;                   // of the variables
  std::vector<std::pair<Variable, std::size_t>> aliases_;  // with the index of their variable
};

}  // namespace

ReadDescription read_description(std::string_view xml, const std::string& file) {
  ReadDescription result;
  std::vector<base::XmlMistake> mistakes;
  const auto root = base::read_xml(xml, rules(), mistakes);
  base::Diagnostics report(file, result.diagnostics);
  for (base::XmlMistake& mistake : mistakes) {
    report.error(mistake.place, std::move(mistake.text));
  }
  if (root) {
    result.description = DescriptionReader(*root, report).read();
  }
  report.add_summary(result.diagnostics);
  base::sort_by_place(result.diagnostics);
  return result;
}

}  // namespace indurop::io::fmu
