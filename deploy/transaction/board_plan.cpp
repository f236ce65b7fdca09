// SPDX-License-Identifier: Apache-2.0
#include "deploy/transaction/board_plan.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/json.h"

namespace indurop::deploy {
namespace {

using base::Json;
using PlannedAct = ModulePlan::Act;

struct PlanWord {
  PlannedAct act;
  const char* word;  // in the text
  const char* text;  // for people
};
constexpr std::array kPlanWords{PlanWord{PlannedAct::Kept, "kept", "kept"},
                                PlanWord{PlannedAct::Exchanged, "exchanged", "exchanged with state"},
                                PlanWord{PlannedAct::Fresh, "fresh", "exchanged fresh"},
                                PlanWord{PlannedAct::Open, "open", "exchanged"},
                                PlanWord{PlannedAct::Rescheduled, "rescheduled", "rescheduled"},
                                PlanWord{PlannedAct::Added, "added", "added"},
                                PlanWord{PlannedAct::Ended, "ended", "ended"},
                                PlanWord{PlannedAct::Restarted, "restarted", "restarted"},
                                PlanWord{PlannedAct::Refused, "refused", "refused"}};

const PlanWord& plan_word_of(PlannedAct act) noexcept {
  return *std::find_if(kPlanWords.begin(), kPlanWords.end(), [act](const PlanWord& one) { return one.act == act; });
}

// `key`: member with the name. Returns false if the list has something else.
template <class Plan>
bool read_plans(const Json& list, const char* key, std::string Plan::*name, std::vector<Plan>& plans) {
  for (const Json& one : list.values()) {
    Plan& plan = plans.emplace_back();
    std::string word;
    base::read(one, "act", word);
    const auto* const found =
        std::find_if(kPlanWords.begin(), kPlanWords.end(), [&](const PlanWord& known) { return known.word == word; });
    if (found == kPlanWords.end() || !base::read(one, key, plan.*name)) {
      return false;
    }
    plan.act = found->act;
    base::read(one, "why", plan.why);
  }
  return true;
}

}  // namespace

const char* to_text(ModulePlan::Act act) noexcept {
  return plan_word_of(act).text;
}

std::string text_of(const BoardPlan& plan) {
  Json modules = Json::array();
  for (const ModulePlan& module : plan.modules) {
    modules.push_back({{"module", module.module}, {"act", plan_word_of(module.act).word}, {"why", module.why}});
  }
  Json pools = Json::array();
  for (const PoolPlan& pool : plan.pools) {
    pools.push_back({{"pool", pool.pool}, {"act", plan_word_of(pool.act).word}, {"why", pool.why}});
  }
  return Json{{"restart", plan.restart},
              {"tick", plan.tick},
              {"schedule_tick", plan.schedule_tick},
              {"left_out", plan.left_out},
              {"modules", std::move(modules)},
              {"pools", std::move(pools)}}
      .dump();
}

std::optional<BoardPlan> parse_board_plan(std::string_view text) {
  const auto json = Json::parse(text);
  BoardPlan plan;
  if (!json || !base::read(*json, "restart", plan.restart) || !base::read(*json, "tick", plan.tick) ||
      !base::read(*json, "left_out", plan.left_out) || !base::read(*json, "schedule_tick", plan.schedule_tick)) {
    return std::nullopt;
  }
  // Boards of an earlier release say nothing about pools.
  if (!read_plans((*json)["modules"], "module", &ModulePlan::module, plan.modules) ||
      !read_plans((*json)["pools"], "pool", &PoolPlan::pool, plan.pools)) {
    return std::nullopt;
  }
  return plan;
}

BoardPlan restarted(BoardPlan plan) {
  for (ModulePlan& module : plan.modules) {
    if (module.act == PlannedAct::Kept || module.act == PlannedAct::Exchanged || module.act == PlannedAct::Fresh ||
        module.act == PlannedAct::Open || module.act == PlannedAct::Rescheduled) {
      module = {module.module, PlannedAct::Restarted, ""};
    }
  }
  return plan;
}

}  // namespace indurop::deploy
