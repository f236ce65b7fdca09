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
  constexpr Remote kLocalOnly = Remote::No;
  constexpr Remote kReported = Remote::Reported;
  constexpr Remote kAsked = Remote::Asked;
  constexpr Right kWrite = Right::Write;
  static constexpr std::array kRoutes{
      Route{kGet, "/api/v1/openapi.json", kRead, Pace::Quick, &answers::description, kLocalOnly},
      Route{kGet, "/api/v1/status", kRead, Pace::Quick, &answers::server_status, kLocalOnly},
      Route{kGet, "/api/v1/boards", kRead, Pace::Quick, &answers::boards, kLocalOnly},
      Route{kGet, "/api/v1/boards/{board}", kRead, Pace::Quick, &answers::board, kReported},
      Route{kGet, "/api/v1/boards/{board}/modules", kRead, Pace::Quick, &answers::modules, kAsked},
      Route{kGet, "/api/v1/boards/{board}/modules/{module}/histograms", kRead, Pace::Quick, &answers::histograms,
            kAsked},
      Route{kPost, "/api/v1/boards/{board}/modules/{module}/start", kWrite, Pace::Orders, &answers::start_module,
            kAsked},
      Route{kPost, "/api/v1/boards/{board}/modules/{module}/stop", kWrite, Pace::Orders, &answers::stop_module, kAsked},
      Route{kPost, "/api/v1/boards/{board}/modules/{module}/restart", kWrite, Pace::Orders, &answers::restart_module,
            kAsked},
      Route{kGet, "/api/v1/boards/{board}/schedule", kRead, Pace::Files, &answers::schedule, kAsked},
      Route{kGet, "/api/v1/boards/{board}/runs", kRead, Pace::Files, &answers::runs, kAsked},
      Route{kGet, "/api/v1/boards/{board}/overruns", kRead, Pace::Files, &answers::overruns, kAsked},
      Route{kGet, "/api/v1/boards/{board}/messages", kRead, Pace::Files, &answers::messages, kAsked},
      Route{kGet, "/api/v1/boards/{board}/faults", kRead, Pace::Quick, &answers::faults, kReported},
      Route{kGet, "/api/v1/boards/{board}/variables", kRead, Pace::Files, &answers::variables, kReported},
      Route{kGet, "/api/v1/boards/{board}/variables/{name}", kRead, Pace::Files, &answers::variable, kReported},
      Route{kPost, "/api/v1/boards/{board}/set", kWrite, Pace::Orders, &answers::set, kAsked},
      Route{kGet, "/api/v1/boards/{board}/forces", kRead, Pace::Quick, &answers::forces, kReported},
      Route{kPost, "/api/v1/boards/{board}/force", kWrite, Pace::Orders, &answers::force, kAsked},
      Route{kPost, "/api/v1/boards/{board}/release", kWrite, Pace::Orders, &answers::release, kAsked},
      Route{kPost, "/api/v1/boards/{board}/leases/{lease}/renew", kWrite, Pace::Holds, &answers::renew_lease,
            kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/leases/{lease}/end", kWrite, Pace::Holds, &answers::end_lease, kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/jog", kWrite, Pace::Holds, &answers::begin_jog, kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/jog/{jog}/keep", kWrite, Pace::Holds, &answers::keep_jog, kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/jog/{jog}/end", kWrite, Pace::Holds, &answers::end_jog, kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/lock", kWrite, Pace::Orders, &answers::set_lock, kAsked},
      Route{kGet, "/api/v1/boards/{board}/alarms", kRead, Pace::Files, &answers::alarms, kAsked},
      Route{kGet, "/api/v1/boards/{board}/alarms/history", kRead, Pace::Files, &answers::alarm_history, kAsked},
      Route{kPost, "/api/v1/boards/{board}/alarms/ack", kWrite, Pace::Orders, &answers::acknowledge_alarms, kAsked},
      Route{kPost, "/api/v1/boards/{board}/alarms/shelve", kWrite, Pace::Orders, &answers::shelve_alarms, kAsked},
      Route{kPost, "/api/v1/boards/{board}/alarms/unshelve", kWrite, Pace::Orders, &answers::unshelve_alarms, kAsked},
      Route{kGet, "/api/v1/boards/{board}/recipes", kRead, Pace::Files, &answers::recipes, kLocalOnly},
      Route{kGet, "/api/v1/boards/{board}/recipes/{name}", kRead, Pace::Files, &answers::recipe, kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/recipes/{name}/save", kWrite, Pace::Orders, &answers::save_recipe,
            kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/recipes/{name}/load", kWrite, Pace::Orders, &answers::load_recipe,
            kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/recipes/{name}/remove", kWrite, Pace::Orders, &answers::remove_recipe,
            kLocalOnly},
      Route{kGet, "/api/v1/boards/{board}/scope", kRead, Pace::Wait, &answers::scope, kLocalOnly},
      Route{kGet, "/api/v1/boards/{board}/robots", kRead, Pace::Files, &answers::robots, kLocalOnly},
      Route{kGet, "/api/v1/boards/{board}/plc", kRead, Pace::Plc, &answers::plc, kLocalOnly},
      Route{kGet, "/api/v1/boards/{board}/plc/live", kRead, Pace::Plc, &answers::plc_live, kLocalOnly},
      Route{kGet, "/api/v1/plant", kRead, Pace::Plant, &answers::plant, kLocalOnly},
      Route{kGet, "/api/v1/plant/history", kRead, Pace::Plant, &answers::plant_history, kLocalOnly},
      Route{kGet, "/api/v1/plant/difference", kRead, Pace::Plant, &answers::plant_difference, kLocalOnly},
      Route{kPost, "/api/v1/plant/rollback", kWrite, Pace::PlantOrders, &answers::plant_rollback, kLocalOnly},
      Route{kGet, "/api/v1/recordings", kRead, Pace::Files, &answers::recordings, kLocalOnly},
      Route{kGet, "/api/v1/recordings/{name}", kRead, Pace::Files, &answers::recording, kLocalOnly},
      Route{kGet, "/api/v1/recordings/{name}/values", kRead, Pace::Files, &answers::recorded_values, kLocalOnly},
      Route{kGet, "/api/v1/deployments", kRead, Pace::Quick, &answers::deployments, kLocalOnly},
      Route{kGet, "/api/v1/audit", kRead, Pace::Files, &answers::audit, kLocalOnly},
      Route{kGet, "/api/v1/stream", kRead, Pace::Stream, nullptr, kLocalOnly, kStream},
      Route{kGet, "/{any...}", kRead, Pace::Stream, nullptr, kLocalOnly, kFoxglove},
      Route{kGet, "/{any...}", kRead, Pace::Stream, nullptr, kLocalOnly, kFoxgloveSdk},
      // The page itself needs no right.
      Route{kGet, "/{file...}", Right::Open, Pace::Page, nullptr, kLocalOnly},
  };
  return kRoutes;
}

}  // namespace indurop::serve
