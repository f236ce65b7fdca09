// SPDX-License-Identifier: Apache-2.0
// Files in shared memory, mapped whole: created under a temporary name and renamed when complete, so that no process
// ever sees a partial file. The only place that uses iceoryx, whose headers are not included here.

#pragma once

#include <indurop/result.h>
#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::vars {

enum class Mode { ReadOnly, ReadWrite };

inline constexpr const char* kShmDirectory = "/dev/shm";

// [A-Za-z0-9_-]{1,40}
bool valid_node_name(std::string_view node) noexcept;
// File names of a node in kShmDirectory.
std::string block_file(const std::string& node);                          // indurop.<node>
std::string run_file(const std::string& node);                            // indurop.<node>.run
std::string mirror_file(const std::string& node);                         // indurop.<node>.mirror
std::string external_file(const std::string& node);                       // indurop.<node>.external
std::string tape_file(const std::string& node);                           // indurop.<node>.tape
std::string keyframe_file(const std::string& node);                       // indurop.<node>.keyframes
std::string replay_input_file(const std::string& node);                   // indurop.<node>.retold
std::string lock_file(const std::string& node);                           // indurop.<node>.lock
std::string pool_file(const std::string& node, std::uint64_t name_hash);  // indurop.<node>.pool.<hash in hex>
// The files whose names begin like this. Not real-time safe.
std::vector<std::string> shm_files_beginning_with(const std::string& beginning);
// The files of all pools of a node, finished or not. Not real-time safe.
std::vector<std::string> pool_files(const std::string& node);

// Permissions: the owner and its group write, everyone reads. Set explicitly, independent of the umask.
inline constexpr mode_t kShmMode = 0664;

class ShmFile {
 public:
  // Maps an existing file whole. If the file is truncated meanwhile, no process crashes: see lost(). Errors: NotFound,
  // PermissionDenied, Corrupt (empty, or not a regular file), NoSpace (limit of locked memory), System. `room`: see
  // grow().
  static Result<ShmFile> open(const std::string& name, Mode mode, std::size_t room = 0);

  // Creates a zeroed file of exactly `size` bytes, all of it allocated, mapped read-write, not yet visible under its
  // name. Errors: NoSpace, PermissionDenied (the temporary name is another user's), System. On error no file is left.
  static Result<ShmFile> create(const std::string& name, std::size_t size, std::size_t room = 0);

  // Makes the published file longer, with zeros, present in memory; what is mapped stays where it is. Addresses for
  // `room` bytes are reserved behind the mapping, which costs no memory. Not real-time safe; one thread at a time,
  // while others may use the file. Errors: NoSpace (no room, or no memory), NotFound (the name was removed), System. On
  // error nothing has changed.
  Status grow(std::size_t size) noexcept;

  // Gives the file its name, replacing an older file of that name for every process that opens it from now on. Errors:
  // PermissionDenied (the older file is another user's), System.
  Status publish() noexcept;

  ShmFile(ShmFile&&) noexcept;
  ShmFile& operator=(ShmFile&&) noexcept;
  ShmFile(const ShmFile&) = delete;
  ShmFile& operator=(const ShmFile&) = delete;
  ~ShmFile();  // unmaps; removes the file if it was created and not published

  [[nodiscard]] std::byte* data() const noexcept;  // page aligned; read-only memory if opened so
  [[nodiscard]] std::size_t size() const noexcept;
  [[nodiscard]] Mode mode() const noexcept;
  // Returns false if another user outside the group could have created or changed the file.
  [[nodiscard]] bool trusted() const noexcept;
  // Returns true if a process that may write the file truncated it; values read now may be zeros. Real-time safe.
  [[nodiscard]] bool lost() const noexcept;
  // Status of the file name in the file system. Not real-time safe.
  enum class Named { Whole, Cut, Gone };  // Gone: nothing, or another file
  [[nodiscard]] Named named() const noexcept;
  // Makes every page present now, so that no later access causes a page fault. Not real-time safe.
  void prefault() const noexcept;

 private:
  struct Impl;
  explicit ShmFile(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

// A copy of a file's content at one moment: no process can change it afterwards. For a single inspection.
class ShmCopy {
 public:
  // Errors: as of ShmFile::open().
  static Result<ShmCopy> of(const std::string& name);
  [[nodiscard]] const std::byte* data() const noexcept { return reinterpret_cast<const std::byte*>(words_.data()); }
  [[nodiscard]] std::size_t size() const noexcept { return bytes_; }

 private:
  std::vector<std::uint64_t> words_;
  std::size_t bytes_ = 0;
};

// Returns a number that changes whenever a new store of this node replaces the previous one; 0: there is none.
std::uint64_t store_number(const std::string& node) noexcept;
// Removes a file that a killed creator left unfinished. Errors: PermissionDenied, System.
Status remove_unfinished(const std::string& name) noexcept;
// Removes a file; succeeds if there is none. Errors: PermissionDenied, System.
Status remove_shm_file(const std::string& name) noexcept;

}  // namespace indurop::vars
