// SPDX-License-Identifier: Apache-2.0
#include "control/plc/plcopen/instances.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "control/plc/plcopen/body_reader.h"
#include "control/plc/plcopen/declarations.h"
#include "control/plc/plcopen/outside.h"
#include "control/plc/st/parser.h"

namespace indurop::plc::plcopen {
namespace {

// Returns the seconds of a unit of an XML duration, before or after its T; 0 if there is no such unit.
double seconds_of(char unit, bool of_day) {
  if (!of_day) {
    return unit == 'D' ? 86400 : 0;
  }
  if (unit == 'H') {
    return 3600;
  }
  if (unit == 'M') {
    return 60;
  }
  return unit == 'S' ? 1 : 0;
}

std::optional<std::int64_t> iso_ns(std::string_view text) {
  constexpr double kSecond = 1e9;
  constexpr double kMaxNanoseconds = 9e18;
  if (!text.starts_with('P') || text.size() < 3) {
    return std::nullopt;
  }
  text.remove_prefix(1);
  bool of_day = false;  // after the T
  double total = 0;
  while (!text.empty()) {
    if (text.front() == 'T' && !of_day) {
      of_day = true;
      text.remove_prefix(1);
      continue;
    }
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (error != std::errc{} || text.empty()) {
      return std::nullopt;
    }
    const char unit = text.front();
    text.remove_prefix(1);
    const double seconds = seconds_of(unit, of_day);
    if (seconds == 0 || number < 0) {
      return std::nullopt;
    }
    total += number * seconds * kSecond;
  }
  return total < kMaxNanoseconds ? std::optional(std::llround(total)) : std::nullopt;
}

std::optional<std::int64_t> literal_ns(std::string_view text) {
  Diagnostics quiet;
  const auto literal = st::parse_expression({text, {}}, quiet);
  if (!literal || literal->kind != ast::Expression::Kind::Literal || literal->value_type != Elementary::Time) {
    return std::nullopt;
  }
  const auto* ns = std::get_if<std::int64_t>(&literal->value);
  return ns == nullptr ? std::nullopt : std::optional(*ns);
}

// Reads "00:00:00.020000", as older versions of Beremiz wrote it: hours, minutes, seconds.
std::optional<std::int64_t> clock_ns(std::string_view text) {
  std::array<double, 3> parts{};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), parts[i]);
    const char behind = end == text.data() + text.size() ? '\0' : *end;
    if (error != std::errc{} || parts[i] < 0 || behind != (i < 2 ? ':' : '\0')) {
      return std::nullopt;
    }
    text.remove_prefix(static_cast<std::size_t>(end - text.data()) + (i < 2 ? 1 : 0));
  }
  constexpr double kMaxSeconds = 9e9;
  const double seconds = (parts[0] * 60 + parts[1]) * 60 + parts[2];
  return seconds < kMaxSeconds ? std::optional(std::llround(seconds * 1e9)) : std::nullopt;
}

class InstanceReader {
 public:
  InstanceReader(Project& project, Diagnostics& diagnostics) : project_(project), diagnostics_(diagnostics) {}

  Configuration configuration(const Node& node) {
    Configuration made;
    made.name = std::string(node.attribute("name"));
    made.at = within(node.at, "configuration " + made.name);
    for (const Node& child : node.children) {
      if (child.name == "resource") {
        made.resources.push_back(resource(child));
      } else if (child.name == "globalVars") {
        read_variables(child, ast::Section::Global, "configuration " + made.name, made.globals, diagnostics_);
      } else if (child.name == "accessVars") {
        read_accesses(child, "", "configuration " + made.name, project_.accesses, diagnostics_);
      } else if (child.name == "configVars") {
        read_configured(child, "configuration " + made.name, project_.configured, diagnostics_);
      }
    }
    return made;
  }

  Configuration application(const Node& node) {
    Configuration made;
    made.name = std::string(node.attribute("name"));
    made.at = within(node.at, "application " + made.name);
    made.resources.push_back(resource(node));
    return made;
  }

