// SPDX-License-Identifier: Apache-2.0
// The metrics of all boards, for Prometheus.
#include "tools/serve/api/answers.h"
#include "tools/serve/boards/boards.h"
#include "tools/serve/metrics/board_metrics.h"

namespace indurop::serve::answers {

Reply metrics(Api& api, const Call& call) {
  Exposition out;
  out.add(Metric::ServerInfo, {{"version", api.facts().version}}, std::uint64_t{1});
  for (const std::string& name : call.boards->names()) {
    if (const Board* const board = call.boards->find(name)) {
      const auto reported = board->reported_alarms();
      add_board(out, *board, reported ? *reported : api.facts().alarms(name), api.facts().metrics);
    }
  }
  Reply reply;
  reply.type = "text/plain; version=0.0.4; charset=utf-8";
  reply.body = out.text();
  return reply;
}

}  // namespace indurop::serve::answers
