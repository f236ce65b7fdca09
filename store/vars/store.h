// SPDX-License-Identifier: Apache-2.0
// The store: one shared-memory block per node holding every shared variable of the board. The node creates it, module
// processes attach read-write, tools attach read-only. Survives kill -9 of any of them; values outlive the node.

#pragma once

#include <indurop/detail/abi.h>
#include <indurop/result.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/schema/schema.h"
#include "store/vars/forces.h"
#include "store/vars/growth.h"
#include "store/vars/layout.h"
#include "store/vars/shm_file.h"

namespace indurop::vars {

// The origin of a store's values.
enum class Origin {
  Attached,     // attach(): created by another process
  Fresh,        // create(): initial values
  CarriedOver,  // create(): from a block of another layout, as far as names and types are the same
  Adopted,      // create(): the block itself already existed
};

class Store {
 public:
  // Creates the node's block, or adopts the existing one if it holds the same layout (values and attached processes are
  // kept, generation + 1); a different layout retires the old block and creates a new one, carrying over values of
  // variables whose name and type are unchanged; a corrupt block is replaced. Only the holder of the node lock may call
  // it. Not real-time safe. Values that attached processes write between the carrying over and their next retired() are
  // lost. A block that another user may have planted is not adopted. Errors: InvalidArgument (node name; sizes or
  // initial values in the schema), AlreadyExists (a name twice), Overflow, NoSpace (/dev/shm full: no file is left),
  // PermissionDenied (the block is another user's), System.
  static Result<Store> create(const std::string& node, const schema::Schema& schema);

  // Attaches to the block of a running node or a left-over one. Errors: NotFound, VersionMismatch, Corrupt,
  // PermissionDenied (read-write is for the owner and its group), Busy (a newer block is just replacing it: try again),
  // NoSpace, System.
  static Result<Store> attach(const std::string& node, Mode mode);

  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;
  ~Store();

  [[nodiscard]] Origin origin() const noexcept;
  [[nodiscard]] const BlockHeader& header() const noexcept;
  // Parsed from the block. In the node, whose store can grow, this and all that is found in it is valid for eight more
  // growths, and for ever if it is from before the first.
  [[nodiscard]] const schema::Schema& schema() const noexcept;
  [[nodiscard]] bool retired() const noexcept;  // a newer block has replaced it, or it was truncated: attach again
  // Returns true if the node has other variables since: attach again to see them. Those that were found stay usable,
  // but those whose type has changed: see read(). Real-time safe.
  [[nodiscard]] bool grown() const noexcept;
  // Returns true if the type of a variable has changed since it was found: its value is elsewhere. Real-time safe.
  [[nodiscard]] bool moved(const DirectoryEntry& variable) const noexcept;
  // Identifies the variables that it has, with their types. The header has that of the variables at the start.
  [[nodiscard]] std::uint64_t layout_hash() const noexcept;
  // Returns true if a process that may write the block truncated or emptied it: values are missing. Real-time safe.
  [[nodiscard]] bool lost() const noexcept;
  [[nodiscard]] ShmFile::Named named() const noexcept;  // status of its file name; not real-time safe

  // Entry of a variable, null if absent. `type_hash` 0 accepts any type. Real-time safe.
  [[nodiscard]] void* entry(std::uint64_t name_hash, std::uint64_t type_hash) const noexcept;
  [[nodiscard]] const DirectoryEntry* find(std::uint64_t name_hash) const noexcept;
  [[nodiscard]] std::span<const DirectoryEntry> directory() const noexcept;

  // Reads one consistent version of a variable's bytes. If writers keep overtaking the copy, a read-write store makes
  // them wait by taking the lock; a read-only one cannot, and retries for 50 ms, yielding the processor. Errors:
  // OutOfRange, Dead (lost()), Timeout (read-only: the variable is written without a pause), TypeMismatch (its type has
  // changed since it was found: attach again).
  Status read(const DirectoryEntry& variable, std::uint32_t offset, std::span<std::uint8_t> to) const noexcept;
  // Writes the whole value or a part of it in one commit; of the part only those bytes whose element in `only` is not
  // 0, if it is not empty (it is as long as `from`; of a scalar always the whole part). All others keep what they have
  // at the commit, also if another thread has just written them. Errors: OutOfRange, Busy (lock not free in 5 ms: its
  // holder is stopped), PermissionDenied (read-only), TypeMismatch (as of read(); whether the value was carried is
  // open).
  Status write(const DirectoryEntry& variable, std::uint32_t offset, std::span<const std::uint8_t> from,
               std::span<const std::uint8_t> only = {}) noexcept;

