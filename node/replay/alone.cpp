// SPDX-License-Identifier: Apache-2.0
#include "node/replay/alone.h"

#include <algorithm>
#include <cmath>

#include "core/base/json.h"
#include "core/base/replace_file.h"

namespace indurop::node {
namespace {

using base::Json;

Json times_json(std::vector<std::int64_t> times) {
  std::sort(times.begin(), times.end());
  const auto at = [&times](std::size_t percent) {
    return times.empty() ? 0 : times[(times.size() - 1) * percent / 100];
  };
  return {{"median_ns", at(50)}, {"p99_ns", at(99)}, {"max_ns", at(100)}};
}

Json variable_json(const KnownValue& known, const std::string& name) {
  const bool measured = std::isfinite(known.farthest.largest);
  return {{"name", name},
          {"compared", known.compared},
          {"differing", known.differing},
          {"unclear", known.unclear},
          {"first_tick", known.first_tick},
          {"first_part", known.first_place},
          {"first_was", known.first_was},
          {"first_is", known.first_is},
          {"largest", measured ? Json(known.farthest.largest) : Json()},
          {"largest_part", known.farthest.part}};
}

}  // namespace

Alone::Alone(ReplayedModule& module, const vars::Store& store) : module_(module), store_(store) {
  module.keeps_own = true;
}

void Alone::note(const recorder::RunWords& run) {
  if (now_ns_.empty()) {
    first_tick_ = run.tail.tick;
  }
  last_tick_ = run.tail.tick;
  now_ns_.push_back(module_.busy_ns);
  then_ns_.push_back(run.tail.end_ns - run.tail.start_ns);
}

Result<void, base::Problem> Alone::write(const std::filesystem::path& file, const OtherDeclarations& others) const {
  Json variables = Json::array();
  for (const KnownValue& known : module_.known) {
    if (known.written && !known.only_viewed) {
      variables.push_back(variable_json(known, variable_at(store_, known.variable).name));
    }
  }
  const bool faulted = module_.apart && module_.has_faulted();
  const Json report = {
      {"module", module_.name},
      {"runs", now_ns_.size()},
      {"first_tick", first_tick_},
      {"last_tick", last_tick_},
      {"disturbed_runs", module_.disturbed_runs},
      {"initial_values", initial_values_},
      {"fault", faulted ? std::string(module_.state.record->last_fault) : ""},
      {"fault_tick", faulted ? module_.apart_tick : 0},
      {"only_recorded_fault", module_.apart && !faulted},
      {"now", times_json(now_ns_)},
      {"then", times_json(then_ns_)},
      {"not_written", std::vector<std::string>(module_.not_written.begin(), module_.not_written.end())},
      {"new", others.added},
      {"converted", others.converted},
      {"variables", variables}};
  if (const auto written = base::replace_file(file, report.dump(2), base::Durable::No); !written) {
    return base::Problem{base::cannot_write(file, written.error())};
  }
  return {};
}

}  // namespace indurop::node
