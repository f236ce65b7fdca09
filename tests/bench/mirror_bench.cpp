// SPDX-License-Identifier: Apache-2.0
// One end of a mirror: `mirror_bench write|alone|read DOMAIN SECONDS BYTES COUNT`; `alone` writes without a mirror. The
// writer changes COUNT variables of BYTES bytes every millisecond; the first word of each is the time of its write,
// CLOCK_MONOTONIC, which the namespaces of one machine share. The reader compares it with the time the value was taken
// over. Prints one line of JSON.

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "core/rt/clock.h"
#include "core/rt/thread.h"
#include "network/mirror/frames/mirror.h"
#include "network/mirror/frames/mirror_block.h"
#include "store/vars/shm_file.h"
#include "store/vars/store.h"

namespace {

using namespace indurop;  // NOLINT

constexpr std::int64_t kTickNs = 1'000'000;

schema::Schema make_schema(std::uint32_t bytes, int count) {
  schema::Schema schema;
  for (int i = 0; i < count; ++i) {
    schema::Variable v;
    v.name = "bench::v" + std::to_string(i);
    v.type.base = schema::Base::Int64;
    v.type.element_size = v.type.align = 8;
    v.type.dims = {bytes / 8};
    v.kind = abi::Kind::Ring;
    v.type_hash = schema::hash_of(v.type);
    schema.variables.push_back(v);
  }
  return schema;
}

mirror::Settings make_settings(bool writer, int domain, const schema::Schema& schema) {
  mirror::Settings settings;
  settings.plant = "bench";
  settings.network.board = writer ? "writer" : "reader";
  settings.boards = {writer ? "reader" : "writer"};
  settings.network.domain = domain;
  settings.spin = true;
  settings.cores = {rt::allowed_cores().front()};  // as a node does: not on the core of the modules
  settings.network.fifo_priority = rt::set_fifo(1).ok() ? 1 : 0;
  (void)rt::set_fifo(0);
  for (const schema::Variable& v : schema.variables) {
    if (writer) {
      settings.routes.outgoing.push_back({v.name});
    } else {
      settings.routes.incoming.push_back({v.name, "writer"});
    }
  }
  return settings;
}

double cpu_seconds(int who) {
  rusage usage{};
  ::getrusage(who, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec) * 1e-6;
}

double at_part(const std::vector<std::int64_t>& sorted, double part) {
  return sorted.empty()
             ? 0.0
             : static_cast<double>(sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))]) /
                   1000;
}

void write_values(vars::Store& store, mirror::Mirror* mirror, std::atomic<std::uint64_t>& tick, double seconds) {
  (void)rt::set_fifo(90);
  (void)rt::pin_to_core(rt::allowed_cores().back());
  const auto end = static_cast<std::uint64_t>(seconds * 1000);
  const double process = cpu_seconds(RUSAGE_SELF);
  const double own = cpu_seconds(RUSAGE_THREAD);
  std::vector<std::int64_t> late;
  late.reserve(end);
  const std::int64_t start = rt::now_ns();
  for (std::uint64_t n = 0; n < end; ++n) {
    const std::int64_t planned = start + static_cast<std::int64_t>(n) * kTickNs;
    rt::sleep_until(planned);
    late.push_back(rt::now_ns() - planned);
    tick.store(n + 1);
    for (const auto& entry : store.directory()) {
      const std::int64_t now = rt::now_ns();
      std::uint8_t bytes[sizeof now];
      std::memcpy(bytes, &now, sizeof now);
      (void)store.write(entry, 0, bytes);
    }
    if (mirror != nullptr) {
      mirror->notify();
    }
  }
  const double mirrors = (cpu_seconds(RUSAGE_SELF) - process) - (cpu_seconds(RUSAGE_THREAD) - own);
  std::sort(late.begin(), late.end());
  std::printf("{\"ticks\": %llu, \"mirror_us_per_tick\": %.2f, \"late_p50_us\": %.2f, \"late_p99_us\": %.2f}\n",
              static_cast<unsigned long long>(end), mirrors / static_cast<double>(end) * 1e6, at_part(late, 0.5),
              at_part(late, 0.99));
}

