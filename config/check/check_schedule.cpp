// SPDX-License-Identifier: Apache-2.0
// Checks that the periods make a schedule, and proposes corrections if they do not.

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "config/check/check_parts.h"
#include "core/base/text.h"
#include "scheduler/bands.h"
#include "scheduler/execution_order.h"

namespace indurop::config {
namespace {

using scheduler::Operation;
using scheduler::PeriodicItem;

constexpr std::size_t kMaxBands = 80;

base::Nanos minimum_of(const Config& config) {
  return config.minimum_period.value_or(kDefaultMinimumPeriod);
}

std::vector<std::size_t> modules_of(const Config& config, Operation operation) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < config.modules.size(); ++i) {
    if (config.modules[i].operation == operation) {
      found.push_back(i);
    }
  }
  return found;
}

std::vector<PeriodicItem> items_of(const Config& config, const std::vector<std::size_t>& periodic) {
  std::vector<PeriodicItem> items;
  for (const std::size_t i : periodic) {
    const Module& module = config.modules[i];
    items.push_back({module.period, module.offset, module.priority});
  }
  return items;
}

base::Nanos common_divisor(const std::vector<PeriodicItem>& items, bool with_offsets) {
  std::int64_t divisor = 0;
  for (const PeriodicItem& item : items) {
    divisor = std::gcd(divisor, item.period.count());
    divisor = with_offsets ? std::gcd(divisor, item.offset.count()) : divisor;
  }
  return base::Nanos{divisor};
}

// Returns the periods and offsets nearest to `items` whose common divisor is at least `minimum`.
std::vector<PeriodicItem> nearest_items(std::vector<PeriodicItem> items, base::Nanos minimum) {
  if (common_divisor(items, false) < minimum) {
    std::vector<base::Nanos> periods;
    periods.reserve(items.size());
    for (const PeriodicItem& item : items) {
      periods.push_back(item.period);
    }
    periods = scheduler::adjust_periods(periods, minimum);
    for (std::size_t i = 0; i < items.size(); ++i) {
      items[i].period = periods[i];
    }
  }
  if (common_divisor(items, true) >= minimum &&
      std::all_of(items.begin(), items.end(), [](const PeriodicItem& item) { return item.offset < item.period; })) {
    return items;
  }
  // Offsets are moved to multiples of the finest grid that the periods allow.
  const std::int64_t basic = common_divisor(items, false).count();
  constexpr std::int64_t kTries = 1'000'000;
  std::int64_t parts = std::min(basic / std::max<std::int64_t>(minimum.count(), 1), kTries);
  while (parts > 1 && basic % parts != 0) {
    --parts;
  }
  const std::int64_t grid = std::max<std::int64_t>(basic / std::max<std::int64_t>(parts, 1), 1);
  for (PeriodicItem& item : items) {
    item.offset = item.offset >= item.period ? base::Nanos::zero() : item.offset;
    const std::int64_t rest = item.offset.count() % grid;
    item.offset += base::Nanos{rest < grid - rest ? -rest : grid - rest};
    item.offset = item.offset >= item.period ? base::Nanos::zero() : item.offset;
  }
  return items;
}

// Returns "cntr1: period 130 us -> 150 us" for every module that changes.
std::vector<std::string> changes(const CheckContext& context, const std::vector<PeriodicItem>& from,
                                 const std::vector<PeriodicItem>& to) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const std::string& name = context.config.modules[context.result.periodic[i]].name;
    if (from[i].period != to[i].period) {
      lines.push_back(name + " period " + base::format_duration(from[i].period) + " -> " +
                      base::format_duration(to[i].period));
    }
    if (from[i].offset != to[i].offset) {
      lines.push_back(name + " offset " + base::format_duration(from[i].offset) + " -> " +
                      base::format_duration(to[i].offset));
    }
  }
  return lines;
}

void apply(CheckContext& context, const std::vector<PeriodicItem>& items) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    Module& module = context.config.modules[context.result.periodic[i]];
    module.period = items[i].period;
    module.offset = items[i].offset;
  }
}

