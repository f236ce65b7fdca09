// SPDX-License-Identifier: Apache-2.0
// Publishes the chunks of a local pool as a DDS topic while it has readers. Reads them in place, always the newest one:
// nothing is queued here.

#pragma once

#include <indurop/result.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/log.h"
#include "core/base/problem.h"
#include "core/rt/signal_word.h"
#include "doors/pools/counts.h"
#include "doors/pools/local_pool.h"
#include "network/dds/endpoint.h"

namespace indurop::pool_door {

// "cell::Vision::camera" has the topic "cell/Vision/camera", as variables have (docs/external.md).
std::string topic_of(std::string_view pool);
// DDS partition of the pools of a plant.
std::string partition_of(std::string_view plant);

class Sender {
 public:
  // `least`: time from the beginning of a chunk to that of the next one; 0: each chunk as soon as possible.
  Sender(std::string node, std::string pool, std::chrono::nanoseconds least, const base::Log& log);
  Sender(const Sender&) = delete;
  Sender& operator=(const Sender&) = delete;
  ~Sender() = default;

  // `plant`: plant whose receivers get the chunks, besides tools; empty: every receiver without a plant. Errors:
  // DDS refuses the topic, or the keys do not permit it.
  Result<void, base::Problem> open(dds::Handle participant, const std::string& plant);
  // Sends until `stop` is set; wake() ends its waits.
  void run(const std::atomic<bool>& stop);
  void wake() noexcept { wake_.wake(); }

  [[nodiscard]] const std::string& pool() const noexcept { return pool_.name(); }
  [[nodiscard]] const SendCounts& counts() const noexcept { return counts_; }

  // Called by DDS.
  void data_came() noexcept {}
  void readers_changed(int readers) noexcept;
  void disagreed() noexcept;

 private:
  void follow_pool();
  void send_newest(const std::atomic<bool>& stop);
  bool send(const pools::Held& held, const std::atomic<bool>& stop);
  void count_passed_over(std::uint64_t number);

  rt::SignalWord wake_{};
  LocalPool pool_;
  std::chrono::nanoseconds least_;
  base::Log log_;
  std::string topic_;
  rt::MonoTime next_check_{};
  rt::MonoTime next_chunk_{};
  std::uint64_t session_ = 0;
  std::uint64_t last_ = 0;    // number of the chunk sent last; 0: none for these readers
  std::uint64_t newest_ = 0;  // number of the newest one when that had been sent
  SendCounts counts_;
  std::atomic<bool> has_new_reader_{false};
  std::atomic<bool> disagrees_{false};
  dds::Endpoint writer_;  // its listener uses all of the above
};

}  // namespace indurop::pool_door
