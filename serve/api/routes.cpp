// SPDX-License-Identifier: Apache-2.0
// The table of all paths.
#include <array>

#include "serve/api/answers.h"

namespace indurop::serve {

std::span<const Route> all_routes() {
  constexpr Method kGet = Method::Get;
  constexpr Method kPost = Method::Post;
  static constexpr std::array kRoutes{
      Route{kGet, "/api/v1/openapi.json", Pace::Quick, &answers::description},
      Route{kGet, "/api/v1/status", Pace::Quick, &answers::server_status},
      Route{kGet, "/api/v1/boards", Pace::Quick, &answers::boards},
      Route{kGet, "/api/v1/boards/{board}", Pace::Quick, &answers::board},
      Route{kGet, "/api/v1/boards/{board}/modules", Pace::Quick, &answers::modules},
      Route{kGet, "/api/v1/boards/{board}/modules/{module}/histograms", Pace::Quick, &answers::histograms},
      Route{kPost, "/api/v1/boards/{board}/modules/{module}/start", Pace::Orders, &answers::start_module},
      Route{kPost, "/api/v1/boards/{board}/modules/{module}/stop", Pace::Orders, &answers::stop_module},
      Route{kPost, "/api/v1/boards/{board}/modules/{module}/restart", Pace::Orders, &answers::restart_module},
      Route{kGet, "/api/v1/boards/{board}/schedule", Pace::Files, &answers::schedule},
      Route{kGet, "/api/v1/boards/{board}/runs", Pace::Files, &answers::runs},
      Route{kGet, "/api/v1/boards/{board}/overruns", Pace::Files, &answers::overruns},
      Route{kGet, "/api/v1/boards/{board}/messages", Pace::Files, &answers::messages},
      Route{kGet, "/api/v1/boards/{board}/faults", Pace::Quick, &answers::faults},
      Route{kGet, "/api/v1/boards/{board}/variables", Pace::Files, &answers::variables},
      Route{kGet, "/api/v1/boards/{board}/variables/{name}", Pace::Files, &answers::variable},
      Route{kPost, "/api/v1/boards/{board}/set", Pace::Orders, &answers::set},
      Route{kGet, "/api/v1/boards/{board}/forces", Pace::Quick, &answers::forces},
      Route{kPost, "/api/v1/boards/{board}/force", Pace::Orders, &answers::force},
      Route{kPost, "/api/v1/boards/{board}/release", Pace::Orders, &answers::release},
      Route{kPost, "/api/v1/boards/{board}/leases/{lease}/renew", Pace::Holds, &answers::renew_lease},
      Route{kPost, "/api/v1/boards/{board}/leases/{lease}/end", Pace::Holds, &answers::end_lease},
      Route{kPost, "/api/v1/boards/{board}/jog", Pace::Holds, &answers::begin_jog},
      Route{kPost, "/api/v1/boards/{board}/jog/{jog}/keep", Pace::Holds, &answers::keep_jog},
      Route{kPost, "/api/v1/boards/{board}/jog/{jog}/end", Pace::Holds, &answers::end_jog},
      Route{kPost, "/api/v1/boards/{board}/lock", Pace::Orders, &answers::set_lock},
      Route{kGet, "/api/v1/boards/{board}/alarms", Pace::Files, &answers::alarms},
      Route{kGet, "/api/v1/boards/{board}/alarms/history", Pace::Files, &answers::alarm_history},
      Route{kPost, "/api/v1/boards/{board}/alarms/ack", Pace::Orders, &answers::acknowledge_alarms},
      Route{kPost, "/api/v1/boards/{board}/alarms/shelve", Pace::Orders, &answers::shelve_alarms},
      Route{kPost, "/api/v1/boards/{board}/alarms/unshelve", Pace::Orders, &answers::unshelve_alarms},
      Route{kGet, "/api/v1/boards/{board}/recipes", Pace::Files, &answers::recipes},
      Route{kGet, "/api/v1/boards/{board}/recipes/{name}", Pace::Files, &answers::recipe},
      Route{kPost, "/api/v1/boards/{board}/recipes/{name}/save", Pace::Orders, &answers::save_recipe},
      Route{kPost, "/api/v1/boards/{board}/recipes/{name}/load", Pace::Orders, &answers::load_recipe},
      Route{kPost, "/api/v1/boards/{board}/recipes/{name}/remove", Pace::Orders, &answers::remove_recipe},
      Route{kGet, "/api/v1/boards/{board}/scope", Pace::Wait, &answers::scope},
      Route{kGet, "/api/v1/boards/{board}/robots", Pace::Files, &answers::robots},
      Route{kGet, "/api/v1/boards/{board}/plc", Pace::Plc, &answers::plc},
      Route{kGet, "/api/v1/boards/{board}/plc/live", Pace::Plc, &answers::plc_live},
      Route{kGet, "/api/v1/plant", Pace::Plant, &answers::plant},
      Route{kGet, "/api/v1/plant/history", Pace::Plant, &answers::plant_history},
      Route{kGet, "/api/v1/plant/difference", Pace::Plant, &answers::plant_difference},
      Route{kPost, "/api/v1/plant/rollback", Pace::PlantOrders, &answers::plant_rollback},
      Route{kGet, "/api/v1/recordings", Pace::Files, &answers::recordings},
      Route{kGet, "/api/v1/recordings/{name}", Pace::Files, &answers::recording},
      Route{kGet, "/api/v1/recordings/{name}/values", Pace::Files, &answers::recorded_values},
      Route{kGet, "/api/v1/deployments", Pace::Quick, &answers::deployments},
      Route{kGet, "/api/v1/audit", Pace::Files, &answers::audit},
  };
  return kRoutes;
}

FarRoute far_route(const Route& route) {
  struct Way {
    Reply (*here)(Api& api, const Call& call);
    Reply (*far)(Api& api, const Call& call);
  };
  static constexpr std::array kWays{
      Way{&answers::board, nullptr},
      Way{&answers::faults, nullptr},
      Way{&answers::forces, nullptr},
      Way{&answers::variables, nullptr},
      Way{&answers::variable, nullptr},
      Way{&answers::messages, &answers::far_messages},
      Way{&answers::modules, &answers::far_modules},
      Way{&answers::histograms, &answers::far_histograms},
      Way{&answers::schedule, &answers::far_schedule},
      Way{&answers::runs, &answers::far_runs},
      Way{&answers::overruns, &answers::far_overruns},
      Way{&answers::alarms, &answers::far_alarms},
      Way{&answers::alarm_history, &answers::far_alarm_history},
      Way{&answers::acknowledge_alarms, &answers::acknowledge_alarms},
      Way{&answers::shelve_alarms, &answers::shelve_alarms},
      Way{&answers::unshelve_alarms, &answers::unshelve_alarms},
      Way{&answers::set, &answers::far_set},
      Way{&answers::force, &answers::far_force},
      Way{&answers::release, &answers::far_release},
      Way{&answers::set_lock, &answers::far_lock},
      Way{&answers::start_module, &answers::far_start},
      Way{&answers::stop_module, &answers::far_stop},
      Way{&answers::restart_module, &answers::far_restart},
  };
  for (const Way& way : kWays) {
    if (way.here == route.answer) {
      return {true, way.far};
    }
  }
  return {};
}

}  // namespace indurop::serve