std::string join(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) {
    text += (text.empty() ? "" : ", ") + part;
  }
  return text;
}

// Returns the place of the first module with whose period or offset the common divisor falls below the minimum.
base::SourcePlace culprit(const CheckContext& context, const std::vector<PeriodicItem>& items, base::Nanos minimum) {
  std::int64_t divisor = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const ModulePlaces& places = context.config.modules[context.result.periodic[i]].places;
    divisor = std::gcd(divisor, items[i].period.count());
    if (divisor < minimum.count()) {
      return places.period;
    }
    divisor = std::gcd(divisor, items[i].offset.count());
    if (divisor < minimum.count()) {
      return places.offset;
    }
  }
  return {};
}

// Reports a basic period that is too short, or adjusts `items`. Returns false if it stays too short.
bool check_basic_period(CheckContext& context, std::vector<PeriodicItem>& items) {
  const base::Nanos minimum = minimum_of(context.config);
  const base::Nanos basic = common_divisor(items, true);
  if (items.empty() || basic >= minimum) {
    return true;
  }
  const std::vector<PeriodicItem> nearest = nearest_items(items, minimum);
  const std::string reason = "the basic period (GCD of the periods" +
                             std::string(common_divisor(items, false) != basic ? " and offsets" : "") + ") is " +
                             base::format_duration(basic) + ", the minimum is " + base::format_duration(minimum);
  const std::vector<std::string> lines = changes(context, items, nearest);
  const base::SourcePlace place = culprit(context, items, minimum);
  if (context.options.adjust) {
    apply(context, nearest);
    items = nearest;
    context.report.note(place, reason + "; adjusted: " + join(lines));
    return true;
  }
  context.report.error(place, reason + "; nearest that work: " + join(lines) + "; --adjust applies them");
  return false;
}

// Returns the LCM of all periods except that of `left_out`, or 0 if it exceeds `limit`.
std::int64_t common_multiple(const std::vector<PeriodicItem>& items, std::int64_t left_out, std::int64_t limit) {
  std::int64_t multiple = 1;
  for (const PeriodicItem& item : items) {
    if (item.period.count() == left_out) {
      continue;
    }
    const std::int64_t common = std::max<std::int64_t>(std::gcd(multiple, item.period.count()), 1);
    const std::int64_t factor = std::max<std::int64_t>(item.period.count() / common, 1);
    if (multiple > limit / factor) {
      return 0;
    }
    multiple *= factor;
  }
  return multiple;
}

// Returns the periods that make the macro period long: those without which it would be shortest.
std::string long_macro_hint(const CheckContext& context, const std::vector<PeriodicItem>& items) {
  constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();
  std::set<std::int64_t> periods;
  for (const PeriodicItem& item : items) {
    periods.insert(item.period.count());
  }
  std::int64_t worst = 0;
  std::int64_t shortest = 0;
  for (const std::int64_t period : periods) {
    const std::int64_t rest = common_multiple(items, period, kNoLimit);
    if (rest != 0 && (shortest == 0 || rest < shortest)) {
      shortest = rest;
      worst = period;
    }
  }
  const std::string harmonic = "; periods that divide one another (1 ms, 2 ms, 10 ms) keep it short";
  if (worst == 0 || periods.size() < 2) {
    std::vector<std::string> all;
    all.reserve(periods.size());
    for (const std::int64_t period : periods) {
      all.push_back(base::format_duration(base::Nanos{period}));
    }
    return "the periods " + base::enumerate(all) + " have too few common factors" + harmonic;
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].period.count() == worst) {
      names.push_back(context.config.modules[context.result.periodic[i]].name);
    }
  }
  return "without the period " + base::format_duration(base::Nanos{worst}) + " of " + base::enumerate(names) +
         " it would be " + base::format_duration(base::Nanos{shortest}) + harmonic;
}

