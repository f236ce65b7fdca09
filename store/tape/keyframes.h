// SPDX-License-Identifier: Apache-2.0
// Keyframes of a node: copies of what its modules keep between two runs, in shared memory next to the tape. Each module
// has a few slots in rotation that one thread of the node, or of a process module, writes; readers never see a slot
// that is half written, even if the node is killed in the middle. Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <atomic>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "store/tape/layout.h"
#include "store/vars/shm_file.h"

namespace indurop::tape {

inline constexpr std::uint64_t kKeyframeMagic = 0x314d41524659454bULL;  // "KEYFRAM1"
inline constexpr std::uint32_t kKeyframeAbi = 1;
// At two keyframes each second, as many as the tape's two seconds need, and those of a second more for slow readers.
inline constexpr std::uint64_t kKeyframeSlots = 6;

// Precedes the bytes of a slot.
struct KeyframeHead {
  std::uint64_t run = 0;  // number of the run on the module's track that begins with this state
  std::uint64_t tick = 0;
  std::int64_t time_ns = 0;  // in the node's time
  std::uint64_t bytes = 0;
};

struct KeyframeModule {
  std::uint32_t module = 0;  // index in the run block
  std::uint32_t form_bytes = 0;
  std::uint64_t form_offset = 0;  // text: what the bytes are; all offsets from the start of the memory
  std::uint64_t slots_offset = 0;
  std::uint64_t slot_bytes = 0;  // distance of two slots, head included
  alignas(kLine)
      std::atomic<std::uint64_t> count;  // keyframes written so far: the next one goes into count % kKeyframeSlots
  std::atomic<std::uint64_t> missed;     // periods without a keyframe, because the module was always running
};

struct KeyframeHeader {
  std::atomic<std::uint64_t> magic;  // stored last
  std::uint32_t abi;
  std::uint32_t module_count;
  std::uint64_t total_size;
  std::int32_t node_pid;
  std::uint32_t reserved;
  std::uint64_t node_start_time;  // as in TapeHeader
};

struct KeyframePlan {
  std::uint32_t module = 0;
  std::uint64_t most = 0;  // bytes of one keyframe
  std::string form;
};

// The file of keyframes, in shared memory.
struct KeyframeFile {
  std::string name;
  std::int32_t node_pid = 0;
  std::uint64_t more_bytes = 0;                // after the keyframes, for the owner
  void (*prepare)(std::byte* more) = nullptr;  // called before others see the file
};

class KeyframeWriter {
 public:
  // Replaces older keyframes of the node. Errors: NoSpace, PermissionDenied, System. On error no file is left.
  static Result<KeyframeWriter> create(const std::string& node, std::span<const KeyframePlan> plans);
  static Result<KeyframeWriter> create(const KeyframeFile& file, std::span<const KeyframePlan> plans);
  // Opens the keyframes of one module that another process writes, too. Errors: NotFound (there are none, or they
  // belong to another node), PermissionDenied, VersionMismatch, Corrupt, System.
  static Result<KeyframeWriter> open(const KeyframeFile& file);

  // The place for the bytes of the next keyframe of entry `index` of the plans.
  [[nodiscard]] std::span<std::byte> room(std::size_t index) noexcept;
  // What was written to room() is the next keyframe; readers see it from now on.
  void publish(std::size_t index, const KeyframeHead& head) noexcept;
  void note_missed(std::size_t index) noexcept;
  [[nodiscard]] std::string form(std::size_t index) const;
  // The bytes of the newest keyframe; empty: there is none.
  [[nodiscard]] std::span<const std::uint8_t> newest(std::size_t index) const noexcept;
  // The memory after the keyframes.
  [[nodiscard]] std::byte* more() const noexcept;

 private:
  explicit KeyframeWriter(vars::ShmFile&& file) : file_(std::move(file)) {}
  [[nodiscard]] KeyframeModule& module(std::size_t index) const noexcept;
  [[nodiscard]] std::byte* slot(const KeyframeModule& module) const noexcept;
  vars::ShmFile file_;
};

struct Keyframe {
  std::uint32_t module = 0;
  KeyframeHead head;
  std::vector<std::uint8_t> bytes;
};

// The reading end, from a mapping that cannot disturb the node. No content is trusted before it was checked.
class KeyframeFollower {
 public:
  // Begins with the oldest keyframe still there. Errors: NotFound (the node of this tape has none), PermissionDenied,
  // VersionMismatch, Corrupt, System.
  static Result<KeyframeFollower> open(const std::string& node, const TapeHeader& tape);
  // The same for keyframes that a process module writes, process_keyframe_file().
  static Result<KeyframeFollower> open_file(const std::string& name, const TapeHeader& tape);

  struct Module {
    std::uint32_t module = 0;
    std::string form;
  };
  [[nodiscard]] std::size_t modules() const noexcept { return places_.size(); }
  // Returns true if a newer process replaced the file.
  [[nodiscard]] bool is_replaced() const noexcept { return file_.named() == vars::ShmFile::Named::Gone; }
  [[nodiscard]] const Module& module(std::size_t index) const noexcept { return places_[index].known; }
  // Reads the next keyframe of a module; false: there is none yet.
  bool next(std::size_t index, Keyframe& keyframe);

 private:
  struct Place {
    Module known;
    const KeyframeModule* shared = nullptr;
    std::uint64_t slots_offset = 0;
    std::uint64_t slot_bytes = 0;
    std::uint64_t at = 0;
  };
  explicit KeyframeFollower(vars::ShmFile&& file) : file_(std::move(file)) {}
  Status find_modules();
  vars::ShmFile file_;
  std::vector<Place> places_;
};

}  // namespace indurop::tape
