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

std::string text(const Json& value) {
  return value.dump();
}

// Returns the times of modules with a known execution time; empty if there are none.
std::string times_json(const Config& config, const CheckResult& check) {
  if (check.dispatch_share == 0) {
    return {};
  }
  std::string lines;
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
    lines += (lines.empty() ? "\n    " : ",\n    ") + text(row);
  }
  return ",\n  \"utilisation\": " + text(Json(utilisation(config) + check.dispatch_share)) + ",\n  \"times\": [" +
         lines + "\n  ]";
}

// Returns the result of <cores>.
std::string cores_json(const Config& config, const CheckResult& check) {
  if (!check.spreading) {
    return {};
  }
  const Spreading& spreading = *check.spreading;
  std::string lines;
  for (const Spreading::One& one : spreading.modules) {
    const Module& module = config.modules[one.module];
    Json row;
    row["module"] = module.name;
    row["core"] = one.core;
    row["offset_ns"] = module.offset.count();
    row["priority"] = module.priority;
    row["why"] = one.why;
    lines += (lines.empty() ? "\n    " : ",\n    ") + text(row);
  }
  return ",\n  \"busiest_ns\": " + std::to_string(spreading.busiest.count()) + ",\n  \"cores\": [" + lines + "\n  ]";
}

// Returns everything between the braces.
std::string plan_fields(const Config& config, const CheckResult& check) {
  const scheduler::PeriodTable& table = check.table;
  std::string plan = "\n  \"basic_period_ns\": " + std::to_string(table.basic_period.count()) +
                     ",\n  \"macro_period_ns\": " + std::to_string(table.macro_period.count()) + ",\n  \"slots\": [";
  for (std::size_t i = 0; i < table.slots.size(); ++i) {  // one line each
    Json row;
    row["slot"] = i;
    row["time_ns"] = table.slots[i].time.count();
    row["modules"] = names_of(config, check, table.slots[i]);
    plan += (i == 0 ? "\n    " : ",\n    ") + text(row);
  }
  plan += table.slots.empty() ? "]" : "\n  ]";
  plan += ",\n  \"sporadic\": " + text(names_json(config, check.sporadic));
  plan += ",\n  \"non_real\": " + text(names_json(config, check.non_real));
  plan += times_json(config, check);
  plan += cores_json(config, check);
  if (table.slot_count > table.slots.size()) {
    plan += ",\n  \"slots_left_out\": " + std::to_string(table.slot_count - table.slots.size());
  }
  return plan;
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
  return "{" + plan_fields(config, check) + "\n}\n";
}

std::string plan_json(const Plant& plant, const PlantCheck& check) {
  std::string plan = "{\n\"plant\": " + text(plant.name) + ",\n\"boards\": [";
  for (std::size_t i = 0; i < plant.boards.size(); ++i) {
    const Board& board = plant.boards[i];
    plan += (i == 0 ? "{\n  \"name\": " : ", {\n  \"name\": ") + text(board.name) + "," +
            plan_fields(board.config, check.boards[i]) + "\n}";
  }
  return plan + "]\n}\n";
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