void check_macro_period(CheckContext& context, const std::vector<PeriodicItem>& items) {
  auto table = scheduler::make_period_table(items);
  const base::SourcePlace place =
      items.empty() ? base::SourcePlace{} : context.config.modules[context.result.periodic.front()].places.period;
  if (!table) {
    const bool overflow = table.error().code == Errc::Overflow;
    context.report.error(
        place, overflow ? "the macro period (LCM of the periods) exceeds 292 years; " + long_macro_hint(context, items)
                        : std::string(table.error().where));
    return;
  }
  context.result.table = std::move(table.value());
  const scheduler::PeriodTable& made = context.result.table;
  if (made.slot_count > scheduler::kMaxSlots) {
    context.report.warning(place, "the macro period (LCM of the periods) is " +
                                      base::format_duration(made.macro_period) + ", that is " +
                                      std::to_string(made.slot_count) + " basic periods, of which plans list " +
                                      std::to_string(scheduler::kMaxSlots) + "; " + long_macro_hint(context, items));
  }
}

// Every band except the one in the tick thread needs a priority level of the operating system on its core.
void check_bands(CheckContext& context) {
  const Config& config = context.config;
  std::map<int, std::size_t> levels;
  for (const auto& band :
       scheduler::make_bands(periodic_tasks(context), context.result.table.basic_period.count(), config.order)) {
    if (band.kind != scheduler::BandKind::Inline && ++levels[band.core] == kMaxBands + 1) {
      context.report.error(config.modules[context.result.periodic[band.tasks.front()]].place,
                           "from this module on the schedule needs more than the " + std::to_string(kMaxBands) +
                               " priority levels a core has; give thread modules of equal period neighbouring "
                               "priorities, they then share a level, or spread the modules over cores");
    }
  }
}

}  // namespace

std::vector<scheduler::Task> periodic_tasks(const CheckContext& context) {
  std::vector<scheduler::Task> tasks;
  std::vector<std::size_t> place(context.config.modules.size(), context.config.modules.size());
  for (const std::size_t i : context.result.periodic) {
    const Module& module = context.config.modules[i];
    scheduler::Task task;
    task.type = module.type;
    task.priority = module.priority;
    task.core = module.core >= 0 ? module.core : context.config.core;
    task.period_ns = module.period.count();
    task.offset_ns = module.offset.count();
    task.overrun = module.overrun;
    task.index = static_cast<std::uint32_t>(i);
    place[i] = tasks.size();
    tasks.push_back(task);
  }
  for (const Sharing& sharing : context.result.sharing) {
    if (place[sharing.first] < tasks.size() && place[sharing.second] < tasks.size()) {
      tasks[place[sharing.second]].after.push_back(static_cast<std::uint32_t>(sharing.first));
    }
  }
  return tasks;
}

void check_schedule(CheckContext& context) {
  CheckResult& result = context.result;
  const Config& config = context.config;
  result.periodic = modules_of(config, Operation::Periodic);
  const std::vector<std::size_t> sporadic = modules_of(config, Operation::Sporadic);
  for (const std::uint32_t i : scheduler::execution_order(
           sporadic.size(), [&](std::uint32_t n) { return config.modules[sporadic[n]].priority; })) {
    result.sporadic.push_back(sporadic[i]);
  }
  result.non_real = modules_of(config, Operation::NonReal);
  std::vector<PeriodicItem> items = items_of(config, result.periodic);
  if (check_basic_period(context, items)) {
    check_macro_period(context, items);
  } else if (auto table = scheduler::make_period_table(items)) {
    result.table = std::move(table.value());
  }
}

void check_load(CheckContext& context) {
  if (context.options.files) {
    find_sharing(context);
  } else if (uses_several_cores(context.config)) {
    // A plan works without files; their errors are not reported, but their content decides which modules may run in
    // parallel.
    std::vector<base::Diagnostic> ignored;
    CheckContext looking{context.config, context.options, context.result,
                         base::Diagnostics(context.config.file.string(), ignored), context.texts};
    check_files(looking);
    check_data_flow(looking);
    find_sharing(context);
  }
  take_measured_times(context);
  place_modules(context);
  check_bands(context);
  check_times(context);
}

}  // namespace indurop::config
