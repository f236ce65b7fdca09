// SPDX-License-Identifier: Apache-2.0
#include "network/dds/endpoint.h"

#include <algorithm>

namespace indurop::dds {
namespace {

template <class Create>
Endpoint make(Handle participant, const TypeDescriptor& type, const std::string& name, Create create) {
  Entity topic(dds_create_topic(participant, &type, name.c_str(), nullptr, nullptr));
  if (!topic.ok()) {
    return {std::move(topic), {}};
  }
  Entity end(create(topic.get()));
  return {std::move(topic), std::move(end)};
}

}  // namespace

Qos make_qos(const QosChoice& choice) {
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), choice.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       choice.block_ns);
  dds_qset_durability(qos.get(), choice.for_late_ones ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), choice.depth > 0 ? DDS_HISTORY_KEEP_LAST : DDS_HISTORY_KEEP_ALL, choice.depth);
  if (choice.lease_ns > 0) {
    dds_qset_liveliness(qos.get(), choice.written ? DDS_LIVELINESS_MANUAL_BY_TOPIC : DDS_LIVELINESS_AUTOMATIC,
                        choice.lease_ns);
  }
  dds_qset_writer_data_lifecycle(qos.get(), choice.dispose_at_end);
  if (!choice.mark.empty()) {
    dds_qset_userdata(qos.get(), choice.mark.data(), choice.mark.size());
  }
  if (!choice.partitions.empty()) {
    std::vector<const char*> names;
    for (const std::string& name : choice.partitions) {
      names.push_back(name.c_str());
    }
    dds_qset_partition(qos.get(), static_cast<std::uint32_t>(names.size()), names.data());
  }
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  return qos;
}

Listener data_listener(void (*call)(Handle reader, void* argument), void* argument) {
  Listener listener(dds_create_listener(argument));
  dds_lset_data_available(listener.get(), call);
  return listener;
}

Listener wake_listener(rt::SignalWord& word) {
  return data_listener([](Handle /*reader*/, void* of) { static_cast<rt::SignalWord*>(of)->wake(); }, &word);
}

Endpoint make_writer(Handle participant, const TypeDescriptor& type, const std::string& topic, const Qos& qos,
                     const Listener& listener) {
  return make(participant, type, topic,
              [&](Handle made) { return dds_create_writer(participant, made, qos.get(), listener.get()); });
}

Endpoint make_reader(Handle participant, const TypeDescriptor& type, const std::string& topic, const Qos& qos,
                     const Listener& listener) {
  return make(participant, type, topic,
              [&](Handle made) { return dds_create_reader(participant, made, qos.get(), listener.get()); });
}

int matched_writers(Handle reader) noexcept {
  return static_cast<int>(std::max<dds_return_t>(0, dds_get_matched_publications(reader, nullptr, 0)));
}

}  // namespace indurop::dds
