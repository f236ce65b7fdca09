// SPDX-License-Identifier: Apache-2.0
// Builds the block's bytes from a schema, and checks whether given bytes are a block. No files here.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <span>
#include <string>
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

// The block's constant parts, copied so that no process can change them during use.
struct BlockIndex {
  std::vector<DirectoryEntry> directory;
  schema::Schema schema;
};
// Errors: Busy (not yet complete), VersionMismatch (another ABI), Corrupt (anything inconsistent).
Result<BlockIndex> check_block(std::span<const std::byte> memory);

// Returns null if the directory, which is sorted, has no such variable. Real-time safe.
const DirectoryEntry* find_entry(const std::vector<DirectoryEntry>& directory, std::uint64_t name_hash) noexcept;

BlockHeader* header_of(std::byte* memory) noexcept;
const BlockHeader* header_of(const std::byte* memory) noexcept;

}  // namespace indurop::vars
