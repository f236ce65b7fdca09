// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/metrics/board_metrics.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "core/schema/leaf.h"
#include "tools/client/node/mirror_view.h"
#include "tools/client/node/run_report.h"
#include "tools/serve/boards/variable.h"
#include "tools/serve/metrics/io_devices.h"

namespace indurop::serve {
namespace {

using Labels = Exposition::Labels;

constexpr auto kUnordered = std::memory_order_relaxed;

std::uint64_t one_if(bool condition) {
  return condition ? 1 : 0;
}

void add_module(Exposition& out, const std::string& board, const scheduler::ModuleRecord& module) {
  const Labels labels{{"board", board}, {"module", tools::fixed_text(module.name)}};
  out.add(Metric::ModuleRunning, labels, one_if(module.state.load(kUnordered) == scheduler::ModuleState::Running));
  if (module.period_ns > 0) {
    out.add(Metric::ModulePeriod, labels, in_seconds(module.period_ns));
  }
  out.add(Metric::ModuleRuns, labels, module.runs.load(kUnordered));
  out.add(Metric::ModuleSkipped, labels, module.skipped.load(kUnordered));
  out.add(Metric::ModuleOverruns, labels, module.overruns.load(kUnordered));
  out.add(Metric::ModuleMisses, labels, module.deadline_misses.load(kUnordered));
  out.add(Metric::ModuleFaults, labels, module.faults.load(kUnordered));
  out.add(Metric::ModuleRestarts, labels, module.restarts.load(kUnordered));
  out.add(Metric::ModuleExecution, labels, module.exec);
  out.add(Metric::ModuleJitter, labels, module.jitter);
}

void add_run(Exposition& out, const std::string& board, const tools::RunView& run) {
  const Labels labels{{"board", board}};
  const auto& block = run.block();
  const tools::NodeReport report = tools::report_of(board, run);
  out.add(Metric::Ticks, labels, report.ticks);
  out.add(Metric::LostTicks, labels, report.lost_ticks);
  out.add(Metric::BasicPeriod, labels, in_seconds(report.basic_period_ns));
  out.add(Metric::Lateness, labels, block.tick_lateness);
  if (report.lateness.count > 0) {
    out.add(Metric::LatenessMax, labels, in_seconds(report.lateness.max));
  }
  out.add(Metric::Overruns, labels, report.overruns);
  out.add(Metric::Faults, labels, report.faults);
  for (std::uint32_t i = 0; i < run.module_count(); ++i) {
    add_module(out, board, run.module(i));
  }
}

void add_reported(Exposition& out, const Board& board) {
  const base::Json report = board.reported();
  const auto add = [&](Metric metric, const char* what) {
    if (const auto number = report[what].natural()) {
      out.add(metric, {{"board", board.name()}}, *number);
    }
  };
  add(Metric::LostTicks, "lost_ticks");
  add(Metric::Overruns, "overruns");
  add(Metric::Faults, "faults");
}

void add_peers(Exposition& out, const std::string& board) {
  const auto mirror = tools::view_mirror(board);
  for (const tools::PeerView& peer : mirror ? mirror->peers : std::vector<tools::PeerView>()) {
    const Labels labels{{"board", board}, {"peer", peer.name}};
    out.add(Metric::PeerUp, labels, one_if(peer.state == "alive"));
    if (peer.heard_ns >= 0) {
      out.add(Metric::PeerAge, labels, in_seconds(peer.heard_ns));
    }
    out.add(Metric::PeerLost, labels, peer.lost_updates);
  }
}

// Returns the number that a variable or a part of it has; nothing if it is no number.
std::optional<double> number_of(const vars::Store& store, const tools::Item& item) {
  if (!item.place.type.dims.empty()) {
    return std::nullopt;
  }
  const auto bytes = operate::read(store, item);
  return bytes ? schema::as_number<double>(item.place.type.base, bytes->data()) : std::nullopt;
}

using Values = std::map<std::string, double>;  // by the name of the variable or part

// Adds the numbers and bools of a value, up to kMostMetricValues in all.
void add_numbers(Values& values, const std::string& name, const schema::Type& type,
                 std::span<const std::uint8_t> bytes) {
  if (values.size() >= kMostMetricValues) {
    return;
  }
  if (!type.dims.empty()) {
    schema::Type element = type;
    element.dims.erase(element.dims.begin());
    for (std::uint32_t i = 0; i < type.dims.front(); ++i) {
      add_numbers(values, fmt::format("{}[{}]", name, i), element, bytes.subspan(i * element.size(), element.size()));
    }
    return;
  }
  for (const schema::Field& field : type.fields) {
    add_numbers(values, fmt::format("{}.{}", name, field.name), field.type,
                bytes.subspan(field.offset, field.type.size()));
  }
  if (const auto number = schema::as_number<double>(type.base, bytes.data())) {
    values.emplace(name, *number);
  }
}

void add_variables(Exposition& out, const Board& board, const std::vector<std::string>& selected) {
  const vars::Store& store = *board.store();
  std::array<std::uint64_t, 3> counts{};
  std::vector<std::string> ignored;
  for (const tools::Item& item : items_named(store, board.name(), {"*"}, ignored)) {
    ++counts.at(static_cast<std::size_t>(quality_of(store, item)));
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    out.add(Metric::Variables, {{"board", board.name()}, {"quality", word_of(static_cast<Quality>(i))}}, counts.at(i));
  }
  out.add(Metric::ForcedValues, {{"board", board.name()}}, std::uint64_t{store.forces().size()});
  Values values;  // a variable that several patterns match is shown once
  for (const std::string& pattern : selected) {
    for (const tools::Item& item : items_named(store, board.name(), {pattern}, ignored)) {
      if (const auto bytes = operate::read(store, item)) {
        add_numbers(values, item.name, item.place.type, *bytes);
      }
    }
  }
  for (const auto& [name, value] : values) {
    out.add(Metric::VariableValue, {{"board", board.name()}, {"variable", name}}, value);
  }
}

void add_devices(Exposition& out, const Board& board, const tools::RunView& run) {
  for (const IoDeviceName& device : io_devices_of(board.name(), run)) {
    const auto item = operate::find(*board.store(), device.quality);
    const auto number = item ? number_of(*board.store(), *item) : std::nullopt;
    if (number) {
      out.add(Metric::DeviceQuality, {{"board", board.name()}, {"device", device.name}}, *number);
    }
  }
}

}  // namespace

void add_board(Exposition& out, const Board& board, const alarms::AlarmCounts& alarms,
               const std::vector<std::string>& selected) {
  const std::string& name = board.name();
  out.add(Metric::BoardUp, {{"board", name}}, one_if(board.alive()));
  const auto add_alarms = [&](const char* state, std::size_t count) {
    out.add(Metric::Alarms, {{"board", name}, {"state", state}}, std::uint64_t{count});
  };
  add_alarms("active", alarms.active);
  add_alarms("unacknowledged", alarms.unacknowledged);
  add_alarms("shelved", alarms.shelved);
  if (!board.alive()) {
    return;
  }
  add_variables(out, board, selected);
  if (board.remote() != nullptr) {
    add_reported(out, board);
    return;
  }
  add_peers(out, name);
  if (const auto run = board.run()) {
    add_run(out, name, *run);
    add_devices(out, board, *run);
  }
}

}  // namespace indurop::serve
