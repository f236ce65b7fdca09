// SPDX-License-Identifier: Apache-2.0
#include "tools/client/node/mirror_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "core/rt/clock.h"
#include "core/rt/relaxed.h"
#include "network/mirror/frames/mirror_block.h"
#include "store/vars/shm_file.h"
#include "tools/client/node/run_view.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kJustNowNs = 250'000'000;  // running boards confirm their values more often

PeerView view_peer(const mirror::PeerRecord& record, std::int64_t now) {
  using rt::kRelaxed;
  const std::int64_t heard = record.heard_ns.load(kRelaxed);
  return {.name = fixed_text(record.name),
          .state = mirror::to_text(record.state.load(kRelaxed)),
          .problem = record.problem.get(),
          .wanted = record.wanted,
          .heard_ns = heard == 0 ? -1 : std::max<std::int64_t>(0, now - heard),
          .frames = record.frames.load(kRelaxed),
          .lost_updates = record.lost_updates.load(kRelaxed),
          .refused = record.refused.load(kRelaxed),
          .losses = record.losses.load(kRelaxed),
          .delay_ns = record.delay_ns.load(kRelaxed),
          .tick = record.tick.load(kRelaxed),
          .clock_known = record.clock_known.load(std::memory_order_acquire) != 0,
          .clock_offset_ns = record.clock_offset_ns.load(kRelaxed),
          .clock_bound_ns = record.clock_bound_ns.load(kRelaxed),
          .clock_synchronised = record.clock_synchronised.load(kRelaxed) != 0,
          .epoch_wall_ns = record.epoch_wall_ns.load(kRelaxed)};
}

}  // namespace

std::optional<MirrorView> view_mirror(const std::string& node) {
  const auto file = vars::ShmCopy::of(vars::mirror_file(node));
  const mirror::MirrorBlock* block =
      file ? mirror::mirror_block_in({file.value().data(), file.value().size()}) : nullptr;
  if (block == nullptr) {
    return std::nullopt;
  }
  const std::int64_t now = rt::now_ns();
  using rt::kRelaxed;
  const std::uint32_t peers = block->peer_count;
  MirrorView view{.plant = fixed_text(block->plant),
                  .board = fixed_text(block->board),
                  .domain = block->domain,
                  .up = block->network.load(kRelaxed) == mirror::Network::Up,
                  .problem = block->problem.get(),
                  .outgoing = block->outgoing,
                  .parts = block->parts,
                  .frames = block->frames.load(kRelaxed),
                  .bytes = block->bytes.load(kRelaxed),
                  .send_errors = block->send_errors.load(kRelaxed),
                  .cycle_ns = block->cycle_ns.load(kRelaxed),
                  .cycle_max_ns = block->cycle_max_ns.load(kRelaxed),
                  .clock_synchronised = block->clock_synchronised.load(kRelaxed) != 0,
                  .clock_error_ns = block->clock_error_ns.load(kRelaxed),
                  .epoch_wall_ns = block->epoch_wall_ns.load(kRelaxed),
                  .peers = {},
                  .variables = mirror::mirrored_variables(node, *block, rt::mono_time(now))};
  for (std::uint32_t i = 0; i < peers; ++i) {
    view.peers.push_back(view_peer(block->peers()[i], now));
  }
  return view;
}

std::vector<std::string> explain_old(const MirrorView& view, const std::set<std::string>& variables) {
  std::map<std::string, std::string> leaders;  // by variable
  for (const mirror::MirroredVariable& one : view.variables) {
    if (one.leads) {
      leaders[one.name] = one.owner;
    }
  }
  std::vector<std::string> lines;
  for (const PeerView& peer : view.peers) {
    const bool silent = peer.state != "alive";
    if (!silent && peer.heard_ns < kJustNowNs) {
      continue;
    }
    std::string old;
    std::map<std::string, std::string> taken_over;  // names by the board that leads now
    for (const mirror::MirroredVariable& one : view.variables) {
      if (one.owner == peer.name && variables.contains(one.name)) {
        const auto leader = leaders.find(one.name);
        std::string& names = leader == leaders.end() || leader->second == peer.name ? old : taken_over[leader->second];
        names += (names.empty() ? "" : ", ") + one.name;
      }
    }
    const std::string heard = peer.heard_ns < 0 ? "never heard" : "last heard " + human_age(peer.heard_ns) + " ago";
    if (!old.empty()) {
      lines.push_back(silent ? fmt::format("board {} is {} ({}): its last values, or their fallback: {}", peer.name,
                                           peer.state, heard, old)
                             : fmt::format("board {} was {}, and counts as there until its plant's lease is over: its "
                                           "last values: {}",
                                           peer.name, heard, old));
    }
    for (const auto& [leader, names] : taken_over) {
      lines.push_back(fmt::format("board {} is {} ({}): its standby {} leads, with values of now: {}", peer.name,
                                  peer.state, heard, leader, names));
    }
  }
  return lines;
}

JsonValue json_of(const std::vector<mirror::MirroredVariable>& variables) {
  JsonValue all = JsonValue::array();
  for (const mirror::MirroredVariable& variable : variables) {
    all.push_back({{"name", variable.name},
                   {"owner", variable.owner},
                   {"age_ns", variable.age_ns < 0 ? JsonValue() : JsonValue(variable.age_ns)},
                   {"valid", variable.valid},
                   {"leads", variable.leads}});
  }
  return all;
}

JsonValue json_of(const MirrorView& view) {
  JsonValue peers = JsonValue::array();
  for (const PeerView& peer : view.peers) {
    peers.push_back({{"board", peer.name},
                     {"state", peer.state},
                     {"problem", peer.problem},
                     {"variables", peer.wanted},
                     {"heard_ns", peer.heard_ns < 0 ? JsonValue() : JsonValue(peer.heard_ns)},
                     {"tick", peer.tick},
                     {"delay_ns", peer.delay_ns},
                     {"frames", peer.frames},
                     {"lost_updates", peer.lost_updates},
                     {"refused", peer.refused},
                     {"losses", peer.losses},
                     {"clock_offset_ns", peer.clock_known ? JsonValue(peer.clock_offset_ns) : JsonValue()},
                     {"clock_bound_ns", peer.clock_known ? JsonValue(peer.clock_bound_ns) : JsonValue()},
                     {"clock_synchronised", peer.clock_synchronised},
                     {"epoch_wall_ns", peer.epoch_wall_ns}});
  }
  return {{"plant", view.plant},
          {"board", view.board},
          {"domain", view.domain},
          {"in_network", view.up},
          {"problem", view.problem},
          {"outgoing", view.outgoing},
          {"frames", view.frames},
          {"bytes", view.bytes},
          {"send_errors", view.send_errors},
          {"cycle_ns", view.cycle_ns},
          {"cycle_max_ns", view.cycle_max_ns},
          {"clock_synchronised", view.clock_synchronised},
          {"clock_error_ns", view.clock_error_ns},
          {"epoch_wall_ns", view.epoch_wall_ns},
          {"boards", peers},
          {"variables", json_of(view.variables)}};
}

}  // namespace indurop::tools
