// SPDX-License-Identifier: Apache-2.0
#include "store/pools/pool.h"

#include <indurop/detail/abi.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/rt/copy_text.h"
#include "core/rt/relaxed.h"
#include "core/rt/shared_mutex.h"
#include "store/vars/layout.h"
#include "store/vars/process.h"

namespace indurop::pools {
namespace {

using rt::kRelaxed;
using vars::Mode;
using vars::ShmFile;

constexpr std::uint64_t kChunkAlign = 64;
constexpr std::uint64_t kDataAlign = 4096;

const PoolHeader& header_in(const ShmFile& file) noexcept {
  return *reinterpret_cast<const PoolHeader*>(file.data());
}

std::uint64_t hash_of(std::string_view name) noexcept {
  return abi::fnv1a64(name.data(), name.size());
}

std::string_view name_in(const PoolHeader& header) noexcept {
  return {header.name, strnlen(header.name, sizeof header.name)};
}

// Nothing outside of the file is accessed if this succeeds.
Status check(const ShmFile& file) noexcept {
  const PoolHeader& header = header_in(file);
  if (file.size() < sizeof(PoolHeader) || header.magic.load(std::memory_order_acquire) != kPoolMagic) {
    return Error{Errc::Corrupt, 0, "the file is no pool"};
  }
  if (header.abi != kPoolAbi) {
    return Error{Errc::VersionMismatch, 0, "the pool was made by another version"};
  }
  const bool sound = header.chunk_count >= kMinChunks && header.chunk_count <= kMaxChunks &&
                     header.data_offset >= sizeof(PoolHeader) && header.data_offset % kDataAlign == 0 &&
                     header.stride % kChunkAlign == 0 && header.chunk_bytes <= header.stride &&
                     header.stride <= kMaxChunkBytes && header.data_offset <= file.size() &&
                     header.chunk_count * header.stride <= file.size() - header.data_offset;
  return sound ? Status() : Error{Errc::Corrupt, 0, "the numbers in the pool's file do not agree"};
}

bool has_shape(const PoolHeader& header, const Shape& shape) noexcept {
  return header.retired.load(std::memory_order_acquire) == 0 && name_in(header) == shape.name &&
         header.type_hash == shape.type_hash && header.chunk_bytes == shape.chunk_bytes &&
         header.chunk_count == shape.chunks;
}

// Returns true if the state is one that a process may have left, however it ended.
bool is_sound(std::uint64_t state) noexcept {
  switch (phase_of(state)) {
    case Phase::Free:
      return state == kFree;
    case Phase::Filling:
      return state >> 8U < kSeats;
    case Phase::Published:
      return number_of(state) != 0 && state == published_as(number_of(state));
  }
  return false;
}

// Writers may be publishing: a number is given before it is used.
bool has_sound_states(const PoolHeader& header) noexcept {
  std::uint64_t highest = 0;
  for (std::uint32_t i = 0; i < header.chunk_count; ++i) {
    const std::uint64_t state = header.states[i].load(std::memory_order_acquire);
    if (!is_sound(state)) {
      return false;
    }
    highest = std::max(highest, phase_of(state) == Phase::Published ? number_of(state) : 0);
  }
  return highest <= header.numbers.load(std::memory_order_acquire);
}

bool is_good(const Shape& shape) noexcept {
  return !shape.name.empty() && shape.name.size() < kMaxPoolName && shape.chunks >= kMinChunks &&
         shape.chunks <= kMaxChunks && shape.chunk_bytes > 0 && shape.chunk_bytes <= kMaxChunkBytes;
}

// Seats are changed only while this lock is held.
class SeatLock {
 public:
  explicit SeatLock(PoolHeader& header) noexcept : lock_(header.lock), result_(rt::lock_within(lock_)) {}
  SeatLock(const SeatLock&) = delete;
  SeatLock& operator=(const SeatLock&) = delete;
  ~SeatLock() {
    if (is_held()) {
      rt::unlock(lock_);
    }
  }
  [[nodiscard]] bool is_held() const noexcept { return rt::is_locked(result_); }

