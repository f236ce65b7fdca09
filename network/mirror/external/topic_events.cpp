// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/external/topic_events.h"

#include <utility>

namespace indurop::mirror {

dds::Listener TopicEvents::listener() {
  return dds::endpoint_listener<&TopicEvents::data_came, &TopicEvents::readers_changed, &TopicEvents::disagreed>(*this);
}

void TopicEvents::data_came() noexcept {
  if (!arrived_.exchange(true, std::memory_order_acq_rel)) {
    wake_.wake();
  }
}

std::uint32_t TopicEvents::take_disagreements() noexcept {
  const std::uint32_t all = disagreements_.load(std::memory_order_relaxed);
  return all - std::exchange(reported_, all);
}

}  // namespace indurop::mirror
