// SPDX-License-Identifier: Apache-2.0
// The plan for programs: JSON and CSV. Names and order of the fields are stable, see docs/report.md.

#include "config/plan/plan_parts.h"
#include "core/base/csv_row.h"
#include "core/base/json.h"
#include "scheduler/response_time.h"

namespace indurop::config {
namespace {

using base::Json;

Json names_json(const Config& config, const std::vector<std::size_t>& modules) {
  Json names = Json::array();
  for (const std::size_t i : modules) {
    names.push_back(config.modules[i].name);
  }
  return names;
}

// Adds the times of modules with a known execution time; nothing if there are none.
void add_times(Json& plan, const Config& config, const CheckResult& check) {
  if (check.dispatch_share == 0) {
    return;
  }
  plan["utilisation"] = utilisation(config) + check.dispatch_share;
  Json times = Json::array();
  for (std::size_t i = 0; i < config.modules.size(); ++i) {
    const Module& module = config.modules[i];
    if (module.wcet == base::Nanos::zero()) {
      continue;
    }
    const Timing& timing = check.timings[i];
    const bool ends = timing.known && timing.worst != scheduler::WorstResponses::kNotDone;
    Json row;
    row["module"] = module.name;
    row["wcet_ns"] = module.wcet.count();
    row["utilisation"] = utilisation(module);
    row["worst_response_ns"] = ends ? Json(timing.worst.count()) : Json();
    row["slack_ns"] = ends ? Json(slack_of(module, timing).count()) : Json();
    times.push_back(std::move(row));
  }
  plan["times"] = std::move(times);
}

// Adds the result of <cores>.
void add_cores(Json& plan, const Config& config, const CheckResult& check) {
  if (!check.spreading) {
    return;
  }
  plan["busiest_ns"] = check.spreading->busiest.count();
  Json cores = Json::array();
  for (const Spreading::One& one : check.spreading->modules) {
    const Module& module = config.modules[one.module];
    Json row;
    row["module"] = module.name;
    row["core"] = one.core;
    row["offset_ns"] = module.offset.count();
    row["priority"] = module.priority;
    row["why"] = one.why;
    cores.push_back(std::move(row));
  }
  plan["cores"] = std::move(cores);
}

void add_plan(Json& plan, const Config& config, const CheckResult& check) {
  const scheduler::PeriodTable& table = check.table;
  plan["basic_period_ns"] = table.basic_period.count();
  plan["macro_period_ns"] = table.macro_period.count();
  Json slots = Json::array();
  for (std::size_t i = 0; i < table.slots.size(); ++i) {
    Json row;
    row["slot"] = i;
    row["time_ns"] = table.slots[i].time.count();
    row["modules"] = names_of(config, check, table.slots[i]);
    slots.push_back(std::move(row));
  }
  plan["slots"] = std::move(slots);
  plan["sporadic"] = names_json(config, check.sporadic);
  plan["non_real"] = names_json(config, check.non_real);
  add_times(plan, config, check);
  add_cores(plan, config, check);
  if (table.slot_count > table.slots.size()) {
    plan["slots_left_out"] = table.slot_count - table.slots.size();
  }
}

// `first`: beginning of every line.
std::string csv_lines(const Config& config, const CheckResult& check, const std::string& first) {
  std::string text;
  for (std::size_t i = 0; i < check.table.slots.size(); ++i) {
    const scheduler::Slot& slot = check.table.slots[i];
    text += first + std::to_string(i) + "," + std::to_string(slot.time.count()) + "," +
            base::csv_field(in_order(names_of(config, check, slot))) + "\n";
  }
  return text;
}

}  // namespace

std::string plan_json(const Config& config, const CheckResult& check) {
  Json plan;
  add_plan(plan, config, check);
  return plan.dump_rows() + "\n";
}

std::string plan_json(const Plant& plant, const PlantCheck& check) {
  Json boards = Json::array();
  for (std::size_t i = 0; i < plant.boards.size(); ++i) {
    Json board;
    board["name"] = plant.boards[i].name;
    add_plan(board, plant.boards[i].config, check.boards[i]);
    boards.push_back(std::move(board));
  }
  Json plan;
  plan["plant"] = plant.name;
  plan["boards"] = std::move(boards);
  return plan.dump_rows() + "\n";
}

std::string plan_csv(const Config& config, const CheckResult& check) {
  return "slot,time_ns,modules\n" + csv_lines(config, check, "");
}

std::string plan_csv(const Plant& plant, const PlantCheck& check) {
  std::string plan = "board,slot,time_ns,modules\n";
  for (std::size_t i = 0; i < plant.boards.size(); ++i) {
    plan += csv_lines(plant.boards[i].config, check.boards[i], plant.boards[i].name + ",");
  }
  return plan;
}

}  // namespace indurop::config
