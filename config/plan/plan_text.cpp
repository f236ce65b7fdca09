// SPDX-License-Identifier: Apache-2.0
// The plan for people: the chapter's Table 3, then every module with its values in normalised form.

#include <fmt/format.h>

#include <algorithm>

#include "config/plan/plan_parts.h"
#include "core/base/text.h"
#include "scheduler/response_time.h"
#include "scheduler/words.h"

namespace indurop::config {
namespace {

// Up to this number of basic periods each has its own line; above it, equal neighbours share one.
constexpr std::uint64_t kFullTable = 64;
constexpr std::size_t kMaxRows = 400;
constexpr const char* kGap = "  ";

enum class Align { Left, Right };

class TextTable {
 public:
  struct Column {
    std::string heading;
    Align align = Align::Left;
  };
  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }

  // Leaves out columns that are empty in every row.
  [[nodiscard]] std::string text() const {
    std::vector<std::size_t> widths;
    std::vector<std::string> heading;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      std::size_t width = 0;
      for (const auto& row : rows_) {
        width = std::max(width, base::characters(row[c]));
      }
      widths.push_back(width == 0 ? 0 : std::max(width, base::characters(columns_[c].heading)));
      heading.push_back(columns_[c].heading);
    }
    std::string all = line(heading, widths);
    for (const auto& row : rows_) {
      all += line(row, widths);
    }
    return all;
  }

 private:
  [[nodiscard]] std::string line(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths) const {
    std::string text;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (widths[c] == 0) {
        continue;
      }
      const std::string padding(widths[c] - std::min(base::characters(cells[c]), widths[c]), ' ');
      text += text.empty() ? "" : kGap;
      text += columns_[c].align == Align::Right ? padding + cells[c] : cells[c] + padding;
    }
    text.erase(text.find_last_not_of(' ') + 1);
    return text + "\n";
  }

  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

std::string schedule(const Config& config, const CheckResult& check) {
  const scheduler::PeriodTable& table = check.table;
  TextTable text({{"No. of basic period", Align::Right},
                  {"Execution time (ms)", Align::Right},
                  {"Execution module (in priority)"},
                  {"Macro period"}});
  const bool ranges = table.slot_count > kFullTable;
  std::size_t rows = 0;
  std::size_t first = 0;
  while (first < table.slots.size() && rows < kMaxRows) {
    std::size_t last = first;
    while (ranges && last + 1 < table.slots.size() && table.slots[last + 1].items == table.slots[first].items) {
      ++last;
    }
    const bool one = last == first;
    const std::string modules = in_order(names_of(config, check, table.slots[first]));
    text.add({one ? std::to_string(first) : std::to_string(first) + "-" + std::to_string(last),
              one ? milliseconds(table.slots[first].time)
                  : milliseconds(table.slots[first].time) + "-" + milliseconds(table.slots[last].time),
              modules.empty() ? "-" : modules,
              rows == 0 ? "Repeat basic periods every " + milliseconds(table.macro_period) + " ms" : ""});
    ++rows;
    first = last + 1;
  }
  std::string all = text.text();
  if (first < table.slot_count) {
    all += "... and " + std::to_string(table.slot_count - first) + " more basic periods";
    all += first < table.slots.size() ? "; JSON and CSV list more\n" : "\n";
  }
  return all;
}

std::string ends_within(const Timing& timing) {
  return !timing.known                                         ? ""
         : timing.worst == scheduler::WorstResponses::kNotDone ? "never"
                                                               : base::format_duration(timing.worst);
}

// Returns "Takes 42.0 % of a core: modules 30.0 %, ticks 12.0 %".
std::string load(const Config& config, const CheckResult& check) {
  if (check.dispatch_share == 0) {
    return {};
  }
  const double modules = utilisation(config);
  return fmt::format("Takes {:.1f} % of a core: modules with known execution times {:.1f} %, ticks {:.1f} %\n",
                     (modules + check.dispatch_share) * 100, modules * 100, check.dispatch_share * 100);
}