  // Holds a part of a variable, of 1, 2, 4 or 8 bytes, at a value until a time (or kForever) against all writers;
  // create() ends all forces. Not real-time safe. Errors: OutOfRange, InvalidArgument (size), NoSpace (kMaxForces are
  // held), Busy, PermissionDenied (read-only), TypeMismatch (as of read(); it is not forced).
  Status force(const DirectoryEntry& variable, std::uint32_t offset, std::span<const std::uint8_t> value,
               rt::MonoTime until) noexcept;
  // Sets a later end of a force whose end is still `was`. Errors: NotFound (another user has re-forced or released it
  // since, or it has expired), Busy, PermissionDenied (read-only).
  Status prolong(const DirectoryEntry& variable, std::uint32_t offset, rt::MonoTime was, rt::MonoTime until) noexcept;
  // Errors: NotFound (it is not forced), Busy, PermissionDenied (read-only).
  Status release(const DirectoryEntry& variable, std::uint32_t offset) noexcept;
  // Removes expired forces, which hold nothing but cost their writers a check.
  void release_overdue() noexcept;
  [[nodiscard]] std::vector<Force> forces() const;

  // Releases writer locks that the calling thread holds and discards unpublished versions: for a thread that left a
  // module because of a fault. Real-time safe. A thread that ends releases its locks too, so ending it works as well.
  void release_locks_of_this_thread() noexcept;

  // Resets variables to their initial values: all, or all except the retained. One commit each. A variable whose lock
  // is not free in 5 ms keeps its value and counts a lost write.
  void reset(bool keep_retained) noexcept;

  // The time of the node: that of its simulation, if it is one, else CLOCK_MONOTONIC. Real-time safe.
  [[nodiscard]] rt::MonoTime now() const noexcept;
  // The word in which a simulating node stores its time; create() sets it to 0, which is real time.
  [[nodiscard]] std::atomic<std::int64_t>& virtual_time() noexcept;

  // For the node: what its store grows by. Normal threads.
  // Makes places for variables; see Growth::reserve().
  Status reserve(std::span<const schema::Variable> variables);
  // The place of a variable of this name and type, whether the store has the variable yet or not; null: there is none.
  [[nodiscard]] void* place(std::uint64_t name_hash, std::uint64_t type_hash) const;
  [[nodiscard]] Growth& growth() noexcept;
  // See Growth::prepare().
  Result<NextCatalog> prepare(std::span<const schema::Variable> variables);
  // The catalog's words were stored: this object has the variables, too. Of one thread; others may use the store.
  void follow(NextCatalog next);
  // Stores the words, and follows.
  void announce(NextCatalog next);

  void beat(rt::MonoTime now) noexcept;  // the node's heartbeat; real-time safe
  void prefault() const noexcept;        // makes all pages present now; not real-time safe

 private:
  struct Impl;
  explicit Store(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

// Selects nodes that have a block on this machine or run without one because it was removed; names are sorted.
enum class Nodes {
  Near,  // nodes of this user, of root, and of users whose group this user is in
  All,
};
std::vector<std::string> list_nodes(Nodes which = Nodes::Near);

// Returns the last heartbeat of a node without reading its store's content. Errors: NotFound (no node, or no heartbeat
// yet), PermissionDenied, Busy, VersionMismatch, Corrupt.
Result<rt::MonoTime> last_beat(const std::string& node);
// Format number of a node's store, the abi::kVersion of its creator; 0: there is no store.
std::uint32_t store_format(const std::string& node);
// Removes every shared-memory file of a node. Errors: Busy while the node runs.
Status remove_node(const std::string& node);

}  // namespace indurop::vars
