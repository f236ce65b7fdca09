// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/shadow/shadow_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/text.h"
#include "tools/client/text/units.h"
#include "tools/console/diagnostics.h"
#include "tools/console/table_text.h"

namespace indurop::tools {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();
constexpr std::size_t kShownValue = 24;
constexpr std::size_t kMostNames = 10;

ShadowVariable variable_of(const JsonValue& json) {
  ShadowVariable variable;
  base::read(json, "name", variable.name);
  base::read(json, "compared", variable.compared);
  base::read(json, "differing", variable.differing);
  base::read(json, "unclear", variable.unclear);
  base::read(json, "first_tick", variable.first_tick);
  base::read(json, "first_part", variable.first_part);
  base::read(json, "first_was", variable.first_was);
  base::read(json, "first_is", variable.first_is);
  base::read(json, "largest_part", variable.largest_part);
  variable.largest = variable.compared + variable.unclear > 0 ? json["largest"].number().value_or(kUnknown) : kUnknown;
  return variable;
}

ShadowTimes times_of(const JsonValue& json) {
  ShadowTimes times;
  base::read(json, "median_ns", times.median_ns);
  base::read(json, "p99_ns", times.p99_ns);
  base::read(json, "max_ns", times.max_ns);
  return times;
}

std::string shown_largest(const ShadowVariable& variable) {
  return std::isfinite(variable.largest) ? fmt::format("{:.6g}", variable.largest) : "?";
}

Table differences(const ShadowReport& report) {
  Table table({{"VARIABLE", "name"},
               {"RUNS", "compared", Align::Right},
               {"DIFFER", "differing", Align::Right},
               {"UNCLEAR", "unclear", Align::Right, 1},
               {"FIRST TICK", "first_tick", Align::Right},
               {"WAS", "first_was", Align::Right, 2},
               {"IS", "first_is", Align::Right, 2},
               {"LARGEST", "largest", Align::Right}});
  for (const ShadowVariable& one : report.variables) {
    if (!one.is_equal()) {
      const auto number = [](std::uint64_t n) { return Cell(n > 0 ? std::to_string(n) : "", JsonValue(n)); };
      const std::string first = one.differing > 0 ? std::to_string(one.first_tick) : "";
      table.add({Cell(one.differing > 0 ? one.first_part : one.name),
                 Cell(std::to_string(one.compared), JsonValue(one.compared)), number(one.differing),
                 number(one.unclear), Cell(first), Cell(base::shortened(one.first_was, kShownValue)),
                 Cell(base::shortened(one.first_is, kShownValue)), Cell(shown_largest(one))});
    }
  }
  return table;
}

std::string times_text(const ShadowTimes& times) {
  return fmt::format("{} (99 %: {}, at most {})", human_ns(times.median_ns), human_ns(times.p99_ns),
                     human_ns(times.max_ns));
}

std::string text_of(const ShadowVariable& variable) {
  if (variable.compared + variable.unclear == 0) {
    return variable.name + " was not compared";
  }
  const std::uint64_t differing = variable.differing + variable.unclear;
  return fmt::format("{} differs in {} by {} at most", variable.name, counted(differing, "run"),
                     std::isfinite(variable.largest) ? fmt::format("{:.6g}", variable.largest) : "what is no number");
}

}  // namespace

std::optional<ShadowReport> read_shadow_report(const std::string& text) {
  const auto json = JsonValue::parse(text);
  ShadowReport report;
  if (!json || !base::read(*json, "module", report.module) || !base::read(*json, "runs", report.runs)) {
    return std::nullopt;
  }
  base::read(*json, "first_tick", report.first_tick);
  base::read(*json, "last_tick", report.last_tick);
  base::read(*json, "disturbed_runs", report.disturbed_runs);
  base::read(*json, "initial_values", report.initial_values);
  base::read(*json, "fault", report.fault);
  base::read(*json, "fault_tick", report.fault_tick);
  base::read(*json, "only_recorded_fault", report.only_recorded_fault);
  report.now = times_of((*json)["now"]);
  report.then = times_of((*json)["then"]);
  for (const JsonValue& one : (*json)["variables"].values()) {
    report.variables.push_back(variable_of(one));
  }
  std::vector<std::string> not_written;
  base::read(*json, "not_written", not_written);
  for (const std::string& name : not_written) {
    ShadowVariable variable;
    variable.name = name;
    variable.largest = kUnknown;
    report.variables.push_back(std::move(variable));
  }
  base::read(*json, "new", report.added);
  base::read(*json, "converted", report.converted);
  report.json = *json;
  return report;
}

std::optional<std::string> objection(const ShadowReport& report, const AcceptedDifferences& accepted, bool lossy) {
  if (!report.fault.empty()) {
    return fmt::format("with the inputs of tick {} it faults: {}", report.fault_tick, printable(report.fault));
  }
  if (report.only_recorded_fault) {
    return "the version that runs faulted meanwhile";
  }
  if (!report.initial_values.empty() && !lossy) {
    return fmt::format(
        "what the running version keeps is not known ({}), so it was compared from initial values on; "
        "to exchange it so: --lossy",
        printable(report.initial_values));
  }
  std::vector<std::string> names;
  std::vector<std::string> texts;
  for (const ShadowVariable& variable : report.variables) {
    names.push_back(variable.name);
    if (!variable.is_equal() && !accepted.accept(variable.name, variable.largest)) {
      texts.push_back(text_of(variable));
    }
  }
  names.insert(names.end(), report.added.begin(), report.added.end());  // a rule for them is met
  if (const auto unmatched = accepted.unmatched(names); !unmatched.empty()) {
    return fmt::format("--accept: '{}' is for no variable that it writes", unmatched.front());
  }
  if (!texts.empty()) {
    return base::enumerate(texts, 3) + "; to exchange it nevertheless: --accept \"NAME <= LIMIT\"";
  }
  return std::nullopt;
}

void print_shadow(Context& context, const ShadowReport& report) {
  const Table table = differences(report);
  context.out.write(table_text(table, context.out));
  context.out.line(fmt::format("{}  {} of ticks {} to {}, {}{}", table.empty() ? "" : "\n", counted(report.runs, "run"),
                               report.first_tick, report.last_tick, counted(report.variables.size(), "variable"),
                               table.empty() ? ": equal" : ""));
  if (!report.added.empty()) {
    context.out.line(
        fmt::format("  {} new in the shadow and began with initial values; nothing is compared with {}",
                    base::enumerate(report.added, kMostNames) + (report.added.size() == 1 ? " is" : " are"),
                    report.added.size() == 1 ? "it" : "them"));
  }
  if (!report.converted.empty()) {
    context.out.line(
        fmt::format("  compared as the types that the node has: {}", base::enumerate(report.converted, kMostNames)));
  }
  if (report.disturbed_runs > 0) {
    context.out.line(fmt::format("  the inputs of {} changed while they ran", counted(report.disturbed_runs, "run")));
  }
  context.out.line(
      fmt::format("  a run takes {} here, and took {} in the node", times_text(report.now), times_text(report.then)));
}

}  // namespace indurop::tools
