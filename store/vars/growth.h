// SPDX-License-Identifier: Apache-2.0
// What the store of a running node grows by: places for variables that another version of a module brings. A place
// keeps the name and type that it was made for as long as the block exists, so no process finds anything else at an
// offset that it knows. Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/schema/schema.h"
#include "store/vars/block.h"
#include "store/vars/shm_file.h"

namespace indurop::vars {

// Bytes of addresses that the node reserves for it, in addition to the block that it starts with.
inline constexpr std::size_t kGrowthRoom = std::size_t{64} << 20U;

// What a store has when it has grown: entries keep their indices in directory and schema. It counts for all processes
// when the words are stored, in this order; any thread may do that, real-time safe.
struct NextCatalog {
  struct Word {
    std::atomic<std::uint64_t>* to = nullptr;
    std::uint64_t value = 0;
  };
  std::unique_ptr<const BlockIndex> index;
  std::vector<Word> words;
};

// A variable whose type has changed stays readable in its old layout as NAME_before.
class Growth {
 public:
  // `file` is borrowed: the block, mapped for writing with room to grow. `first`: what it has.
  Growth(ShmFile& file, const BlockIndex& first);

  // Makes places for those variables that have none of their name and type in `now`, with their initial values. Nothing
  // names them until they are in a catalog that counts. Any normal thread. Errors: InvalidArgument, Overflow (see
  // plan_block()), NoSpace (room or memory), NotFound (the file's name was removed), Unsupported (no robust locks),
  // Busy (a process is stopped while it writes one).
  Status reserve(const BlockIndex& now, std::span<const schema::Variable> variables);
  // Entry of a place, whether a catalog names it or not; null: there is none. Any normal thread.
  [[nodiscard]] void* place(std::uint64_t name_hash, std::uint64_t type_hash) const;

  // The declaration that a place was made for last; nothing if there is none.
  [[nodiscard]] std::optional<schema::Variable> declared(std::uint64_t name_hash, std::uint64_t type_hash) const;
  // Reads and writes the whole value of a place, whether a catalog names it or not. Errors: NotFound, Busy.
  Status read(std::uint64_t name_hash, std::uint64_t type_hash, std::vector<std::uint8_t>& to) const;
  Status write(std::uint64_t name_hash, std::uint64_t type_hash, std::span<const std::uint8_t> value);

  // Writes the catalog in which these variables, for which there are places, are those of their names, and all others
  // are as in `now`. Replaces a catalog that was prepared and does not count. One thread. Errors: NotFound (no place),
  // NoSpace, Overflow.
  Result<NextCatalog> prepare(const BlockIndex& now, std::span<const schema::Variable> variables);

 private:
  struct Place {
    schema::Variable variable;  // as it was declared
    DirectoryEntry entry{};
  };
  struct Area {
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
  };
  [[nodiscard]] const Place* find(std::uint64_t name_hash, std::uint64_t type_hash) const noexcept;
  Result<std::uint64_t> allocate(std::uint64_t bytes);
  Status make_place(const schema::Variable& variable);
  [[nodiscard]] Status put(const DirectoryEntry& entry, std::span<const std::uint8_t> value) const noexcept;
  [[nodiscard]] std::byte* at(const DirectoryEntry& entry) const noexcept { return file_.data() + entry.offset; }
  Result<std::vector<NextCatalog::Word>> list(BlockIndex& next, std::span<const schema::Variable> variables) const;
  Status write_catalog(BlockIndex& next);
  [[nodiscard]] BlockHeader& header() const noexcept { return *header_of(file_.data()); }

  mutable std::mutex mutex_;
  ShmFile& file_;
  std::vector<Place> places_;
  std::uint64_t end_;      // of what is used of the block
  Area areas_[kCatalogs];  // of the catalogs
};

}  // namespace indurop::vars
