// SPDX-License-Identifier: Apache-2.0
#include "node/modules/failsafe.h"

#include "core/schema/place_index.h"

namespace indurop::node {

FailSafe::FailSafe(vars::Store& store, const config::Config& config) : store_(store), writes_(config.modules.size()) {
  const schema::PlaceIndex index(store.schema());
  for (std::size_t i = 0; i < config.modules.size(); ++i) {
    for (const config::FailSafe& declared : config.modules[i].failsafe) {
      const auto place = index.find(declared.variable, schema::NearestName::Skip);
      if (!place) {
        continue;
      }
      Write write{store.find(place.value().variable->name_hash()), place.value().offset, {}};
      write.bytes.resize(place.value().type.size());
      if (write.variable != nullptr && schema::parse_value(place.value().type, declared.value, write.bytes)) {
        writes_[i].push_back(std::move(write));
      }
    }
  }
}

void FailSafe::apply(std::size_t module) noexcept {
  for (const Write& write : writes_[module]) {
    (void)store_.write(*write.variable, write.offset, write.bytes);  // a lock held too long is counted as lost write
  }
}

}  // namespace indurop::node
