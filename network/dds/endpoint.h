// SPDX-License-Identifier: Apache-2.0
// A DDS reader or writer with its topic: both are deleted with their holder, so that a peer that comes and goes leaves
// nothing behind. All QoS are made here.

#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/rt/signal_word.h"
#include "network/dds/entity.h"

namespace indurop::dds {

struct QosDelete {
  void operator()(dds_qos_t* qos) const noexcept { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDelete>;

struct QosChoice {
  bool reliable = true;
  std::int64_t block_ns = 0;  // maximum time that a reliable writer waits for space
  bool for_late_ones = true;  // late joiners get the samples that are kept
  std::int32_t depth = 1;  // samples kept per key; 0: all, and a reliable writer waits until readers have some of them
  std::int64_t lease_ns = 0;  // a writer silent for this time is considered lost; 0: as long as its participant lives
  bool written = false;  // silent is who writes nothing, even if DDS answers for it; it is alive again with a sample
  bool dispose_at_end = false;  // values of a writer that leaves are disposed, not only no longer alive
  std::string_view mark = {};   // mark of the writer that readers can check, see is_marked()
  // DDS partitions: an end is matched only with ends that share one. "" is that of ends without a partition.
  std::vector<std::string> partitions = {};
};
Qos make_qos(const QosChoice& choice);

struct ListenerDelete {
  void operator()(dds_listener_t* listener) const noexcept { dds_delete_listener(listener); }
};
using Listener = std::unique_ptr<dds_listener_t, ListenerDelete>;
// Makes a listener. Listeners are called by DDS's own threads; their argument must outlive the owner of the listener. A
// reader may be called before its creator has stored it: hence the handle as an argument.
Listener data_listener(void (*call)(Handle reader, void* argument), void* argument);
// Wakes `word` when data arrives.
Listener wake_listener(rt::SignalWord& word);
// A listener for both ends of a topic. It calls members of `self`: one without arguments when data arrives, one with
// the number of readers when that changes, and one without arguments when another participant has another type or
// requests a QoS that is not offered.
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
  // Returns true if the keys of this participant do not permit it.
  [[nodiscard]] bool forbidden() const noexcept { return topic_.forbidden() || end_.forbidden(); }
  // Waits for running listener calls.
  void reset() noexcept {
    end_.reset();
    topic_.reset();
  }

 private:
  Entity topic_;
  Entity end_;  // deleted first
};

// The result is not ok() if DDS refuses; why() returns the reason. `listener` may be null and is copied.
Endpoint make_writer(Handle participant, const TypeDescriptor& type, const std::string& topic, const Qos& qos,
                     const Listener& listener = nullptr);
Endpoint make_reader(Handle participant, const TypeDescriptor& type, const std::string& topic, const Qos& qos,
                     const Listener& listener = nullptr);

// Returns how many writers a reader is matched with now.
int matched_writers(Handle reader) noexcept;

}  // namespace indurop::dds
