// SPDX-License-Identifier: Apache-2.0
// The answers to API requests, one function per path and method of tools/serve/openapi.json. Each file has the answers
// of one subject.

#pragma once

#include "tools/serve/api/api.h"
#include "tools/serve/api/router.h"

namespace indurop::serve {

class Board;

namespace answers {

Reply description(Api& api, const Call& call);
Reply server_status(Api& api, const Call& call);
Reply audit(Api& api, const Call& call);
Reply metrics(Api& api, const Call& call);

// Returns the name in a request to sign in; nothing: it has none.
std::optional<std::string> user_who_signs_in(const Request& request);
Reply sign_in(Api& api, const Call& call);
Reply session(Api& api, const Call& call);
Reply sign_out(Api& api, const Call& call);
Reply users(Api& api, const Call& call);
Reply end_sessions(Api& api, const Call& call);

Reply boards(Api& api, const Call& call);
Reply board(Api& api, const Call& call);
Reply modules(Api& api, const Call& call);
Reply faults(Api& api, const Call& call);
Reply forces(Api& api, const Call& call);
Reply deployments(Api& api, const Call& call);
Reply robots(Api& api, const Call& call);
Reply recordings(Api& api, const Call& call);
Reply recording(Api& api, const Call& call);
Reply recorded_values(Api& api, const Call& call);
Reply recorded_tick(Api& api, const Call& call);
Reply replay_recording(Api& api, const Call& call);

Reply plc(Api& api, const Call& call);
Reply plc_live(Api& api, const Call& call);
Reply plc_model(Api& api, const Call& call);

Reply plant(Api& api, const Call& call);
Reply plant_history(Api& api, const Call& call);
Reply plant_difference(Api& api, const Call& call);
Reply plant_rollback(Api& api, const Call& call);

Reply histograms(Api& api, const Call& call);
Reply schedule(Api& api, const Call& call);
Reply runs(Api& api, const Call& call);
Reply overruns(Api& api, const Call& call);
Reply messages(Api& api, const Call& call);

Reply variables(Api& api, const Call& call);
Reply variable(Api& api, const Call& call);
Reply value_history(Api& api, const Call& call);
Reply functions(Api& api, const Call& call);
Reply call_function(Api& api, const Call& call);
Reply scope(Api& api, const Call& call);

Reply alarms(Api& api, const Call& call);
Reply alarm_history(Api& api, const Call& call);
Reply acknowledge_alarms(Api& api, const Call& call);
Reply shelve_alarms(Api& api, const Call& call);
Reply unshelve_alarms(Api& api, const Call& call);

Reply recipes(Api& api, const Call& call);
Reply recipe(Api& api, const Call& call);
Reply save_recipe(Api& api, const Call& call);
Reply load_recipe(Api& api, const Call& call);
Reply remove_recipe(Api& api, const Call& call);

Reply set(Api& api, const Call& call);
Reply force(Api& api, const Call& call);
Reply release(Api& api, const Call& call);
Reply begin_jog(Api& api, const Call& call);
Reply keep_jog(Api& api, const Call& call);
Reply end_jog(Api& api, const Call& call);
Reply guided_path(Api& api, const Call& call);
Reply write_guided_path(Api& api, const Call& call);
Reply calibration(Api& api, const Call& call);
Reply take_calibration_point(Api& api, const Call& call);
Reply drop_calibration_point(Api& api, const Call& call);
Reply accept_calibration(Api& api, const Call& call);
Reply renew_lease(Api& api, const Call& call);
Reply end_lease(Api& api, const Call& call);
Reply set_lock(Api& api, const Call& call);
Reply start_module(Api& api, const Call& call);
Reply stop_module(Api& api, const Call& call);
Reply restart_module(Api& api, const Call& call);

}  // namespace answers

// Returns the board that the path names, or the reply that says why there is none.
Result<Board*, Reply> board_of(const Call& call);
// Returns a JSON object with the board's name in "board".
base::Json about(const Board& board);
// Returns a JSON array of these numbers.
base::Json list_of(const auto& numbers) {
  base::Json list = base::Json::array();
  for (const double number : numbers) {
    list.push_back(number);
  }
  return list;
}
// Returns a number of the query, or `usual` if the query does not have it; nothing if it is not a number or not in
// least..most.
std::optional<std::uint64_t> query_number(const Call& call, std::string_view name, std::uint64_t usual,
                                          std::uint64_t least, std::uint64_t most);

}  // namespace indurop::serve
