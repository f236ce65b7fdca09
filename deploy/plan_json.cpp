// SPDX-License-Identifier: Apache-2.0
// The plan for programs: JSON and CSV. Names and order of the fields are a promise, see docs/module_xml.md.

#include <nlohmann/json.hpp>

#include "deploy/plan_parts.h"

namespace indurop::deploy {
namespace {

using Json = nlohmann::ordered_json;

Json names_json(const Config& config, const std::vector<std::size_t>& modules) {
  Json names = Json::array();
  for (const std::size_t i : modules) {
    names.push_back(config.modules[i].name);
  }
  return names;
}

// RFC 4180: in quotes if needed, quotes doubled.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    return text;
  }
  std::string field = "\"";
  for (const char c : text) {
    field += c == '"' ? std::string("\"\"") : std::string(1, c);
  }
  return field + "\"";
}

}  // namespace

std::string plan_json(const Config& config, const CheckResult& check) {
  Json plan;
  plan["basic_period_ns"] = check.table.basic_period.count();
  plan["macro_period_ns"] = check.table.macro_period.count();
  Json& slots = plan["slots"] = Json::array();
  for (std::size_t i = 0; i < check.table.slots.size(); ++i) {
    const scheduler::Slot& slot = check.table.slots[i];
    Json row;
    row["slot"] = i;
    row["time_ns"] = slot.time.count();
    row["modules"] = names_of(config, check, slot);
    slots.push_back(std::move(row));
  }
  plan["sporadic"] = names_json(config, check.sporadic);
  plan["non_real"] = names_json(config, check.non_real);
  if (check.table.slot_count > check.table.slots.size()) {
    plan["slots_left_out"] = check.table.slot_count - check.table.slots.size();
  }
  constexpr int kIndent = 2;
  return plan.dump(kIndent, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string plan_csv(const Config& config, const CheckResult& check) {
  std::string text = "slot,time_ns,modules\n";
  for (std::size_t i = 0; i < check.table.slots.size(); ++i) {
    const scheduler::Slot& slot = check.table.slots[i];
    text += std::to_string(i) + "," + std::to_string(slot.time.count()) + "," +
            csv_field(in_order(names_of(config, check, slot))) + "\n";
  }
  return text;
}

}  // namespace indurop::deploy
