// SPDX-License-Identifier: Apache-2.0
// One variable as a topic: publishes changes while the topic has a reader, and accepts values that are written from
// outside.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/rt/signal_word.h"
#include "core/schema/schema.h"
#include "network/dds/endpoint.h"
#include "network/mirror/external/external_block.h"
#include "network/mirror/external/external_settings.h"
#include "network/mirror/external/own_lead.h"
#include "network/mirror/external/topic_events.h"
#include "store/vars/custody.h"
#include "store/vars/store.h"

namespace indurop::mirror {

// All methods run in one thread.
class ExternalTopic {
 public:
  // The variable must be in the store. `ros2`: names of ROS 2. `custody`: the lock that applies to tools, may be null.
  // `wake` is signalled when data arrives from outside.
  ExternalTopic(vars::Store& store, const vars::DirectoryEntry& entry, const Exported& exported, bool ros2,
                ExternalBlock& block, rt::SignalWord& wake, const MirrorBlock* plant, const vars::Custody* custody);
  ExternalTopic(const ExternalTopic&) = delete;
  ExternalTopic& operator=(const ExternalTopic&) = delete;

  // Creates the missing writer and, for a writable variable, the missing reader.
  Result<void, base::Problem> open(dds::Handle participant);
  // Creates only the reader; the writer is created when a client requests to read.
  Result<void, base::Problem> open_reader(dds::Handle participant);
  [[nodiscard]] bool is_open() const noexcept { return writer_.ok(); }
  void close() noexcept;

  // Checks whether this board's value is the one that counts. Returns true if that has changed.
  bool update_lead(std::int64_t now_ns) noexcept;
  [[nodiscard]] bool leads() const noexcept { return lead_.ours(); }
  // Publishes if it is due, there is a reason to, and this board leads. Returns when to call again at the latest.
  std::int64_t publish(std::int64_t now_ns) noexcept;
  // Writes the newest value from outside to the store.
  void receive() noexcept;
  // Returns the listeners' findings since the last call; empty: none.
  std::string complaint();

  [[nodiscard]] const schema::Variable& variable() const;
  [[nodiscard]] bool is_writable() const noexcept { return writable_; }
  [[nodiscard]] const std::string& topic_name() const noexcept { return topic_name_; }
  [[nodiscard]] bool is_read() const noexcept { return events_.readers() > 0; }
  [[nodiscard]] std::int64_t every_ns() const noexcept { return every_ns_; }

 private:
  bool refresh() noexcept;
  bool write(std::int64_t now_ns) noexcept;
  void take_over(const std::uint8_t* sample, bool by_tool) noexcept;
  [[nodiscard]] std::string locked() const;

  vars::Store& store_;
  const vars::DirectoryEntry& entry_;
  const abi::RingHeader* ring_ = nullptr;  // null: scalar
  std::string ros_type_;                   // empty: the names of the .idl
  const dds::TypeDescriptor type_;
  const vars::Custody* custody_;  // null: nothing is ever locked
  ExternalBlock& block_;
  std::string topic_name_;
  bool writable_;
  Lead lead_;
  bool texts_;
  std::int64_t every_ns_;

  TopicEvents events_;  // of both endpoints, which are closed first
  dds::Endpoint writer_;
  dds::Endpoint reader_;
  std::vector<std::uint8_t> sent_;     // the value published last
  std::vector<std::uint8_t> scratch_;  // of the same size
  std::uint64_t seen_ = ~std::uint64_t{0};
  int known_readers_ = 0;
  std::int64_t due_ns_ = 0;
  std::int64_t repeat_ns_ = 0;  // 0: no repetition
  bool again_ = true;           // publish although nothing changed
  std::string refusal_;
};

}  // namespace indurop::mirror