 private:
  abi::SharedMutex& lock_;
  rt::LockResult result_;
};

}  // namespace

Pool::Pool(ShmFile&& file) noexcept
    : file_(std::move(file)),
      chunk_count_(header().chunk_count),
      stride_(header().stride),
      data_offset_(header().data_offset) {}

Result<Pool> Pool::create(const std::string& node, const Shape& shape) {
  if (!vars::valid_node_name(node) || !is_good(shape)) {
    return Error{Errc::InvalidArgument, 0, "make a pool"};
  }
  const std::string name = vars::pool_file(node, hash_of(shape.name));
  if (auto old = ShmFile::open(name, Mode::ReadWrite); old && check(*old)) {
    auto& header = *reinterpret_cast<PoolHeader*>(old->data());
    if (old->trusted() && has_shape(header, shape) && has_sound_states(header)) {
      rt::inherit_shared_mutex(header.lock);
      if (SeatLock(header).is_held()) {
        Pool pool(std::move(old).value());
        pool.file_name_ = name;
        (void)pool.sweep();
        return pool;
      }
    }
    header.retired.store(1, std::memory_order_release);
  }
  const std::uint64_t stride = vars::round_up(shape.chunk_bytes, kChunkAlign);
  const std::uint64_t offset = vars::round_up(sizeof(PoolHeader), kDataAlign);
  auto file = ShmFile::create(name, offset + shape.chunks * stride);
  if (!file) {
    return file.error();
  }
  auto& header = *reinterpret_cast<PoolHeader*>(file->data());
  header.abi = kPoolAbi;
  header.chunk_count = shape.chunks;
  header.chunk_bytes = shape.chunk_bytes;
  header.stride = stride;
  header.data_offset = offset;
  header.type_hash = shape.type_hash;
  rt::copy_text(header.name, shape.name);
  if (!rt::init_shared_mutex(header.lock)) {
    return Error{Errc::Unsupported, 0, "make the lock of a pool"};
  }
  header.magic.store(kPoolMagic, std::memory_order_release);
  if (const Status status = file->publish(); !status) {
    return status.error();
  }
  Pool pool(std::move(file).value());
  pool.file_name_ = name;
  return pool;
}

Result<Pool> Pool::open(const std::string& node, std::string_view name, std::uint64_t type_hash, Mode mode) {
  std::string file_name = vars::pool_file(node, hash_of(name));
  auto file = ShmFile::open(file_name, mode);
  if (!file) {
    return file.error();
  }
  if (const Status status = check(*file); !status) {
    return status.error();
  }
  const PoolHeader& header = header_in(*file);
  if (name_in(header) != name || header.retired.load(std::memory_order_acquire) != 0) {
    return Error{Errc::NotFound, 0, "open a pool"};
  }
  if (header.type_hash != type_hash) {
    return Error{Errc::TypeMismatch, 0, "open a pool"};
  }
  Pool pool(std::move(file).value());
  pool.file_name_ = std::move(file_name);
  return pool;
}

Result<std::uint32_t> Pool::take_seat(std::string_view user) {
  const SeatLock lock(header());
  if (!lock.is_held()) {
    return Error{Errc::Busy, 0, "lock the seats of a pool"};
  }
  (void)free_dead_seats();
  Seat* const seat =
      std::find_if(header().seats, header().seats + kSeats, [](const Seat& one) { return one.pid.load() == 0; });
  const auto index = static_cast<std::uint32_t>(seat - header().seats);
  if (index == kSeats) {
    return Error{Errc::NoSpace, 0, "all seats of a pool are taken"};
  }
  (void)chunks().release_all(index);  // nothing, unless another process wrote nonsense
  for (auto* counter : {&seat->seen, &seat->missed, &seat->published, &seat->without_a_chunk}) {
    counter->store(0, kRelaxed);
  }
  rt::copy_text(seat->user, user);
  const pid_t pid = ::getpid();
  seat->start_time.store(vars::process_start_time(pid), kRelaxed);
  seat->pid.store(pid, std::memory_order_release);
  return index;
}

void Pool::leave_seat(std::uint32_t seat) noexcept {
  (void)chunks().release_all(seat);
  header().seats[seat].pid.store(0, std::memory_order_release);
}

// The next process repeats what one that is killed in here has begun.
std::uint32_t Pool::free_dead_seats() noexcept {
  const std::uint64_t started = vars::process_start_time(::getpid());
  std::uint32_t recovered = 0;
  for (std::uint32_t i = 0; i < kSeats; ++i) {
    Seat& seat = header().seats[i];
    const pid_t pid = seat.pid.load(std::memory_order_acquire);
    const std::uint64_t start_time = seat.start_time.load(kRelaxed);
    const bool is_mine = pid == ::getpid() && start_time == started;
    if (pid != 0 && !is_mine && !vars::process_alive(pid, start_time)) {
      recovered += chunks().release_all(i);
      seat.pid.store(0, std::memory_order_release);
    }
  }
  header().recovered.fetch_add(recovered, kRelaxed);
  return recovered;
}

std::uint32_t Pool::sweep() noexcept {
  const SeatLock lock(header());
  return lock.is_held() ? free_dead_seats() : 0;
}

void Pool::remove() noexcept {
  header().retired.store(1, std::memory_order_release);
  (void)vars::remove_shm_file(file_name_);
}

void remove_others(const std::string& node, const std::vector<std::string>& files) {
  for (const std::string& name : vars::pool_files(node)) {
    if (std::ranges::find(files, name) != files.end()) {
      continue;
    }
    if (const auto file = ShmFile::open(name, Mode::ReadWrite); file && check(*file)) {
      reinterpret_cast<PoolHeader*>(file->data())->retired.store(1, std::memory_order_release);
    }
    (void)vars::remove_shm_file(name);
  }
}

Shape Pool::shape() const {
  return {std::string(name_in(header())), header().type_hash, header().chunk_bytes, chunk_count_};
}

Usage Pool::usage() const {
  Usage usage;
  usage.free = chunks().free();
  usage.numbers = header().numbers.load(kRelaxed);
  usage.missed = header().missed.load(kRelaxed);
  usage.without_a_chunk = header().without_a_chunk.load(kRelaxed);
  usage.recovered = header().recovered.load(kRelaxed);
  for (std::uint32_t chunk = 0; chunk < chunk_count_; ++chunk) {
    const bool is_published = phase_of(header().states[chunk].load(std::memory_order_acquire)) == Phase::Published;
    usage.newest_ns = std::max(usage.newest_ns, is_published ? rt::to_ns(chunks().time_of(chunk)) : 0);
  }
  for (std::uint32_t i = 0; i < kSeats; ++i) {
    const Seat& seat = header().seats[i];
    if (const pid_t pid = seat.pid.load(std::memory_order_acquire); pid != 0) {
      User user{{seat.user, strnlen(seat.user, sizeof seat.user)},
                pid,
                seat.seen.load(kRelaxed),
                seat.missed.load(kRelaxed),
                seat.published.load(kRelaxed),
                seat.without_a_chunk.load(kRelaxed)};
      for (std::uint32_t chunk = 0; chunk < chunk_count_; ++chunk) {
        user.holds += header().holds[chunk][i].load(kRelaxed) != 0 ? 1U : 0U;
        user.fills += header().states[chunk].load(kRelaxed) == filled_by(i) ? 1U : 0U;
      }
      usage.users.push_back(std::move(user));
    }
  }
  return usage;
}

}  // namespace indurop::pools
