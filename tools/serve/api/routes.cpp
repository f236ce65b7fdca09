// SPDX-License-Identifier: Apache-2.0
// The table of all routes: protocols, methods, paths, the role each needs, and how it is answered for a board of
// another host.
#include <array>

#include "tools/serve/api/answers.h"
#include "tools/serve/door/house.h"

namespace indurop::serve {

// Long: it is a table.
std::span<const Route> all_routes() {
  constexpr Method kGet = Method::Get;
  constexpr Method kPost = Method::Post;
  constexpr Role kLook = Role::Look;
  constexpr Role kOperate = Role::Operate;
  constexpr Role kTune = Role::Tune;
  constexpr Role kProgram = Role::Program;
  constexpr Role kAdminister = Role::Administer;
  constexpr Remote kLocalOnly = Remote::No;
  constexpr Remote kReported = Remote::Reported;
  constexpr Remote kAsked = Remote::Asked;
  constexpr Remote kSame = Remote::Same;
  static constexpr std::array kRoutes{
      Route{kPost, "/api/v1/session", Role::Unknown, Pace::SignIn, &answers::sign_in, kLocalOnly},
      Route{kGet, "/api/v1/session", kLook, Pace::Quick, &answers::session, kLocalOnly},
      Route{kPost, "/api/v1/session/end", kLook, Pace::Quick, &answers::sign_out, kLocalOnly},
      Route{kGet, "/api/v1/users", kAdminister, Pace::Quick, &answers::users, kLocalOnly},
      Route{kPost, "/api/v1/users/{user}/end", kAdminister, Pace::Orders, &answers::end_sessions, kLocalOnly},
      Route{kGet, "/api/v1/openapi.json", kLook, Pace::Quick, &answers::description, kLocalOnly},
      Route{kGet, "/api/v1/status", kLook, Pace::Quick, &answers::server_status, kLocalOnly},
      Route{kGet, "/api/v1/boards", kLook, Pace::Quick, &answers::boards, kLocalOnly},
      Route{kGet, "/api/v1/boards/{board}", kLook, Pace::Quick, &answers::board, kReported},
      Route{kGet, "/api/v1/boards/{board}/modules", kLook, Pace::Quick, &answers::modules, kAsked},
      Route{kGet, "/api/v1/boards/{board}/modules/{module}/histograms", kLook, Pace::Quick, &answers::histograms,
            kAsked},
      Route{kPost, "/api/v1/boards/{board}/modules/{module}/start", kProgram, Pace::Orders, &answers::start_module,
            kAsked},
      Route{kPost, "/api/v1/boards/{board}/modules/{module}/stop", kProgram, Pace::Orders, &answers::stop_module,
            kAsked},
      Route{kPost, "/api/v1/boards/{board}/modules/{module}/restart", kProgram, Pace::Orders, &answers::restart_module,
            kAsked},
      Route{kGet, "/api/v1/boards/{board}/schedule", kLook, Pace::Files, &answers::schedule, kAsked},
      Route{kGet, "/api/v1/boards/{board}/runs", kLook, Pace::Files, &answers::runs, kAsked},
      Route{kGet, "/api/v1/boards/{board}/overruns", kLook, Pace::Files, &answers::overruns, kAsked},
      Route{kGet, "/api/v1/boards/{board}/messages", kLook, Pace::Files, &answers::messages, kAsked},
      Route{kGet, "/api/v1/boards/{board}/faults", kLook, Pace::Quick, &answers::faults, kReported},
      Route{kGet, "/api/v1/boards/{board}/variables", kLook, Pace::Files, &answers::variables, kReported},
      Route{kGet, "/api/v1/boards/{board}/variables/{name}", kLook, Pace::Files, &answers::variable, kReported},
      Route{kGet, "/api/v1/boards/{board}/history", kLook, Pace::History, &answers::value_history, kLocalOnly},
      Route{kGet, "/api/v1/boards/{board}/functions", kLook, Pace::Files, &answers::functions, kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/functions/{function}/call", kOperate, Pace::Calls, &answers::call_function,
            kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/set", kOperate, Pace::Orders, &answers::set, kAsked},
      Route{kGet, "/api/v1/boards/{board}/forces", kLook, Pace::Quick, &answers::forces, kReported},
      Route{kPost, "/api/v1/boards/{board}/force", kTune, Pace::Orders, &answers::force, kAsked},
      Route{kPost, "/api/v1/boards/{board}/release", kTune, Pace::Orders, &answers::release, kAsked},
      Route{kPost, "/api/v1/boards/{board}/leases/{lease}/renew", kTune, Pace::Holds, &answers::renew_lease, kSame},
      Route{kPost, "/api/v1/boards/{board}/leases/{lease}/end", kTune, Pace::Holds, &answers::end_lease, kSame},
      Route{kPost, "/api/v1/boards/{board}/jog", kOperate, Pace::Holds, &answers::begin_jog, kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/jog/{jog}/keep", kOperate, Pace::Holds, &answers::keep_jog, kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/jog/{jog}/end", kOperate, Pace::Holds, &answers::end_jog, kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/lock", kProgram, Pace::Orders, &answers::set_lock, kAsked},
      Route{kGet, "/api/v1/boards/{board}/alarms", kLook, Pace::Files, &answers::alarms, kAsked},
      Route{kGet, "/api/v1/boards/{board}/alarms/history", kLook, Pace::Files, &answers::alarm_history, kAsked},
      Route{kPost, "/api/v1/boards/{board}/alarms/ack", kOperate, Pace::Orders, &answers::acknowledge_alarms, kAsked},
      Route{kPost, "/api/v1/boards/{board}/alarms/shelve", kTune, Pace::Orders, &answers::shelve_alarms, kAsked},
      Route{kPost, "/api/v1/boards/{board}/alarms/unshelve", kTune, Pace::Orders, &answers::unshelve_alarms, kAsked},
      Route{kGet, "/api/v1/boards/{board}/recipes", kLook, Pace::Files, &answers::recipes, kLocalOnly},
      Route{kGet, "/api/v1/boards/{board}/recipes/{name}", kLook, Pace::Files, &answers::recipe, kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/recipes/{name}/save", kTune, Pace::Orders, &answers::save_recipe,
            kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/recipes/{name}/load", kOperate, Pace::Orders, &answers::load_recipe,
            kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/recipes/{name}/remove", kTune, Pace::Orders, &answers::remove_recipe,
            kLocalOnly},
      Route{kGet, "/api/v1/boards/{board}/scope", kLook, Pace::Wait, &answers::scope, kLocalOnly},
      Route{kGet, "/api/v1/boards/{board}/robots", kLook, Pace::Files, &answers::robots, kLocalOnly},
      Route{kGet, "/api/v1/boards/{board}/robots/{module}/guiding", kLook, Pace::Files, &answers::guided_path,
            kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/robots/{module}/guiding/write", kTune, Pace::Replays,
            &answers::write_guided_path, kLocalOnly},
      Route{kGet, "/api/v1/boards/{board}/robots/{module}/calibrations/{kind}/{name}", kLook, Pace::Files,
            &answers::calibration, kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/robots/{module}/calibrations/{kind}/{name}/take", kTune, Pace::Orders,
            &answers::take_calibration_point, kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/robots/{module}/calibrations/{kind}/{name}/drop", kTune, Pace::Orders,
            &answers::drop_calibration_point, kLocalOnly},
      Route{kPost, "/api/v1/boards/{board}/robots/{module}/calibrations/{kind}/{name}/accept", kTune, Pace::Orders,
            &answers::accept_calibration, kLocalOnly},
      Route{kGet, "/api/v1/boards/{board}/plc", kLook, Pace::Plc, &answers::plc, kLocalOnly},
      Route{kGet, "/api/v1/boards/{board}/plc/live", kLook, Pace::Plc, &answers::plc_live, kLocalOnly},
      Route{kGet, "/api/v1/boards/{board}/plc/model", kLook, Pace::Plc, &answers::plc_model, kLocalOnly},
      Route{kGet, "/api/v1/plant", kLook, Pace::Plant, &answers::plant, kLocalOnly},
      Route{kGet, "/api/v1/plant/history", kLook, Pace::Plant, &answers::plant_history, kLocalOnly},
      Route{kGet, "/api/v1/plant/difference", kLook, Pace::Plant, &answers::plant_difference, kLocalOnly},
      Route{kPost, "/api/v1/plant/rollback", kProgram, Pace::PlantOrders, &answers::plant_rollback, kLocalOnly},
      Route{kGet, "/api/v1/recordings", kLook, Pace::Files, &answers::recordings, kLocalOnly},
      Route{kGet, "/api/v1/recordings/{name}", kLook, Pace::Files, &answers::recording, kLocalOnly},
      Route{kGet, "/api/v1/recordings/{name}/values", kLook, Pace::Files, &answers::recorded_values, kLocalOnly},
      Route{kGet, "/api/v1/recordings/{name}/tick", kLook, Pace::Files, &answers::recorded_tick, kLocalOnly},
      Route{kPost, "/api/v1/recordings/{name}/replay", kProgram, Pace::Replays, &answers::replay_recording, kLocalOnly},
      Route{kGet, "/api/v1/deployments", kLook, Pace::Quick, &answers::deployments, kLocalOnly},
      Route{kGet, "/api/v1/audit", kLook, Pace::Files, &answers::audit, kLocalOnly},
      Route{kGet, "/metrics", kLook, Pace::Files, &answers::metrics, kLocalOnly},
      Route{kGet, "/api/v1/stream", kLook, Pace::Stream, nullptr, kLocalOnly, kStream},
      Route{kGet, "/{any...}", kLook, Pace::Stream, nullptr, kLocalOnly, kFoxglove},
      Route{kGet, "/{any...}", kLook, Pace::Stream, nullptr, kLocalOnly, kFoxgloveSdk},
      // The page itself needs no right.
      Route{kGet, "/{file...}", Role::Unknown, Pace::Page, nullptr, kLocalOnly},
  };
  return kRoutes;
}

}  // namespace indurop::serve