void read_values(vars::Store& store, const mirror::PeerRecord& peer, double seconds) {
  const auto& entry = store.directory().front();
  const auto& confirmed = abi::confirmed_of(store.entry(entry.name_hash, 0), entry.kind);
  std::vector<std::int64_t> latencies;
  std::int64_t last = 0;
  const double process = cpu_seconds(RUSAGE_SELF);
  const double own = cpu_seconds(RUSAGE_THREAD);
  const std::int64_t end = rt::now_ns() + static_cast<std::int64_t>(seconds * 1e9);
  while (rt::now_ns() < end) {
    std::int64_t stamp = 0;
    std::int64_t again = 0;
    std::uint8_t bytes[sizeof stamp];
    (void)store.read(entry, 0, bytes);
    std::memcpy(&stamp, bytes, sizeof stamp);
    const std::int64_t at = confirmed.load();
    (void)store.read(entry, 0, bytes);
    std::memcpy(&again, bytes, sizeof again);
    if (stamp == again && stamp != last && at > stamp) {
      latencies.push_back(at - stamp);
      last = stamp;
    }
    rt::sleep_until(rt::now_ns() + kTickNs * 4 / 5);
  }
  const double mirrors = (cpu_seconds(RUSAGE_SELF) - process) - (cpu_seconds(RUSAGE_THREAD) - own);
  std::sort(latencies.begin(), latencies.end());
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  std::printf(
      "{\"samples\": %zu, \"p50_us\": %.2f, \"p99_us\": %.2f, \"max_us\": %.2f, \"frames\": %llu, \"lost\": %llu, "
      "\"cpu_s\": %.3f, \"rss_kb\": %ld}\n",
      latencies.size(), at_part(latencies, 0.5), at_part(latencies, 0.99), at_part(latencies, 1.0),
      static_cast<unsigned long long>(peer.frames.load()), static_cast<unsigned long long>(peer.lost_updates.load()),
      mirrors, usage.ru_maxrss);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fprintf(stderr, "usage: mirror_bench write|alone|read DOMAIN SECONDS BYTES COUNT\n");
    return 2;
  }
  const std::string mode = argv[1];
  const bool writer = mode != "read";
  const double seconds = std::atof(argv[3]);
  const schema::Schema schema = make_schema(static_cast<std::uint32_t>(std::atoi(argv[4])), std::atoi(argv[5]));
  const std::string node = std::string("mirror-bench-") + argv[1];
  (void)vars::remove_node(node);
  auto store = vars::Store::create(node, schema);
  if (!store) {
    std::fprintf(stderr, "store: %s\n", store.error().where);
    return 1;
  }
  std::atomic<std::uint64_t> tick{0};
  if (mode == "alone") {
    write_values(store.value(), nullptr, tick, seconds);
  } else {
    auto mirror = mirror::Mirror::start(make_settings(writer, std::atoi(argv[2]), schema), node, store.value(), tick);
    const auto file = vars::ShmFile::open(vars::mirror_file(node), vars::Mode::ReadOnly);
    if (!mirror || !file) {
      std::fprintf(stderr, "cannot start the mirror\n");
      return 1;
    }
    const auto& peer = reinterpret_cast<const mirror::MirrorBlock*>(file.value().data())->peers()[0];
    const std::int64_t patience = rt::now_ns() + 10'000'000'000;
    while (peer.state.load() != mirror::PeerState::Alive && rt::now_ns() < patience) {
      rt::sleep_until(rt::now_ns() + kTickNs);
    }
    if (writer) {
      write_values(store.value(), &mirror.value(), tick, seconds);
    } else {
      read_values(store.value(), peer, seconds);
    }
  }
  (void)vars::remove_node(node);
  return 0;
}
