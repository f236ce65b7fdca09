// SPDX-License-Identifier: Apache-2.0
// Receives the chunks of a pool of another board into the pool of the same name of a local node. Chunks are filled in
// place and become visible when they are complete.

#pragma once

#include <indurop/idl/pool.h>
#include <indurop/result.h>

#include <atomic>
#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "core/base/log.h"
#include "core/base/problem.h"
#include "core/rt/signal_word.h"
#include "doors/pools/assembler.h"
#include "doors/pools/counts.h"
#include "doors/pools/local_pool.h"
#include "network/dds/endpoint.h"

namespace indurop::pool_door {

class Receiver final : private ChunkPlaces {
 public:
  Receiver(std::string node, std::string pool, const base::Log& log);
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;
  ~Receiver() override = default;

  // `plant`: plant whose senders are received; empty: every sender. Errors:
  // DDS refuses the topic, or the keys do not permit it.
  Result<void, base::Problem> open(dds::Handle participant, const std::string& plant);
  // Receives until `stop` is set; wake() ends its waits.
  void run(const std::atomic<bool>& stop);
  void wake() noexcept { wake_.wake(); }

  [[nodiscard]] const std::string& pool() const noexcept { return pool_.name(); }
  [[nodiscard]] const ReceiveCounts& counts() const noexcept { return counts_; }

 private:
  std::optional<Place> take() override;
  void publish(const Place& place, std::int64_t published_ns) override;
  void discard(const Place& place) override;

  void follow_pool();
  void leave_pool();
  void accept(const indurop_pool_Part& part);
  bool has_our_type(const indurop_pool_Part& part);
  void show_counts();

  rt::SignalWord wake_{};
  LocalPool pool_;
  base::Log log_;
  std::string topic_;
  rt::MonoTime next_check_{};
  std::optional<Assembler> assembler_;  // while the pool is entered
  AssemblyCounts before_;               // of earlier ones
  std::set<std::uint64_t> refused_;     // sessions of another type that were reported
  bool clocks_reported_ = false;
  ReceiveCounts counts_;
  dds::Endpoint reader_;  // its listener uses all of the above
};

}  // namespace indurop::pool_door
