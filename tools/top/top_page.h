// SPDX-License-Identifier: Apache-2.0
// What `indurop top` shows, as lines: nodes, modules by load, what happened last. Knows no terminal.

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "alarms/alarm_book.h"
#include "tools/command/output.h"
#include "tools/values/force_view.h"
#include "tools/values/mirror_view.h"
#include "tools/values/run_report.h"
#include "tools/values/run_view.h"

namespace indurop::tools {

struct TopLine {
  std::string text;
  Style style = Style::None;
  bool reversed = false;
};

enum class TopOrder { Load, Name, Overruns, Jitter };
TopOrder next_order(TopOrder order) noexcept;
const char* name_of(TopOrder order) noexcept;

struct TopEvent {
  std::int64_t time_ns = 0;  // of the node
  std::string text;
};

// What was seen of a node at one time.
struct TopSample {
  NodeReport report;
  struct Module {
    std::string name;
    std::string state;
    bool well = true;
    std::uint64_t runs = 0;
    std::uint64_t overruns = 0;
    std::int64_t exec_sum_ns = 0;
    std::int64_t mean_ns = 0;
    std::int64_t max_ns = 0;
    std::int64_t jitter_p99_ns = 0;
    std::string fault;
    double load = 0;  // share of a core since the sample before; of the first one: by the mean
  };
  std::vector<Module> modules;
  std::vector<TopEvent> events;  // overruns, orders, what modules printed, newest last
  std::vector<std::string> troubles;
  alarms::AlarmCounts alarms;
  std::size_t forces = 0;
  std::size_t stale = 0;  // variables of other boards that are not valid
  std::int64_t at_ns = 0;
};

// `before` may be empty: no sample of this run.
TopSample take_sample(const std::string& node, const RunView& run, const TopSample* before);

struct TopLook {
  std::vector<std::string> nodes;  // all that run
  TopOrder order = TopOrder::Load;
  std::size_t first = 0;  // module
  bool paused = false;
};

// As many lines as `rows`, each at most `columns` wide; the last one says the keys.
std::vector<TopLine> top_page(const TopSample& sample, const TopLook& look, int columns, int rows);
// That no node runs.
std::vector<TopLine> top_nothing(const std::string& why, int columns, int rows);

}  // namespace indurop::tools
