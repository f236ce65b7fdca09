// SPDX-License-Identifier: Apache-2.0
// Answers about the schedule: the plan, the runs, and their timing.
#include <fmt/format.h>

#include "config/plan/plan.h"
#include "config/xml/plant_reader.h"
#include "tools/client/config/checked_config.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/boards/board.h"

namespace indurop::serve::answers {
namespace {

constexpr std::uint64_t kMostSamples = 8192;

struct Ran {
  const Board* board;
  tools::RunView run;
};
// Returns the board of a call with its node's run block; or the refusal.
Result<Ran, Reply> ran_of(const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  auto run = (*found)->current_run();
  if (!run) {
    return refusal(run.error().code, run.error().reasons.front());
  }
  return Ran{*found, std::move(run).value()};
}
Reply wrong_count() {
  return refusal(status::kBadRequest, fmt::format("count is a number of 1 to {}, after one of 0 on", kMostSamples));
}

// Returns the plan of a file as JSON, or why there is none.
std::pair<base::Json, std::string> plan_of(const std::string& file) {
  const config::CheckOptions options{.files = false, .adjust = true};
  if (config::is_plant_file(file)) {
    const tools::CheckedPlant checked = tools::load_plant(file, options);
    if (checked.ok()) {
      return {base::Json::parse(config::plan_json(checked.plant, checked.check)).value_or(base::Json()), ""};
    }
  } else {
    const tools::CheckedConfig checked = tools::load_config(file, options);
    if (checked.ok()) {
      return {base::Json::parse(config::plan_json(checked.config, checked.check)).value_or(base::Json()), ""};
    }
  }
  return {base::Json(), fmt::format("{} cannot be read or is not what the board runs; see indurop check", file)};
}

base::Json histogram_of(const scheduler::Distribution& distribution) {
  const scheduler::Summary summary = scheduler::summarize(distribution);
  base::Json bins = base::Json::array();
  for (std::size_t i = 0; i < scheduler::Histogram::kBuckets; ++i) {
    if (const std::uint64_t count = distribution.histogram.count(i); count > 0) {
      base::Json bin = base::Json::array();
      bin.push_back(scheduler::Histogram::lower_bound(i));
      bin.push_back(scheduler::Histogram::upper_bound(i));
      bin.push_back(count);
      bins.push_back(std::move(bin));
    }
  }
  base::Json out = base::Json::object();
  out["count"] = summary.count;
  out["min_ns"] = summary.min;
  out["max_ns"] = summary.max;
  out["mean_ns"] = summary.mean;
  out["p50_ns"] = summary.p50;
  out["p99_ns"] = summary.p99;
  out["bins"] = std::move(bins);
  return out;
}

}  // namespace

Reply histograms(Api& /*api*/, const Call& call) {
  const auto found = ran_of(call);
  if (!found) {
    return found.error();
  }
  const auto& [board, run] = *found;
  const std::string& name = call.part.find("module")->second;
  for (std::uint32_t i = 0; i < run.module_count(); ++i) {
    const auto& module = run.module(i);
    if (tools::fixed_text(module.name) != name) {
      continue;
    }
    base::Json all = base::Json::object();
    all["jitter"] = histogram_of(module.jitter);
    all["latency"] = histogram_of(module.latency);
    all["exec"] = histogram_of(module.exec);
    all["response"] = histogram_of(module.response);
    base::Json body = about(*board);
    body["module"] = name;
    body["histograms"] = std::move(all);
    return json_reply(body);
  }
  return refusal(status::kNotFound, fmt::format("board {} has no module '{}'", board->name(), name));
}

Reply schedule(Api& /*api*/, const Call& call) {
  const auto found = ran_of(call);
  if (!found) {
    return found.error();
  }
  const auto& [board, run] = *found;
  const auto& block = run.block();
  auto [plan, message] = board->remote() == nullptr
                             ? plan_of(tools::fixed_text(block.schedule_files[block.schedule.load() % 2]))
                             : std::pair(base::Json(), std::string("The plan is in files on the board's host."));
  base::Json body = about(*board);
  body["basic_period_ns"] = block.basic_period_ns;
  body["macro_period_ns"] = block.macro_period_ns.load();
  body["slots"] = block.slot_count.load();
  body["epoch_ns"] = block.epoch_ns.load();
  body["plan"] = std::move(plan);
  body["message"] = message;
  return json_reply(body);
}

Reply runs(Api& /*api*/, const Call& call) {
  constexpr std::uint64_t kUsual = 1000;
  const auto found = ran_of(call);
  if (!found) {
    return found.error();
  }
  const auto& [board, run] = *found;
  const auto count = query_number(call, "count", kUsual, 1, kMostSamples);
  const auto after = query_number(call, "after", UINT64_MAX, 0, UINT64_MAX);
  if (!count || !after) {
    return wrong_count();
  }
  base::Json list = base::Json::array();
  for (const tools::SlotSample& sample : run.slot_log(*count)) {
    if (*after != UINT64_MAX && sample.number <= *after) {
      continue;
    }
    base::Json one = base::Json::object();
    one["number"] = sample.number;
    one["tick"] = sample.tick;
    one["slot"] = sample.slot;
    one["module"] = run.module_name(sample.module);
    one["release_ns"] = sample.release_ns;
    one["start_ns"] = sample.start_ns;
    one["end_ns"] = sample.end_ns;
    list.push_back(std::move(one));
  }
  base::Json body = about(*board);
  body["epoch_ns"] = run.block().epoch_ns.load();
  body["now_ns"] = run.now_ns();
  body["next"] = run.block().slot_log_next.load(std::memory_order_relaxed);
  body["runs"] = std::move(list);
  return json_reply(body);
}

Reply overruns(Api& /*api*/, const Call& call) {
  constexpr std::uint64_t kUsual = 100;
  const auto found = ran_of(call);
  if (!found) {
    return found.error();
  }
  const auto& [board, run] = *found;
  const auto count = query_number(call, "count", kUsual, 1, kMostSamples);
  if (!count) {
    return wrong_count();
  }
  base::Json list = base::Json::array();
  for (const tools::OverrunSample& sample : run.overrun_log(*count)) {
    base::Json one = base::Json::object();
    one["number"] = sample.number;
    one["tick"] = sample.tick;
    one["slot"] = sample.slot;
    one["module"] = run.module_name(sample.module);
    one["own_ns"] = sample.own_ns;
    one["latency_ns"] = sample.latency_ns;
    one["previous"] = sample.previous >= 0 ? run.module_name(sample.previous) : std::string();
    one["previous_ns"] = sample.previous_ns;
    one["started"] = sample.started;
    list.push_back(std::move(one));
  }
  base::Json body = about(*board);
  body["epoch_ns"] = run.block().epoch_ns.load();
  body["overruns"] = std::move(list);
  return json_reply(body);
}

Reply messages(Api& /*api*/, const Call& call) {
  constexpr std::uint64_t kUsual = 100;
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const auto count = query_number(call, "count", kUsual, 1, kMostSamples);
  if (!count) {
    return wrong_count();
  }
  const auto printed = (*found)->messages(*count);
  if (!printed) {
    return refusal(printed.error().code, printed.error().reasons.front());
  }
  base::Json body = about(**found);
  body.update(*printed);
  return json_reply(body);
}

}  // namespace indurop::serve::answers
