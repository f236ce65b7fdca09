// SPDX-License-Identifier: Apache-2.0
#include "node/parts/facts_part.h"

#include "core/rt/clock.h"
#include "history/explain/facts_json.h"
#include "history/explain/kernel_log.h"
#include "history/explain/run_facts.h"
#include "store/operate/journal.h"

namespace indurop::node {

std::string facts_text(const Options& options, const Prepared& prepared, const mirror::MirrorBlock* boards,
                       const std::string& stop_reason) {
  explain::Facts facts = explain::facts_of(prepared.run(), prepared.run().total_size, false);
  if (boards != nullptr) {
    explain::add_boards(*boards, facts);
  }
  const bool simulated = options.simulation.on;
  if (!simulated) {
    explain::add_kernel(options.node, facts);
  }
  facts.orders = operate::read_orders(options.node, prepared.run().started_wall_ns);
  facts.board = options.board;
  facts.stop_reason = stop_reason;
  facts.now_ns = rt::to_ns(prepared.store->now());
  facts.wall_minus_node_ns = simulated ? 0 : rt::wall_ns() - facts.now_ns;
  return explain::facts_text(facts);
}

}  // namespace indurop::node
