// SPDX-License-Identifier: Apache-2.0
// A DDS reader or writer with the topic it was made for: both are deleted with their holder, so that a peer that comes
// and goes leaves nothing behind. The one place that makes a QoS.

#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "dds/entity.h"
#include "rt/signal_word.h"

namespace indurop::dds {

struct QosDelete {
  void operator()(dds_qos_t* qos) const noexcept { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDelete>;

struct QosChoice {
  bool reliable = true;
  std::int64_t block_ns = 0;    // a reliable writer waits so long for room
  bool for_late_ones = true;    // who joins late gets what is kept
  std::int32_t depth = 1;       // samples kept, of each key
  std::int64_t lease_ns = 0;    // a writer not heard for so long is taken for dead; 0: as long as its participant lives
  bool dispose_at_end = false;  // the values of a writer that leaves are gone, not only unconfirmed
  std::string_view mark = {};   // what readers find of the writer, see is_marked()
};
Qos make_qos(const QosChoice& choice);

struct ListenerDelete {
  void operator()(dds_listener_t* listener) const noexcept { dds_delete_listener(listener); }
};
using Listener = std::unique_ptr<dds_listener_t, ListenerDelete>;
// Listeners are called by DDS's own threads; what they are given outlives whatever has the listener. A reader may call
// before whoever makes it has it in hands: hence the handle.
Listener data_listener(void (*call)(Handle reader, void* argument), void* argument);
// Wakes `word` when something came.
Listener wake_listener(rt::SignalWord& word);
// For both ends of a topic: members of `self` without arguments when something came, with the number of readers when
// that changes, and without arguments when somebody has another type or wants a QoS that is not offered.
template <auto DataCame, auto ReadersChanged, auto Disagreed, class Self>
Listener endpoint_listener(Self& self) {
  Listener listener = data_listener([](Handle, void* of) { (static_cast<Self*>(of)->*DataCame)(); }, &self);
  dds_lset_publication_matched(listener.get(), [](Handle, const dds_publication_matched_status_t status, void* of) {
    (static_cast<Self*>(of)->*ReadersChanged)(static_cast<int>(status.current_count));
  });
  dds_lset_offered_incompatible_qos(listener.get(), [](Handle, const dds_offered_incompatible_qos_status_t, void* of) {
    (static_cast<Self*>(of)->*Disagreed)();
  });
  dds_lset_requested_incompatible_qos(listener.get(), [](Handle, const dds_requested_incompatible_qos_status_t,
                                                         void* of) { (static_cast<Self*>(of)->*Disagreed)(); });
  return listener;
}

class Endpoint {
 public:
  Endpoint() = default;
  Endpoint(Entity topic, Entity end) noexcept : topic_(std::move(topic)), end_(std::move(end)) {}

  [[nodiscard]] Handle get() const noexcept { return end_.get(); }
  [[nodiscard]] bool ok() const noexcept { return end_.ok(); }
  [[nodiscard]] std::string why() const { return topic_.ok() ? end_.why() : topic_.why(); }
  // The keys of this participant do not permit it.
  [[nodiscard]] bool forbidden() const noexcept { return topic_.forbidden() || end_.forbidden(); }
  // Waits for a listener that is running.
  void reset() noexcept {
    end_.reset();
    topic_.reset();
  }

 private:
  Entity topic_;
  Entity end_;  // deleted first
};

// Not ok() if DDS refuses; why() says the reason. `listener` may be null and is copied.
Endpoint make_writer(Handle participant, const TypeDescriptor& type, const std::string& topic, const Qos& qos,
                     const Listener& listener = nullptr);
Endpoint make_reader(Handle participant, const TypeDescriptor& type, const std::string& topic, const Qos& qos,
                     const Listener& listener = nullptr);

}  // namespace indurop::dds
