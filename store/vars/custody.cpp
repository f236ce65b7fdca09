// SPDX-License-Identifier: Apache-2.0
#include "store/vars/custody.h"

#include <indurop/detail/variable_access.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <utility>
#include <vector>

#include "core/rt/shared_mutex.h"
#include "store/vars/block.h"

namespace indurop::vars {
namespace {

constexpr std::uint64_t kCustodyMagic = 0x31545355'43524e49ULL;
constexpr std::size_t kName = 64;
constexpr std::size_t kReason = 160;
constexpr std::size_t kMaxNotes = kMaxForces + 16;  // some belong to forces that end meanwhile

// The format in memory.
struct Line {
  std::uint64_t variable;  // name hash; 0: free
  std::uint32_t offset;
  std::uint32_t kind;  // WriteLock, or 1: lease
  std::int64_t wall_ns;
  char who[kName];
  char from[kName];
  char reason[kReason];
};

struct Place {
  std::atomic<std::uint64_t> version;  // odd while it is written
  Line line;
};

struct CustodyBlock {
  std::atomic<std::uint64_t> magic;  // stored last
  rt::SharedMutex mutex;             // for writers
  Place lock;
  Place notes[kMaxNotes];
};

CustodyBlock& block_in(const ShmFile& file) noexcept {
  return *reinterpret_cast<CustodyBlock*>(file.data());
}

template <std::size_t Size>
void put(char (&to)[Size], const std::string& text) noexcept {
  std::memset(to, 0, Size);
  std::memcpy(to, text.data(), std::min(text.size(), Size - 1));
}

template <std::size_t Size>
std::string text_in(const char (&from)[Size]) {
  return {from, ::strnlen(from, Size)};
}

Line line_of(const Note& note, std::uint64_t variable, std::uint32_t offset, std::uint32_t kind) noexcept {
  Line line{};
  line.variable = variable;
  line.offset = offset;
  line.kind = kind;
  line.wall_ns = note.wall_ns;
  put(line.who, note.who);
  put(line.from, note.from);
  put(line.reason, note.reason);
  return line;
}

void write(Place& place, const Line& line) noexcept {
  const std::uint64_t version = place.version.load(std::memory_order_relaxed) | 1U;  // a killed writer left it odd
  place.version.store(version, std::memory_order_relaxed);
  std::atomic_thread_fence(std::memory_order_release);
  indurop::detail::copy_to_shared(&place.line, &line, sizeof line);
  place.version.store(version + 1, std::memory_order_release);
}

// Returns nothing if it stays odd for long: its writer was killed.
std::optional<Line> read(const Place& place) noexcept {
  constexpr int kTries = 1000;
  for (int i = 0; i < kTries; ++i) {
    const std::uint64_t version = place.version.load(std::memory_order_acquire);
    Line line{};
    indurop::detail::copy_from_shared(&line, &place.line, sizeof line);
    std::atomic_thread_fence(std::memory_order_acquire);
    if (version % 2 == 0 && place.version.load(std::memory_order_relaxed) == version) {
      return line;
    }
  }
  return std::nullopt;
}

void fill(Note& note, const Line& line) {
  note.who = text_in(line.who);
  note.from = text_in(line.from);
  note.reason = text_in(line.reason);
  note.wall_ns = line.wall_ns;
}

class Writing {
 public:
  explicit Writing(CustodyBlock& block) noexcept
      : block_(block), locked_(rt::is_locked(rt::lock_within(block.mutex))) {}
  Writing(const Writing&) = delete;
  Writing& operator=(const Writing&) = delete;
  ~Writing() {
    if (locked_) {
      rt::unlock(block_.mutex);
    }
  }
  [[nodiscard]] bool locked() const noexcept { return locked_; }

