// SPDX-License-Identifier: Apache-2.0
// One topic of the external plane, read and written with a type that only the network knows.

#pragma once

#include <dds/dds.h>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "mirror/entity.h"
#include "mirror/plain_type.h"
#include "rt/signal_word.h"

namespace indurop::mirror {

using Guid = std::array<std::uint8_t, 16>;
Guid guid_of(const dds_guid_t& guid);
// Of the participant behind a matched publication of a reader.
std::optional<Guid> participant_of(dds_entity_t reader, dds_instance_handle_t publication);

class FarTopic {
 public:
  FarTopic() = default;
  FarTopic(const FarTopic&) = delete;
  FarTopic& operator=(const FarTopic&) = delete;
  ~FarTopic();

  // Reads what `publication` publishes, under its own QoS. False: its type cannot be had now. `wake` is woken by
  // values.
  bool open(dds_entity_t participant, dds_builtintopic_endpoint_t& publication, rt::SignalWord& wake);
  // The same where no type is told: the topic has that of `variable` under the name that it has in ROS 2.
  bool open_ros(dds_entity_t participant, dds_builtintopic_endpoint_t& publication, const schema::Variable& variable,
                rt::SignalWord& wake);
  [[nodiscard]] bool is_open() const noexcept { return reader_.ok(); }
  void close() noexcept;

  // Values that have come, with the participant they are from.
  void take(const std::function<void(const Guid& from, std::span<const std::uint8_t> value)>& use);
  // False while this participant does not listen (yet).
  bool send(dds_entity_t participant, const Guid& to, std::span<const std::uint8_t> value);

 private:
  bool read(dds_entity_t participant, const dds_builtintopic_endpoint_t& publication,
            const dds_topic_descriptor_t& type, rt::SignalWord& wake);

  dds_topic_descriptor_t* told_ = nullptr;  // the type as the network tells it, or
  std::optional<PlainType> known_;          // as a board does
  std::size_t size_ = 0;                    // of a sample
  Entity topic_;
  Entity reader_;
  Entity writer_;
  std::map<dds_instance_handle_t, Guid> senders_;  // participants by publication
};

}  // namespace indurop::mirror