std::string modules_table(const Config& config, const CheckResult& check) {
  TextTable text({{"Module"},
                  {"Type"},
                  {"Operation"},
                  {"Period", Align::Right},
                  {"Offset", Align::Right},
                  {"Deadline", Align::Right},
                  {"Priority", Align::Right},
                  {"Core", Align::Right},
                  {"Executes", Align::Right},
                  {"Ends within", Align::Right},
                  {"Slack", Align::Right},
                  {"File"}});
  const auto add = [&](std::size_t index) {
    const Module& m = config.modules[index];
    const auto shown = [](base::Nanos value) {
      return value > base::Nanos::zero() ? base::format_duration(value) : std::string{};
    };
    text.add({m.name, to_text(m.type), to_text(m.operation), shown(m.period), shown(m.offset), shown(m.deadline),
              m.operation == scheduler::Operation::NonReal ? "" : std::to_string(m.priority),
              m.core >= 0 ? std::to_string(m.core) : "", shown(m.wcet), ends_within(check.timings[index]),
              shown(slack_of(m, check.timings[index])), m.file_as_written});
  };
  for (const std::uint32_t item : check.table.order) {
    add(check.periodic[item]);
  }
  std::for_each(check.sporadic.begin(), check.sporadic.end(), add);
  std::for_each(check.non_real.begin(), check.non_real.end(), add);
  return text.text();
}

// Returns the modules that satisfy `wanted`; empty if none does.
template <class Wanted>
std::string list(const Config& config, const std::vector<std::size_t>& modules, const char* separator, Wanted wanted) {
  std::string text;
  for (const std::size_t i : modules) {
    if (wanted(config.modules[i])) {
      text += (text.empty() ? "" : separator) + config.modules[i].name;
    }
  }
  return text;
}

std::string others(const Config& config, const CheckResult& check) {
  const std::string after_base = list(config, check.sporadic, " > ", [](const Module& m) { return m.after_base; });
  const std::string sporadic = list(config, check.sporadic, " > ", [](const Module& m) { return !m.after_base; });
  const std::string non_real = list(config, check.non_real, ", ", [](const Module&) { return true; });
  std::string text;
  text += after_base.empty() ? "" : "Sporadic, right after the modules of every basic period: " + after_base + "\n";
  text += sporadic.empty() ? "" : "Sporadic, after the periodic modules of each basic period: " + sporadic + "\n";
  text += non_real.empty() ? "" : "Non-real-time, in the time left: " + non_real + "\n";
  return text;
}

}  // namespace

std::string plan_table(const Config& config, const CheckResult& check) {
  std::string text;
  if (check.periodic.empty()) {
    text += "No periodic modules.\n";
  } else {
    text += "Basic period " + base::format_duration(check.table.basic_period) + ", macro period " +
            base::format_duration(check.table.macro_period) + ", " + std::to_string(check.table.slot_count) +
            (check.table.slot_count == 1 ? " basic period\n\n" : " basic periods\n\n") + schedule(config, check);
  }
  if (const std::string rest = others(config, check); !rest.empty()) {
    text += "\n" + rest;
  }
  if (const std::string taken = load(config, check); !taken.empty()) {
    text += "\n" + taken;
  }
  return config.modules.empty() ? text : text + "\n" + modules_table(config, check);
}

std::string plan_table(const Plant& plant, const PlantCheck& check) {
  std::string text;
  for (std::size_t i = 0; i < plant.boards.size(); ++i) {
    const std::string heading = "Board " + plant.boards[i].name;
    text += (i == 0 ? "" : "\n\n") + heading + "\n" + std::string(heading.size(), '=') + "\n" +
            plan_table(plant.boards[i].config, check.boards[i]);
  }
  return text;
}

}  // namespace indurop::config
