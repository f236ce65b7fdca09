// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/mirrored_variables.h"

#include <indurop/detail/freshness.h>

#include <algorithm>
#include <cstring>

#include "store/vars/store.h"

namespace indurop::mirror {

namespace {

// Returns whether no other board that is alive and sends the variable has served longer (same rule as in landing.h).
bool leads(const MirrorBlock& block, const IncomingRecord& record) {
  const auto session = [&block](const IncomingRecord& of) {
    const PeerRecord& peer = block.peers()[of.peer];
    return peer.state.load() == PeerState::Alive ? peer.session.load() : 0;
  };
  const std::uint64_t own = session(record);
  for (std::uint32_t i = 0; own != 0 && i < block.incoming; ++i) {
    const IncomingRecord& other = block.variables()[i];
    if (other.name_hash == record.name_hash && other.peer < block.peer_count) {
      const std::uint64_t its = session(other);
      if (its != 0 && its < own) {
        return false;
      }
    }
  }
  return own != 0;
}

}  // namespace

std::vector<MirroredVariable> mirrored_variables(const std::string& node, const MirrorBlock& block, rt::MonoTime now) {
  std::vector<MirroredVariable> variables;
  const auto store = vars::Store::attach(node, vars::Mode::ReadOnly);
  const std::uint32_t peers = block.peer_count;
  const std::uint32_t incoming = block.incoming;
  for (std::uint32_t i = 0; store && i < incoming; ++i) {
    const IncomingRecord& record = block.variables()[i];
    const auto* entry = store.value().find(record.name_hash);
    if (entry == nullptr || record.peer >= peers) {
      continue;
    }
    const schema::Variable& variable = store.value().schema().variables[entry->schema_index];
    const char* owner = block.peers()[record.peer].name;
    const std::int64_t confirmed =
        abi::confirmed_of(store.value().entry(entry->name_hash, 0), entry->kind).load(std::memory_order_acquire);
    const auto now_ns = [now] { return rt::to_ns(now); };
    const std::int64_t age =
        confirmed == abi::kNeverConfirmed ? -1 : std::max<std::int64_t>(0, detail::age_of(confirmed, now_ns).count());
    variables.push_back({variable.name, std::string(owner, ::strnlen(owner, kBoardName)), age,
                         detail::is_valid(confirmed, variable.maxage_ns, now_ns), leads(block, record)});
  }
  return variables;
}

}  // namespace indurop::mirror
