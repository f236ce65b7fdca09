// SPDX-License-Identifier: Apache-2.0
#include "doors/pools/receiver.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string_view>
#include <utility>

#include "core/base/printable.h"
#include "doors/pools/part.h"
#include "doors/pools/sender.h"

namespace indurop::pool_door {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kCheckPoolEvery{100};
// Parts that wait for this program: 16 MiB.
constexpr int kWaitingParts = 64;
// Senders of another type that are reported.
constexpr std::size_t kMostRefused = 16;
// Clocks that differ by more are reported: ages would be meaningless.
constexpr std::chrono::seconds kImplausibleAge{60};

Assembler::Time now_mono() noexcept {
  return rt::MonoClock::now().time_since_epoch();
}

std::string_view text_of(const char* text) noexcept {
  return text == nullptr ? std::string_view() : std::string_view(text);
}

}  // namespace

Receiver::Receiver(std::string node, std::string pool, const base::Log& log)
    : pool_(std::move(node), std::move(pool)), log_(log), topic_(topic_of(pool_.name())) {
  wake_.init(false);
}

Result<void, base::Problem> Receiver::open(dds::Handle participant, const std::string& plant) {
  dds::QosChoice choice;
  if (!plant.empty()) {
    choice.partitions = {partition_of(plant)};
  }
  choice.for_late_ones = false;
  choice.depth = kWaitingParts;
  reader_ =
      dds::make_reader(participant, indurop_pool_Part_desc, topic_, dds::make_qos(choice), dds::wake_listener(wake_));
  if (reader_.forbidden()) {
    return base::Problem{fmt::format("these keys do not permit to read {}: indurop keys add --tool NAME --read '{}'",
                                     topic_, pool_.name())};
  }
  return reader_.ok() ? Result<void, base::Problem>()
                      : base::Problem{fmt::format("DDS refuses the topic {}: {}", topic_, reader_.why())};
}

std::optional<ChunkPlaces::Place> Receiver::take() {
  const auto chunk = pool_.take();
  return chunk ? std::optional(Place{*chunk, pool_.data(*chunk)}) : std::nullopt;
}

// The age of a chunk goes on: what it was on the other board, and the way here, as far as both clocks agree.
void Receiver::publish(const Place& place, std::int64_t published_ns) {
  const std::chrono::nanoseconds age(rt::wall_ns() - published_ns);
  if (!clocks_reported_ && (age < -milliseconds(1) || age > kImplausibleAge)) {
    clocks_reported_ = true;
    log_.warning("a chunk of {} is {:.3f} s old by the clocks of both boards: if these differ, so does age()", topic_,
                 std::chrono::duration<double>(age).count());
  }
  pool_.publish(place.chunk, pool_.now() - std::max(age, std::chrono::nanoseconds(0)));
  counts_.bytes += pool_.shape().chunk_bytes;
}

void Receiver::discard(const Place& place) {
  pool_.discard(place.chunk);
}

void Receiver::leave_pool() {
  if (assembler_) {
    assembler_->give_up_all();
    const AssemblyCounts& counts = assembler_->counts();
    before_.complete += counts.complete;
    before_.incomplete += counts.incomplete;
    before_.no_place += counts.no_place;
    before_.malformed += counts.malformed;
  }
  assembler_.reset();
  pool_.leave();
}

void Receiver::follow_pool() {
  const rt::MonoTime now = rt::MonoClock::now();
  if (now < next_check_) {
    return;
  }
  next_check_ = now + kCheckPoolEvery;
  if (assembler_) {
    assembler_->give_up_silent(now_mono());
  }
  if (pool_.entered() && pool_.is_current()) {
    return;
  }
  leave_pool();
  if (!pool_.enter(log_)) {
    return;
  }
  refused_.clear();  // the node may have another type now
  assembler_.emplace(static_cast<ChunkPlaces&>(*this), pool_.shape().chunk_bytes);
  log_.info("receives topic {} into {} of node {}", topic_, pool_.name(), pool_.node());
}

bool Receiver::has_our_type(const indurop_pool_Part& part) {
  if (part.type_hash == pool_.shape().type_hash && part.size == pool_.shape().chunk_bytes) {
    return true;
  }
  counts_.refused += 1;
  if (refused_.size() < kMostRefused && refused_.insert(part.session).second) {
    log_.error(
        "{}: chunks of node '{}' have type {} (layout {:016x}, {} bytes), those of node '{}' have type {} (layout "
        "{:016x}, {} bytes); build the modules of both boards from the same .glb",
        topic_, base::printable(text_of(part.node)), base::printable(text_of(part.type)), part.type_hash, part.size,
        pool_.node(), pool_.type(), pool_.shape().type_hash, pool_.shape().chunk_bytes);
  }
  return false;
}

void Receiver::accept(const indurop_pool_Part& part) {
  if (!assembler_) {
    counts_.refused += 1;
    return;
  }
  if (has_our_type(part)) {
    assembler_->add({part.session,
                     part.number,
                     part.published_ns,
                     part.size,
                     part.offset,
                     {reinterpret_cast<const std::byte*>(part.data._buffer), part.data._length}},
                    now_mono());
  }
}

void Receiver::show_counts() {
  const AssemblyCounts now = assembler_ ? assembler_->counts() : AssemblyCounts{};
  counts_.received = before_.complete + now.complete;
  counts_.incomplete = before_.incomplete + now.incomplete;
  counts_.no_chunk = before_.no_place + now.no_place;
}

void Receiver::run(const std::atomic<bool>& stop) {
  while (!stop.load()) {
    follow_pool();
    dds::take_all<indurop_pool_Part>(reader_.get(), [this](const indurop_pool_Part& part, const dds::SampleInfo& info) {
      if (info.valid) {
        accept(part);
      }
    });
    counts_.senders.store(dds::matched_writers(reader_.get()));
    show_counts();
    (void)wake_.wait_until(next_check_);
  }
  leave_pool();
  show_counts();
}

}  // namespace indurop::pool_door
