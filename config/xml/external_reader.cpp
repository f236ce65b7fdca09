// SPDX-License-Identifier: Apache-2.0
#include "config/xml/external_reader.h"

#include <algorithm>
#include <array>

#include "config/xml/plant_rules.h"
#include "config/xml/values.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

constexpr base::Nanos kLongestEvery{std::chrono::hours(1)};

std::string reliability_problem(const std::string& text) {
  return text == "reliable" || text == "best-effort"
             ? std::string{}
             : base::in_quotes(text) + " is not a value of reliability; write reliable or best-effort";
}

std::string external_problem(const std::string& text, VariableRule::External& external) {
  using External = VariableRule::External;
  constexpr std::array<std::pair<const char*, External>, 3> kWords{
      {{"read", External::Read}, {"write", External::Write}, {"off", External::Off}}};
  const auto* const found = std::find_if(kWords.begin(), kWords.end(), [&](const auto& w) { return text == w.first; });
  if (found == kWords.end()) {
    return base::in_quotes(text) +
           " is not a value of external; write read, write (other tools may also set it) or off (they do not see it)";
  }
  external = found->second;
  return {};
}

}  // namespace

std::string every_problem(const std::string& text, base::Nanos& every) {
  const base::DurationText read = base::read_duration(text, false);
  every = read.value.value_or(base::Nanos::zero());
  return every > kLongestEvery
             ? base::in_quotes(text) + " is too long; write at most " + base::format_duration(kLongestEvery)
             : read.problem;
}

std::optional<int> domain_of(const base::Element& element, const std::string& text, const char* more,
                             base::Diagnostics& report) {
  const auto value = read_integer(text, 0, kHighestDomain);
  if (!value) {
    report.error(element.text_place, "<" + element.name + ">: " + base::in_quotes(text) +
                                         " is not a DDS domain; write a number from 0 to " +
                                         std::to_string(kHighestDomain) + more);
    return std::nullopt;
  }
  return static_cast<int>(*value);
}

std::string optional_attribute(const base::Element& element, const char* name,
                               const std::function<std::string(const std::string&)>& problem,
                               base::Diagnostics& report) {
  const base::Attribute* found = find_attribute(element, name);
  if (found == nullptr) {
    return {};
  }
  const std::string wrong =
      found->value.empty() ? "no value given; remove the attribute or write one" : problem(found->value);
  if (!wrong.empty()) {
    report.error(found->value_place, std::string(name) + ": " + wrong);
    return {};
  }
  return found->value;
}

bool is_on(const base::Element& element, const char* name, base::Diagnostics& report) {
  const auto problem = [name](const std::string& text) {
    return text == "on" || text == "off" ? std::string{}
                                         : base::in_quotes(text) + " is not a value of " + name + "; write on or off";
  };
  return optional_attribute(element, name, problem, report) == "on";
}

void read_type_file(const base::Element& element, const std::filesystem::path& folder, TypeFiles& named,
                    base::Diagnostics& report) {
  const auto text = text_of(element, "./libcell_types.so", report);
  if (!text || !is_file_name(element, *text, report)) {
    return;
  }
  const std::filesystem::path file = (folder / *text).lexically_normal();
  if (std::find(named.types.begin(), named.types.end(), file) != named.types.end()) {
    report.warning(element.text_place, base::in_quotes(*text) + " is named twice; remove one");
    return;
  }
  named.types.push_back(file);
  named.types_as_written.push_back(*text);
  named.type_places.push_back(element.text_place);
}

std::optional<VariableRule> read_rule(const base::Element& element, const std::vector<std::string>& attributes,
                                      FirstPlaces& rules, base::Diagnostics& report) {
  const bool of_plant = std::find(attributes.begin(), attributes.end(), "owner") != attributes.end();
  check_attributes(element, attributes, report);
  if (is_leaf(element, report)) {
    check_no_text(element, report);
  }
  VariableRule rule;
  const base::Attribute* name = need_attribute(element, "name",
                                               of_plant ? R"(<variable name="cell::speed" owner="control"/>)"
                                                        : R"(<variable name="cell::target" external="write"/>)",
                                               report);
  if (const base::Attribute* owner = find_attribute(element, "owner"); owner != nullptr && of_plant) {
    rule.owner = optional_attribute(
        element, "owner", [](const std::string&) { return std::string{}; }, report);
    rule.owner_place = owner->value_place;
  }
  optional_attribute(
      element, "every", [&rule](const std::string& text) { return every_problem(text, rule.every); }, report);
  rule.best_effort =
      of_plant && optional_attribute(element, "reliability", reliability_problem, report) == "best-effort";
  optional_attribute(
      element, "external", [&rule](const std::string& text) { return external_problem(text, rule.external); }, report);
  if (name == nullptr) {
    return std::nullopt;
  }
  rule.name = name->value;
  rule.place = name->value_place;
  if (element.attributes.size() == 1) {
    report.warning(element.place, "<variable> says nothing about " + base::in_quotes(rule.name) + "; give it " +
                                      (of_plant ? "an owner, every, reliability or external" : "every or external") +
                                      ", or remove it");
  }
  const auto [first, is_first] = rules.try_emplace(rule.name, element.place);
  if (!is_first) {
    report.error(element.place, "a second <variable> " + base::in_quotes(rule.name) + ", the first is in line " +
                                    std::to_string(first->second.line) + "; write both in one");
    return std::nullopt;
  }
  return rule;
}

bool ExternalReader::read(const base::Element& element) {
  if (element.name == "types") {
    read_type_file(element, folder_, plane_, report_);
  } else if (element.name == "variable") {
    if (auto rule = read_rule(element, {"name", "every", "external"}, rules_, report_)) {
      plane_.variables.push_back(std::move(*rule));
    }
  } else if (element.name == "external") {
    if (is_first(element, "this <root>", given_, report_)) {
      read_external(element);
    }
  } else {
    return false;
  }
  return true;
}

void ExternalReader::read_external(const base::Element& element) {
  check_attributes(element, {"interface", "ros2"}, report_);
  plane_.ros2 = is_on(element, "ros2", report_);
  plane_.interface_name = optional_attribute(
      element, "interface", [](const std::string& text) { return interface_problem(text); }, report_);
  if (!is_leaf(element, report_)) {
    return;
  }
  if (element.text.empty()) {
    report_.error(element.place, "<external> has no value; write a DDS domain such as <external>0</external>, or off");
  } else if (element.text != "off") {
    plane_.domain = domain_of(element, element.text, ", or off", report_);
  }
}

void ExternalReader::end() {
  const auto external = given_.find("external");
  if (external == given_.end()) {
    plane_.domain = plane_.types.empty() ? std::nullopt : std::optional<int>(0);
  } else if (plane_.domain && plane_.types.empty()) {
    report_.warning(external->second,
                    "<external> shows nothing without <types>; name the lib..._types.so that "
                    "indurop_add_glb(... TYPES) builds");
  }
}

}  // namespace indurop::config
