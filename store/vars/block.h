// SPDX-License-Identifier: Apache-2.0
// Builds the block's bytes from a schema, and checks whether given bytes are a block. No files here.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/schema/schema.h"
#include "store/vars/layout.h"

namespace indurop::vars {

// Everything about a block except its values.
struct BlockPlan {
  schema::Schema schema;  // sorted by name, so that the order of modules does not matter
  std::vector<DirectoryEntry> directory;
  std::string schema_text;
  std::uint64_t directory_offset = 0;
  std::uint64_t functions_offset = 0;
  std::uint64_t schema_offset = 0;
  std::uint64_t total_size = 0;
  std::uint64_t layout_hash = 0;
};

// Errors: InvalidArgument (size 0, scalar of another size than 1, 2, 4, 8, initial value of another size than the
// type), AlreadyExists (a name twice), Overflow (a variable of 4 GiB or more).
Result<BlockPlan> plan_block(const schema::Schema& schema);

// Writes the plan and the initial values into zeroed memory of plan.total_size bytes, except the magic. Errors:
// Unsupported (the system has no robust locks).
Status fill_block(std::byte* memory, const BlockPlan& plan, const std::string& node);

// Errors: Busy (not yet complete), VersionMismatch (another ABI), Corrupt (not a store's header, or of another size).
Status check_header(std::span<const std::byte> memory);

// Returns false if a lock of a variable does not work: a process has overwritten it. Repairs what killed ones left.
bool locks_work(std::byte* memory, std::span<const DirectoryEntry> directory) noexcept;

// From now on, this process is the node of the block, in its next run.
void sign_in(BlockHeader& header, std::uint64_t generation) noexcept;

// What a block has, copied so that no process can change it during use.
struct BlockIndex {
  std::vector<DirectoryEntry> directory;  // an entry keeps its place in it when the store grows
  schema::Schema schema;
  std::vector<std::uint32_t> by_name;  // places in the directory, in the order of name hashes
  std::uint64_t growths = 0;
  std::uint64_t layout_hash = 0;  // of all this

  // Returns null if there is no such variable. Real-time safe.
  [[nodiscard]] const DirectoryEntry* find(std::uint64_t name_hash) const noexcept;
};
// Errors: Busy (not yet complete, or it has just grown: map it again), VersionMismatch (another ABI), Corrupt (anything
// inconsistent).
Result<BlockIndex> check_block(std::span<const std::byte> memory);
// Completes `by_name`. Returns false if two variables have one name.
bool sort_by_name(BlockIndex& index);

// The entry of a variable, without its offset. Errors: InvalidArgument, Overflow; see plan_block().
Result<DirectoryEntry> plan_variable(const schema::Variable& variable, std::size_t schema_index);
// Makes the entry of a variable in zeroed memory, with its initial value. Returns false if the system has no robust
// locks.
bool fill_entry(std::byte* entry, const schema::Variable& variable);
std::uint64_t layout_hash_of(std::span<const DirectoryEntry> directory, std::string_view schema_text) noexcept;

BlockHeader* header_of(std::byte* memory) noexcept;
const BlockHeader* header_of(const std::byte* memory) noexcept;

}  // namespace indurop::vars