 private:
  Resource resource(const Node& node) {
    Resource made;
    made.name = std::string(node.attribute("name"));
    made.at = within(node.at, "resource " + made.name);
    for (const Node& child : node.children) {
      if (child.name == "task") {
        task(child, made);
      } else if (child.name == "globalVars") {
        read_variables(child, ast::Section::Global, "resource " + made.name, made.globals, diagnostics_);
      } else if (child.name == "pouInstance") {
        instance(child, "", made);
      }
    }
    return made;
  }

  // Returns the interval; TwinCAT writes interval="PT0S" and the actual value into an extension.
  static std::string interval_text(const Node& task) {
    const std::string standard(task.attribute("interval"));
    if (!standard.empty() && interval_ns(standard) != 0) {
      return standard;
    }
    for (const Node& data : children_of(task.child("addData"))) {
      const Node* settings = data.child("TaskSettings");
      if (settings != nullptr && !settings->attribute("Interval").empty()) {
        const std::string_view interval = settings->attribute("Interval");
        const bool number = interval.front() >= '0' && interval.front() <= '9';
        return number ? fmt::format("T#{}{}", interval, settings->attribute("IntervalUnit")) : std::string(interval);
      }
    }
    return standard;
  }

  void task(const Node& node, Resource& resource) {
    Task& made = resource.tasks.emplace_back();
    made.name = std::string(node.attribute("name"));
    made.at = within(node.at, "task " + made.name);
    made.single = std::string(node.attribute("single"));
    const std::string interval = interval_text(node);
    if (!interval.empty()) {
      made.interval_ns = interval_ns(interval);
      if (!made.interval_ns || *made.interval_ns <= 0) {
        diagnostics_.error(made.at, fmt::format("interval=\"{}\" is not a time; write T#10ms or PT0.01S", interval));
        made.interval_ns.reset();
      }
    }
    const std::string_view priority = node.attribute("priority");
    std::int32_t number = 0;
    const auto [end, error] = std::from_chars(priority.data(), priority.data() + priority.size(), number);
    if (!priority.empty() && error == std::errc{} && end == priority.data() + priority.size()) {
      made.priority = number;
    } else if (!priority.empty()) {
      diagnostics_.error(made.at, fmt::format("priority=\"{}\" is not a number", priority));
    }
    const std::string name = made.name;
    for (const Node& child : node.children) {
      if (child.name == "pouInstance") {
        instance(child, name, resource);
      }
    }
  }

  void instance(const Node& node, const std::string& task, Resource& resource) {
    ProgramInstance made;
    made.name = std::string(node.attribute("name"));
    made.at = within(node.at, "program " + made.name);
    made.task = task;
    // Some editors write only the type, in either attribute.
    made.type = std::string(node.attribute("typeName").empty() ? node.attribute("type") : node.attribute("typeName"));
    if (made.type.empty()) {
      made.type = made.name;
    } else if (made.name.empty()) {
      made.name = made.type;
    }
    if (made.type.find('.') != std::string::npos) {
      diagnostics_.warning(made.at, "this is a program of a library, which is not in the file; it is left out");
      return;
    }
    if (made.type.empty()) {
      diagnostics_.error(made.at, "a <pouInstance> has a name and, in typeName, the program it runs");
      return;
    }
    resource.programs.push_back(std::move(made));
  }

  Project& project_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::optional<std::int64_t> interval_ns(std::string_view text) {
  if (const auto clock = clock_ns(text)) {
    return clock;
  }
  return text.starts_with('P') ? iso_ns(text) : literal_ns(text);
}

void read_application(const Node& resource, Project& into, Diagnostics& diagnostics) {
  into.configurations.push_back(InstanceReader(into, diagnostics).application(resource));
}

void read_instances(const Node& instances, Project& into, Diagnostics& diagnostics) {
  const Node* list = instances.child("configurations");
  for (const Node& node : children_of(list)) {
    if (node.name == "configuration") {
      into.configurations.push_back(InstanceReader(into, diagnostics).configuration(node));
    }
  }
}

}  // namespace indurop::plc::plcopen
