// SPDX-License-Identifier: Apache-2.0
// The table of all routes: protocols, methods, paths, the right each needs, and how it is answered for a board of
// another host.
#include <array>

#include "tools/serve/api/answers.h"
#include "tools/serve/door/house.h"

namespace indurop::serve {

// Long: it is a table.
std::span<const Route> all_routes() {
  constexpr Method kGet = Method::Get;
  constexpr Method kPost = Method::Post;
  constexpr Right kRead = Right::Read;
  constexpr Right kWrite = Right::Write;
  static constexpr std::array kRoutes{
      Route{kGet, "/api/v1/openapi.json", kRead, Pace::Quick, &answers::description, kHereOnly},
      Route{kGet, "/api/v1/status", kRead, Pace::Quick, &answers::server_status, kHereOnly},
      Route{kGet, "/api/v1/boards", kRead, Pace::Quick, &answers::boards, kHereOnly},
      Route{kGet, "/api/v1/boards/{board}", kRead, Pace::Quick, &answers::board, kAlike},
      Route{kGet, "/api/v1/boards/{board}/modules", kRead, Pace::Quick, &answers::modules,
            through(&answers::remote_modules)},
      Route{kGet, "/api/v1/boards/{board}/modules/{module}/histograms", kRead, Pace::Quick, &answers::histograms,
            through(&answers::remote_histograms)},
      Route{kPost, "/api/v1/boards/{board}/modules/{module}/start", kWrite, Pace::Orders, &answers::start_module,
            through(&answers::remote_start)},
      Route{kPost, "/api/v1/boards/{board}/modules/{module}/stop", kWrite, Pace::Orders, &answers::stop_module,
            through(&answers::remote_stop)},
      Route{kPost, "/api/v1/boards/{board}/modules/{module}/restart", kWrite, Pace::Orders, &answers::restart_module,
            through(&answers::remote_restart)},
      Route{kGet, "/api/v1/boards/{board}/schedule", kRead, Pace::Files, &answers::schedule,
            through(&answers::remote_schedule)},
      Route{kGet, "/api/v1/boards/{board}/runs", kRead, Pace::Files, &answers::runs, through(&answers::remote_runs)},
      Route{kGet, "/api/v1/boards/{board}/overruns", kRead, Pace::Files, &answers::overruns,
            through(&answers::remote_overruns)},
      Route{kGet, "/api/v1/boards/{board}/messages", kRead, Pace::Files, &answers::messages,
            through(&answers::remote_messages)},
      Route{kGet, "/api/v1/boards/{board}/faults", kRead, Pace::Quick, &answers::faults, kAlike},
      Route{kGet, "/api/v1/boards/{board}/variables", kRead, Pace::Files, &answers::variables, kAlike},
      Route{kGet, "/api/v1/boards/{board}/variables/{name}", kRead, Pace::Files, &answers::variable, kAlike},
      Route{kPost, "/api/v1/boards/{board}/set", kWrite, Pace::Orders, &answers::set, through(&answers::remote_set)},
      Route{kGet, "/api/v1/boards/{board}/forces", kRead, Pace::Quick, &answers::forces, kAlike},
      Route{kPost, "/api/v1/boards/{board}/force", kWrite, Pace::Orders, &answers::force,
            through(&answers::remote_force)},
      Route{kPost, "/api/v1/boards/{board}/release", kWrite, Pace::Orders, &answers::release,
            through(&answers::remote_release)},
      Route{kPost, "/api/v1/boards/{board}/leases/{lease}/renew", kWrite, Pace::Holds, &answers::renew_lease,
            kHereOnly},
      Route{kPost, "/api/v1/boards/{board}/leases/{lease}/end", kWrite, Pace::Holds, &answers::end_lease, kHereOnly},
      Route{kPost, "/api/v1/boards/{board}/jog", kWrite, Pace::Holds, &answers::begin_jog, kHereOnly},
      Route{kPost, "/api/v1/boards/{board}/jog/{jog}/keep", kWrite, Pace::Holds, &answers::keep_jog, kHereOnly},
      Route{kPost, "/api/v1/boards/{board}/jog/{jog}/end", kWrite, Pace::Holds, &answers::end_jog, kHereOnly},
      Route{kPost, "/api/v1/boards/{board}/lock", kWrite, Pace::Orders, &answers::set_lock,
            through(&answers::remote_lock)},
      Route{kGet, "/api/v1/boards/{board}/alarms", kRead, Pace::Files, &answers::alarms,
            through(&answers::remote_alarms)},
      Route{kGet, "/api/v1/boards/{board}/alarms/history", kRead, Pace::Files, &answers::alarm_history,
            through(&answers::remote_alarm_history)},
      Route{kPost, "/api/v1/boards/{board}/alarms/ack", kWrite, Pace::Orders, &answers::acknowledge_alarms,
            through(&answers::acknowledge_alarms)},
      Route{kPost, "/api/v1/boards/{board}/alarms/shelve", kWrite, Pace::Orders, &answers::shelve_alarms,
            through(&answers::shelve_alarms)},
      Route{kPost, "/api/v1/boards/{board}/alarms/unshelve", kWrite, Pace::Orders, &answers::unshelve_alarms,
            through(&answers::unshelve_alarms)},
      Route{kGet, "/api/v1/boards/{board}/recipes", kRead, Pace::Files, &answers::recipes, kHereOnly},
      Route{kGet, "/api/v1/boards/{board}/recipes/{name}", kRead, Pace::Files, &answers::recipe, kHereOnly},
      Route{kPost, "/api/v1/boards/{board}/recipes/{name}/save", kWrite, Pace::Orders, &answers::save_recipe,
            kHereOnly},
      Route{kPost, "/api/v1/boards/{board}/recipes/{name}/load", kWrite, Pace::Orders, &answers::load_recipe,
            kHereOnly},
      Route{kPost, "/api/v1/boards/{board}/recipes/{name}/remove", kWrite, Pace::Orders, &answers::remove_recipe,
            kHereOnly},
      Route{kGet, "/api/v1/boards/{board}/scope", kRead, Pace::Wait, &answers::scope, kHereOnly},
      Route{kGet, "/api/v1/boards/{board}/robots", kRead, Pace::Files, &answers::robots, kHereOnly},
      Route{kGet, "/api/v1/boards/{board}/plc", kRead, Pace::Plc, &answers::plc, kHereOnly},
      Route{kGet, "/api/v1/boards/{board}/plc/live", kRead, Pace::Plc, &answers::plc_live, kHereOnly},
      Route{kGet, "/api/v1/plant", kRead, Pace::Plant, &answers::plant, kHereOnly},
      Route{kGet, "/api/v1/plant/history", kRead, Pace::Plant, &answers::plant_history, kHereOnly},
      Route{kGet, "/api/v1/plant/difference", kRead, Pace::Plant, &answers::plant_difference, kHereOnly},
      Route{kPost, "/api/v1/plant/rollback", kWrite, Pace::PlantOrders, &answers::plant_rollback, kHereOnly},
      Route{kGet, "/api/v1/recordings", kRead, Pace::Files, &answers::recordings, kHereOnly},
      Route{kGet, "/api/v1/recordings/{name}", kRead, Pace::Files, &answers::recording, kHereOnly},
      Route{kGet, "/api/v1/recordings/{name}/values", kRead, Pace::Files, &answers::recorded_values, kHereOnly},
      Route{kGet, "/api/v1/deployments", kRead, Pace::Quick, &answers::deployments, kHereOnly},
      Route{kGet, "/api/v1/audit", kRead, Pace::Files, &answers::audit, kHereOnly},
      Route{kGet, "/api/v1/stream", kRead, Pace::Stream, nullptr, kHereOnly, kStream},
      Route{kGet, "/{any...}", kRead, Pace::Stream, nullptr, kHereOnly, kFoxglove},
      Route{kGet, "/{any...}", kRead, Pace::Stream, nullptr, kHereOnly, kFoxgloveSdk},
      // The page itself needs no right.
      Route{kGet, "/{file...}", Right::Open, Pace::Page, nullptr, kHereOnly},
  };
  return kRoutes;
}

}  // namespace indurop::serve
