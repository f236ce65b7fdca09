// SPDX-License-Identifier: Apache-2.0
// The lines that `indurop top` shows: nodes, modules by load, latest events. Independent of the terminal.

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "history/alarms/alarm_book.h"
#include "tools/client/node/mirror_view.h"
#include "tools/client/node/run_report.h"
#include "tools/client/node/run_view.h"
#include "tools/client/values/force_view.h"
#include "tools/console/output.h"

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
  std::int64_t time_ns = 0;  // on the node's clock
  std::string text;
};

// A sample of a node's status at one time.
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
    double load = 0;  // share of a core since the previous sample; in the first one the mean
  };
  std::vector<Module> modules;
  std::vector<TopEvent> events;        // overruns, commands, output of modules; newest last
  std::vector<std::string> questions;  // that robots ask their operators
  std::vector<std::string> troubles;
  alarms::AlarmCounts alarms;
  std::size_t forces = 0;
  std::size_t stale = 0;  // number of variables of other boards that are not valid
  std::int64_t at_ns = 0;
};

// `before` may be null: there is no sample of this run yet.
TopSample take_sample(const std::string& node, const RunView& run, const TopSample* before);

struct TopLook {
  std::vector<std::string> nodes;  // all running nodes
  TopOrder order = TopOrder::Load;
  std::size_t first = 0;  // index of the first module shown
  bool paused = false;
};

// Returns `rows` lines, each at most `columns` wide; the last one lists the keys.
std::vector<TopLine> top_page(const TopSample& sample, const TopLook& look, int columns, int rows);
// Returns the page that no node runs.
std::vector<TopLine> top_nothing(const std::string& why, int columns, int rows);

}  // namespace indurop::tools
