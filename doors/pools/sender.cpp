// SPDX-License-Identifier: Apache-2.0
#include "doors/pools/sender.h"

#include <fmt/format.h>
#include <indurop/idl/pool.h>

#include <algorithm>
#include <random>
#include <utility>

#include "doors/pools/part.h"
#include "network/dds/lent.h"

namespace indurop::pool_door {
namespace {

using std::chrono::milliseconds;

static_assert(kPartBytes == indurop_pool_PART_BYTES);

// How often the pool is searched for a new chunk: no process is notified of one.
constexpr milliseconds kLook{1};
constexpr milliseconds kCheckPool{100};
// A part that the network does not accept for this time ends its chunk.
constexpr milliseconds kPartPatience{500};

std::uint64_t random_session() {
  std::random_device random;
  return std::uint64_t{random()} << 32U | random();
}

}  // namespace

std::string topic_of(std::string_view pool) {
  std::string topic;
  for (std::size_t i = 0; i < pool.size(); ++i) {
    const bool separates = pool.substr(i, 2) == "::";
    topic += separates ? '/' : pool[i];
    i += separates ? 1 : 0;
  }
  return topic;
}

std::string partition_of(std::string_view plant) {
  return "indurop/" + std::string(plant);
}

Sender::Sender(std::string node, std::string pool, std::chrono::nanoseconds least, const base::Log& log)
    : pool_(std::move(node), std::move(pool)), least_(least), log_(log), topic_(topic_of(pool_.name())) {
  wake_.init(false);
}

Result<void, base::Problem> Sender::open(dds::Handle participant, const std::string& plant) {
  dds::QosChoice choice;
  if (!plant.empty()) {
    choice.partitions = {"", partition_of(plant)};  // tools need no partition
  }
  choice.for_late_ones = false;
  choice.depth = 0;  // in_flight limits what is kept; with a limit by number, a writer overtakes its readers
  choice.block_ns = std::chrono::nanoseconds(kPartPatience).count();
  writer_ =
      dds::make_writer(participant, indurop_pool_Part_desc, topic_, dds::make_qos(choice),
                       dds::endpoint_listener<&Sender::data_came, &Sender::readers_changed, &Sender::disagreed>(*this));
  if (writer_.forbidden()) {
    return base::Problem{fmt::format(
        "these keys do not permit to publish {}: indurop keys add --tool NAME --write '{}'", topic_, pool_.name())};
  }
  return writer_.ok() ? Result<void, base::Problem>()
                      : base::Problem{fmt::format("DDS refuses the topic {}: {}", topic_, writer_.why())};
}

void Sender::readers_changed(int readers) noexcept {
  if (readers > counts_.readers.exchange(readers)) {
    has_new_reader_.store(true);
  }
  wake_.wake();
}

void Sender::disagreed() noexcept {
  disagrees_.store(true);
  wake_.wake();
}

void Sender::follow_pool() {
  const rt::MonoTime now = rt::MonoClock::now();
  if (now < next_check_) {
    return;
  }
  next_check_ = now + kCheckPool;
  if (disagrees_.exchange(false)) {
    log_.warning("{}: a participant has another type for this topic, or requests a QoS that is not offered", topic_);
  }
  if (pool_.entered() && pool_.is_current()) {
    return;
  }
  pool_.leave();
  if (!pool_.enter(log_)) {
    return;
  }
  session_ = random_session();  // numbers may begin again
  last_ = 0;
  log_.info("sends {} of node {} as topic {}", pool_.name(), pool_.node(), topic_);
}

void Sender::count_passed_over(std::uint64_t number) {
  if (last_ == 0) {
    return;
  }
  // Those that were published while the last one was being sent, all but the newest of them, would have been too late.
  const std::uint64_t too_late = newest_ > last_ ? newest_ - last_ - 1 : 0;
  const std::uint64_t passed_over = number - last_ - 1;
  const bool has_rate = least_.count() > 0;
  counts_.superseded += has_rate ? std::min(too_late, passed_over) : passed_over;
  counts_.by_rate += has_rate ? passed_over - std::min(too_late, passed_over) : 0;
}

bool Sender::send(const pools::Held& held, const std::atomic<bool>& stop) {
  const std::int64_t age_ns = (pool_.now() - pool_.time_of(held.chunk)).count();
  const std::byte* const data = pool_.data(held.chunk);
  indurop_pool_Part part{};
  part.pool = dds::lent(pool_.name());
  part.type = dds::lent(pool_.type());
  part.type_hash = pool_.shape().type_hash;
  part.node = dds::lent(pool_.node());
  part.session = session_;
  part.number = held.number;
  part.published_ns = rt::wall_ns() - age_ns;
  part.size = pool_.shape().chunk_bytes;
  for (part.offset = 0; part.offset < part.size; part.offset += kPartBytes) {
    const auto bytes = static_cast<std::uint32_t>(part_bytes(part.size, part.offset));
    part.data._buffer = dds::lent(reinterpret_cast<const std::uint8_t*>(data + part.offset));
    part.data._length = bytes;
    part.data._maximum = bytes;
    if (stop.load() || counts_.readers.load() == 0 || !dds::write(writer_.get(), part).ok()) {
      return false;
    }
  }
  return true;
}

void Sender::send_newest(const std::atomic<bool>& stop) {
  const rt::MonoTime begin = rt::MonoClock::now();
  const auto held = pool_.latest();
  if (!held) {
    return;
  }
  // Who joins gets the newest chunk, however old it is; others have it already.
  const bool is_new = held->number > last_;
  const bool has_new_reader = has_new_reader_.exchange(false);
  if (!is_new && !has_new_reader) {
    pool_.release(*held);
    return;
  }
  if (is_new) {
    count_passed_over(held->number);
  }
  const bool whole = send(*held, stop);
  pool_.release(*held);
  counts_.sent += whole ? 1 : 0;
  counts_.bytes += whole ? pool_.shape().chunk_bytes : 0;
  counts_.abandoned += whole ? 0 : 1;
  last_ = held->number;
  next_chunk_ = begin + least_;
  newest_ = last_;
  if (const auto after = pool_.latest()) {
    newest_ = after->number;
    pool_.release(*after);
  }
}

void Sender::run(const std::atomic<bool>& stop) {
  while (!stop.load()) {
    follow_pool();
    if (!pool_.entered() || counts_.readers.load() == 0) {
      last_ = 0;  // without a reader, nothing is dropped
      (void)wake_.wait_until(next_check_);
      continue;
    }
    if (rt::MonoClock::now() >= next_chunk_) {
      send_newest(stop);
    }
    (void)wake_.wait_until(std::min(std::max(rt::MonoClock::now() + kLook, next_chunk_), next_check_));
  }
  pool_.leave();
}

}  // namespace indurop::pool_door
