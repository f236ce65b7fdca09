// SPDX-License-Identifier: Apache-2.0
#include "mirror/frames/mirrored_variables.h"

#include <algorithm>
#include <cstring>

#include "vars/store.h"

namespace indurop::mirror {

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
    const bool never = confirmed == abi::kNeverConfirmed;
    const std::int64_t age =
        never ? -1 : std::max<std::int64_t>(0, rt::to_ns(now) - (confirmed < 0 ? -confirmed : confirmed));
    variables.push_back({variable.name, std::string(owner, ::strnlen(owner, kBoardName)), age,
                         confirmed > 0 && (variable.maxage_ns == 0 || age <= variable.maxage_ns)});
  }
  return variables;
}

}  // namespace indurop::mirror