 private:
  CustodyBlock& block_;
  bool locked_;
};

bool is_forced(const std::vector<Force>& forces, const Line& line) {
  return std::any_of(forces.begin(), forces.end(), [&line](const Force& force) {
    return force.variable->name_hash == line.variable && force.offset == line.offset;
  });
}

// Returns the slot of a note about the same part, else a free one: unused, or of a part that is no longer forced. Those
// just `taken` belong to forces that follow.
Place* place_for(CustodyBlock& block, const std::vector<Force>& forces,
                 const std::vector<std::pair<Place*, Line>>& taken, const Line& wanted) {
  Place* free = nullptr;
  for (Place& place : block.notes) {
    const auto line = read(place);
    if (line && line->variable == wanted.variable && line->offset == wanted.offset) {
      return &place;
    }
    const bool is_taken =
        std::any_of(taken.begin(), taken.end(), [&place](const auto& one) { return one.first == &place; });
    if (free == nullptr && !is_taken && (!line || line->variable == 0 || !is_forced(forces, *line))) {
      free = &place;
    }
  }
  return free;
}

}  // namespace

const char* word_of(WriteLock lock) noexcept {
  return lock == WriteLock::None ? "none" : lock == WriteLock::Tune ? "tune" : "all";
}

std::optional<WriteLock> write_lock_of(std::string_view word) noexcept {
  for (const WriteLock lock : {WriteLock::None, WriteLock::Tune, WriteLock::All}) {
    if (word == word_of(lock)) {
      return lock;
    }
  }
  return std::nullopt;
}

std::optional<std::string> refusal(const LockNote& lock, Act act) {
  if (lock.lock == WriteLock::None || (lock.lock == WriteLock::Tune && act == Act::SetParameter)) {
    return std::nullopt;
  }
  const std::string by = lock.who.empty() ? "" : " by " + lock.who;
  const std::string why = lock.reason.empty() ? "" : " (" + lock.reason + ")";
  return std::string("its write lock is '") + word_of(lock.lock) + "'" + by + why + ": " +
         (lock.lock == WriteLock::Tune ? "only parameters may be written" : "nothing may be written") +
         "; indurop lock none";
}

std::string custody_file(const std::string& node) {
  return block_file(node) + ".custody";
}

Result<Custody> Custody::create(const std::string& node) {
  LockNote before;
  if (auto old = open(node, Mode::ReadWrite); old && old->file_.trusted()) {
    before = old->lock();
  }
  auto file = ShmFile::create(custody_file(node), sizeof(CustodyBlock));
  if (!file) {
    return file.error();
  }
  CustodyBlock& block = block_in(*file);
  if (!rt::init_shared_mutex(block.mutex)) {
    return Error{Errc::System, 0, "lock of a node's write lock"};
  }
  write(block.lock, line_of(before, 0, 0, static_cast<std::uint32_t>(before.lock)));
  block.magic.store(kCustodyMagic, std::memory_order_release);
  if (const Status status = file->publish(); !status) {
    return status.error();
  }
  return Custody(std::move(file).value());
}

Result<Custody> Custody::open(const std::string& node, Mode mode) {
  auto file = ShmFile::open(custody_file(node), mode);
  if (!file) {
    return file.error();
  }
  if (file->size() != sizeof(CustodyBlock) || block_in(*file).magic.load(std::memory_order_acquire) != kCustodyMagic) {
    return Error{Errc::NotFound, 0, "write lock of a node of another version"};
  }
  return Custody(std::move(file).value());
}

LockNote Custody::lock() const {
  LockNote note;
  if (const auto line = read(block_in(file_).lock)) {
    fill(note, *line);
    note.lock = static_cast<WriteLock>(std::min(line->kind, static_cast<std::uint32_t>(WriteLock::All)));
  } else {
    note.lock = WriteLock::All;  // a process was killed while changing it
  }
  return note;
}

Status Custody::set_lock(const LockNote& note) {
  if (file_.mode() == Mode::ReadOnly) {
    return Error{Errc::PermissionDenied, 0, "lock through a read-only view"};
  }
  const Writing writing(block_in(file_));
  if (!writing.locked()) {
    return Error{Errc::Busy, 0, "write lock of a node"};
  }
  write(block_in(file_).lock, line_of(note, 0, 0, static_cast<std::uint32_t>(note.lock)));
  return {};
}

Status Custody::hold(Store& store, std::span<const HeldValue> values, rt::MonoTime until, const ForceNote& note) {
  if (file_.mode() == Mode::ReadOnly) {
    return Error{Errc::PermissionDenied, 0, "note through a read-only view"};
  }
  CustodyBlock& block = block_in(file_);
  const Writing writing(block);
  if (!writing.locked()) {
    return vars::hold(store, values, until);
  }
  const std::vector<Force> forces = store.forces();
  std::vector<std::pair<Place*, Line>> before;
  for (const HeldValue& value : values) {
    for (const HeldPart& part : value.parts) {
      const Line line = line_of(note, value.variable->name_hash, value.offset + part.offset, note.lease ? 1 : 0);
      if (Place* const place = place_for(block, forces, before, line)) {
        before.emplace_back(place, read(*place).value_or(Line{}));
        write(*place, line);
      }
    }
  }
  const Status held = vars::hold(store, values, until);
  if (!held) {
    for (auto one = before.rbegin(); one != before.rend(); ++one) {
      write(*one->first, one->second);
    }
  }
  return held;
}

std::optional<ForceNote> Custody::note_of(const DirectoryEntry& variable, std::uint32_t offset) const {
  for (const Place& place : block_in(file_).notes) {
    const auto line = read(place);
    if (line && line->variable == variable.name_hash && line->offset == offset) {
      ForceNote note;
      fill(note, *line);
      note.lease = line->kind == 1;
      return note;
    }
  }
  return std::nullopt;
}

Status hold(const std::string& node, Store& store, std::span<const HeldValue> values, rt::MonoTime until,
            const ForceNote& note) {
  auto custody = Custody::open(node, Mode::ReadWrite);
  return custody ? custody->hold(store, values, until, note) : hold(store, values, until);
}

LockNote lock_of(const std::string& node) {
  const auto custody = Custody::open(node, Mode::ReadOnly);
  return custody ? custody->lock() : LockNote();
}

}  // namespace indurop::vars
