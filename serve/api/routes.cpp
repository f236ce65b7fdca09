// SPDX-License-Identifier: Apache-2.0
// The table of all that can be asked: protocols, methods, paths and what one has to be allowed for them.
#include <array>

#include "serve/api/answers.h"
#include "serve/door/house.h"

namespace indurop::serve {

// Long: it is a table.
std::span<const Route> all_routes() {
  constexpr Method kGet = Method::Get;
  constexpr Method kPost = Method::Post;
  constexpr Right kRead = Right::Read;
  constexpr Right kWrite = Right::Write;
  static constexpr std::array kRoutes{
      Route{kGet, "/api/v1/openapi.json", kRead, Pace::Quick, &answers::description},
      Route{kGet, "/api/v1/status", kRead, Pace::Quick, &answers::server_status},
      Route{kGet, "/api/v1/boards", kRead, Pace::Quick, &answers::boards},
      Route{kGet, "/api/v1/boards/{board}", kRead, Pace::Quick, &answers::board},
      Route{kGet, "/api/v1/boards/{board}/modules", kRead, Pace::Quick, &answers::modules},
      Route{kGet, "/api/v1/boards/{board}/modules/{module}/histograms", kRead, Pace::Quick, &answers::histograms},
      Route{kPost, "/api/v1/boards/{board}/modules/{module}/start", kWrite, Pace::Orders, &answers::start_module},
      Route{kPost, "/api/v1/boards/{board}/modules/{module}/stop", kWrite, Pace::Orders, &answers::stop_module},
      Route{kPost, "/api/v1/boards/{board}/modules/{module}/restart", kWrite, Pace::Orders, &answers::restart_module},
      Route{kGet, "/api/v1/boards/{board}/schedule", kRead, Pace::Files, &answers::schedule},
      Route{kGet, "/api/v1/boards/{board}/runs", kRead, Pace::Files, &answers::runs},
      Route{kGet, "/api/v1/boards/{board}/overruns", kRead, Pace::Files, &answers::overruns},
      Route{kGet, "/api/v1/boards/{board}/messages", kRead, Pace::Files, &answers::messages},
      Route{kGet, "/api/v1/boards/{board}/faults", kRead, Pace::Quick, &answers::faults},
      Route{kGet, "/api/v1/boards/{board}/variables", kRead, Pace::Files, &answers::variables},
      Route{kGet, "/api/v1/boards/{board}/variables/{name}", kRead, Pace::Files, &answers::variable},
      Route{kPost, "/api/v1/boards/{board}/set", kWrite, Pace::Orders, &answers::set},
      Route{kGet, "/api/v1/boards/{board}/forces", kRead, Pace::Quick, &answers::forces},
      Route{kPost, "/api/v1/boards/{board}/force", kWrite, Pace::Orders, &answers::force},
      Route{kPost, "/api/v1/boards/{board}/release", kWrite, Pace::Orders, &answers::release},
      Route{kPost, "/api/v1/boards/{board}/leases/{lease}/renew", kWrite, Pace::Holds, &answers::renew_lease},
      Route{kPost, "/api/v1/boards/{board}/leases/{lease}/end", kWrite, Pace::Holds, &answers::end_lease},
      Route{kPost, "/api/v1/boards/{board}/jog", kWrite, Pace::Holds, &answers::begin_jog},
      Route{kPost, "/api/v1/boards/{board}/jog/{jog}/keep", kWrite, Pace::Holds, &answers::keep_jog},
      Route{kPost, "/api/v1/boards/{board}/jog/{jog}/end", kWrite, Pace::Holds, &answers::end_jog},
      Route{kPost, "/api/v1/boards/{board}/lock", kWrite, Pace::Orders, &answers::set_lock},
      Route{kGet, "/api/v1/boards/{board}/alarms", kRead, Pace::Files, &answers::alarms},
      Route{kGet, "/api/v1/boards/{board}/alarms/history", kRead, Pace::Files, &answers::alarm_history},
      Route{kPost, "/api/v1/boards/{board}/alarms/ack", kWrite, Pace::Orders, &answers::acknowledge_alarms},
      Route{kPost, "/api/v1/boards/{board}/alarms/shelve", kWrite, Pace::Orders, &answers::shelve_alarms},
      Route{kPost, "/api/v1/boards/{board}/alarms/unshelve", kWrite, Pace::Orders, &answers::unshelve_alarms},
      Route{kGet, "/api/v1/boards/{board}/recipes", kRead, Pace::Files, &answers::recipes},
      Route{kGet, "/api/v1/boards/{board}/recipes/{name}", kRead, Pace::Files, &answers::recipe},
      Route{kPost, "/api/v1/boards/{board}/recipes/{name}/save", kWrite, Pace::Orders, &answers::save_recipe},
      Route{kPost, "/api/v1/boards/{board}/recipes/{name}/load", kWrite, Pace::Orders, &answers::load_recipe},
      Route{kPost, "/api/v1/boards/{board}/recipes/{name}/remove", kWrite, Pace::Orders, &answers::remove_recipe},
      Route{kGet, "/api/v1/boards/{board}/scope", kRead, Pace::Wait, &answers::scope},
      Route{kGet, "/api/v1/boards/{board}/robots", kRead, Pace::Files, &answers::robots},
      Route{kGet, "/api/v1/boards/{board}/plc", kRead, Pace::Plc, &answers::plc},
      Route{kGet, "/api/v1/boards/{board}/plc/live", kRead, Pace::Plc, &answers::plc_live},
      Route{kGet, "/api/v1/plant", kRead, Pace::Plant, &answers::plant},
      Route{kGet, "/api/v1/plant/history", kRead, Pace::Plant, &answers::plant_history},
      Route{kGet, "/api/v1/plant/difference", kRead, Pace::Plant, &answers::plant_difference},
      Route{kPost, "/api/v1/plant/rollback", kWrite, Pace::PlantOrders, &answers::plant_rollback},
      Route{kGet, "/api/v1/recordings", kRead, Pace::Files, &answers::recordings},
      Route{kGet, "/api/v1/recordings/{name}", kRead, Pace::Files, &answers::recording},
      Route{kGet, "/api/v1/recordings/{name}/values", kRead, Pace::Files, &answers::recorded_values},
      Route{kGet, "/api/v1/deployments", kRead, Pace::Quick, &answers::deployments},
      Route{kGet, "/api/v1/audit", kRead, Pace::Files, &answers::audit},
      Route{kGet, "/api/v1/stream", kRead, Pace::Stream, nullptr, kStream},
      Route{kGet, "/{any...}", kRead, Pace::Stream, nullptr, kFoxglove},
      Route{kGet, "/{any...}", kRead, Pace::Stream, nullptr, kFoxgloveSdk},
      // The page itself is no secret.
      Route{kGet, "/{file...}", Right::Open, Pace::Page, nullptr},
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
