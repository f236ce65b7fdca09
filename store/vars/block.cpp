// SPDX-License-Identifier: Apache-2.0

#include "store/vars/block.h"

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <new>
#include <numeric>
#include <string_view>

#include "core/rt/clock.h"
#include "core/rt/shared_mutex.h"
#include "store/vars/call_layout.h"
#include "store/vars/forces.h"
#include "store/vars/process.h"
#include "store/vars/tear_free_ring.h"

namespace indurop::vars {

namespace {

constexpr std::uint64_t kPage = 4096;

bool scalar_size(std::uint64_t size) noexcept {
  return size == 1 || size == 2 || size == 4 || size == 8;
}

// Not cryptographic: detects damage and differences, and changes with everything that two processes must agree on.
class Hash {
 public:
  void add(const void* bytes, std::size_t size) noexcept {
    const auto* at = static_cast<const unsigned char*>(bytes);
    for (std::size_t i = 0; i < size; ++i) {
      value_ = (value_ ^ at[i]) * 0x100000001b3ULL;
    }
  }
  void add(std::uint64_t number) noexcept { add(&number, sizeof(number)); }
  [[nodiscard]] std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = abi::fnv1a64("", 0);
};

bool unique(std::vector<std::uint64_t> hashes) {
  std::sort(hashes.begin(), hashes.end());
  return std::adjacent_find(hashes.begin(), hashes.end()) == hashes.end();
}

// Strictly ascending: sorted for the search, and no duplicate name.
bool ordered(std::span<const DirectoryEntry> directory) noexcept {
  return std::adjacent_find(directory.begin(), directory.end(),
                            [](const auto& a, const auto& b) { return a.name_hash >= b.name_hash; }) == directory.end();
}

Status plan_entries(BlockPlan& plan) {
  for (std::size_t i = 0; i < plan.schema.variables.size(); ++i) {
    auto entry = plan_variable(plan.schema.variables[i], i);
    if (!entry) {
      return entry.error();
    }
    plan.directory.push_back(*entry);
  }
  std::sort(plan.directory.begin(), plan.directory.end(),
            [](const DirectoryEntry& a, const DirectoryEntry& b) { return a.name_hash < b.name_hash; });
  std::vector<std::uint64_t> functions;
  for (const schema::Function& function : plan.schema.functions) {
    constexpr std::uint64_t kLargestCall = 1U << 20U;
    if (function.arguments.size() > kLargestCall || function.result.size() > kLargestCall) {
      return Error{Errc::Overflow, 0, "size of a shared function's arguments or result"};
    }
    functions.push_back(abi::fnv1a64(function.name.data(), function.name.size()));
  }
  if (!ordered(plan.directory) || !unique(std::move(functions))) {
    return Error{Errc::AlreadyExists, 0, "two shared variables or functions of one name"};
  }
  return {};
}

void place_entries(BlockPlan& plan) {
  plan.directory_offset = round_up(sizeof(BlockHeader), abi::kAlign);
  plan.schema_offset = round_up(plan.directory_offset + plan.directory.size() * sizeof(DirectoryEntry), abi::kAlign);
  std::uint64_t at = round_up(plan.schema_offset + plan.schema_text.size(), kPage);
  for (DirectoryEntry& entry : plan.directory) {
    entry.offset = at;
    at += abi::entry_size(entry.kind, entry.value_size);
  }
  plan.functions_offset = at;
  plan.total_size = round_up(at + call_area_size(plan.schema), kPage);
}

// Copies the part of `memory` given by offset and count; returns false if it is not inside.
template <class Entry>
bool copy_table(std::span<const std::byte> memory, std::uint64_t offset, std::uint64_t count, std::vector<Entry>& to) {
  if (offset % alignof(Entry) != 0 || offset > memory.size() || count > (memory.size() - offset) / sizeof(Entry)) {
    return false;
  }
  to.resize(count);
  if (count != 0) {
    std::memcpy(to.data(), memory.data() + offset, count * sizeof(Entry));
  }
  return true;
}

bool inside(std::span<const std::byte> memory, std::uint64_t offset, std::uint64_t size) noexcept {
  return offset % abi::kAlign == 0 && offset <= memory.size() && size <= memory.size() - offset;
}

Catalog catalog_of(const BlockHeader& header, std::uint64_t growths) noexcept {
  return growths != 0 ? header.catalogs[growths % kCatalogs]
                      : Catalog{header.layout_hash,   header.total_size,  header.directory_offset,
                                header.schema_offset, header.schema_size, header.variable_count};
}

bool sane(std::span<const std::byte> memory, const DirectoryEntry& entry, const schema::Schema& schema) noexcept {
  return (entry.kind == abi::Kind::Ring || (entry.kind == abi::Kind::Scalar && scalar_size(entry.value_size))) &&
         entry.schema_index < schema.variables.size() && entry.offset >= sizeof(BlockHeader) &&
         inside(memory, entry.offset, abi::entry_size(entry.kind, entry.value_size)) &&
         schema.variables[entry.schema_index].type.size() == entry.value_size &&
         schema.variables[entry.schema_index].name_hash() == entry.name_hash;
}

// Errors: Corrupt, VersionMismatch.
Result<BlockIndex> read_catalog(std::span<const std::byte> memory, const BlockHeader& header, const Catalog& catalog) {
  const Error corrupt{Errc::Corrupt, 0, "directory of the store"};
  constexpr std::uint32_t kMaxVariables = 1'000'000;
  constexpr std::uint64_t kMaxText = std::uint64_t{256} << 20U;
  BlockIndex index;
  std::vector<char> text;
  if (catalog.total_size > memory.size() || catalog.variable_count > kMaxVariables || catalog.schema_size > kMaxText ||
      !copy_table(memory, catalog.directory_offset, catalog.variable_count, index.directory) ||
      !copy_table(memory, catalog.schema_offset, catalog.schema_size, text)) {
    return corrupt;
  }
  const std::string_view schema_text(text.data(), text.size());
  if (layout_hash_of(index.directory, schema_text) != catalog.layout_hash) {
    return corrupt;
  }
  auto schema = schema::from_json(schema_text);
  if (!schema) {
    return schema.error();
  }
  index.schema = std::move(schema.value());
  const auto fits = [&](const auto& entry) { return sane(memory, entry, index.schema); };
  if (!sort_by_name(index) || !std::all_of(index.directory.begin(), index.directory.end(), fits) ||
      header.function_count != index.schema.functions.size() ||
      !inside(memory, header.functions_offset, call_area_size(index.schema))) {
    return corrupt;
  }
  return index;
}

}  // namespace

BlockHeader* header_of(std::byte* memory) noexcept {
  return reinterpret_cast<BlockHeader*>(memory);
}
const BlockHeader* header_of(const std::byte* memory) noexcept {
  return reinterpret_cast<const BlockHeader*>(memory);
}

std::uint64_t layout_hash_of(std::span<const DirectoryEntry> directory, std::string_view schema_text) noexcept {
  Hash hash;
  hash.add(abi::kVersion);
  hash.add(sizeof(BlockHeader));
  hash.add(sizeof(abi::RingHeader));
  hash.add(rt::kLockKind);
  hash.add(sizeof(void*));
  hash.add(std::endian::native == std::endian::little ? 1 : 0);
  hash.add(directory.data(), directory.size_bytes());
  hash.add(schema_text.data(), schema_text.size());
  return hash.value();
}

Result<DirectoryEntry> plan_variable(const schema::Variable& variable, std::size_t schema_index) {
  const std::uint64_t size = variable.type.size();
  if (size == 0 || (variable.kind == abi::Kind::Scalar && !scalar_size(size))) {
    return Error{Errc::InvalidArgument, 0, "size of a shared variable"};
  }
  if (!variable.initial.empty() && variable.initial.size() != size) {
    return Error{Errc::InvalidArgument, 0, "size of a shared variable's initial value"};
  }
  if (size > std::numeric_limits<std::uint32_t>::max() - abi::kAlign) {
    return Error{Errc::Overflow, 0, "size of a shared variable"};
  }
  DirectoryEntry entry{};
  entry.name_hash = variable.name_hash();
  entry.type_hash = variable.type_hash;
  entry.value_size = static_cast<std::uint32_t>(size);
  entry.kind = variable.kind;
  entry.schema_index = static_cast<std::uint32_t>(schema_index);
  entry.flags = variable.retain ? kRetain : 0;
  return entry;
}

bool fill_entry(std::byte* entry, const schema::Variable& variable) {
  const auto& initial = variable.initial;
  if (variable.kind == abi::Kind::Ring) {
    return init_ring(entry, static_cast<std::uint32_t>(variable.type.size()),
                     initial.empty() ? nullptr : initial.data());
  }
  if (!initial.empty()) {
    std::memcpy(entry, initial.data(), initial.size());
  }
  return true;
}

Result<BlockPlan> plan_block(const schema::Schema& schema) {
  BlockPlan plan;
  plan.schema = schema;
  const auto by_name = [](const auto& a, const auto& b) { return a.name < b.name; };
  std::sort(plan.schema.variables.begin(), plan.schema.variables.end(), by_name);
  std::sort(plan.schema.functions.begin(), plan.schema.functions.end(), by_name);
  std::sort(plan.schema.pools.begin(), plan.schema.pools.end(), by_name);
  if (Status status = plan_entries(plan); !status) {
    return status.error();
  }
  plan.schema_text = schema::to_json(plan.schema);
  place_entries(plan);
  plan.layout_hash = layout_hash_of(plan.directory, plan.schema_text);
  return plan;
}

Status fill_block(std::byte* memory, const BlockPlan& plan, const std::string& node) {
  auto* header = new (memory) BlockHeader{};
  header->abi = abi::kVersion;
  header->header_size = sizeof(BlockHeader);
  header->total_size = plan.total_size;
  header->layout_hash = plan.layout_hash;
  header->state.store(BlockState::Building, std::memory_order_relaxed);
  header->variable_count = static_cast<std::uint32_t>(plan.directory.size());
  header->function_count = static_cast<std::uint32_t>(plan.schema.functions.size());
  header->directory_offset = plan.directory_offset;
  header->functions_offset = plan.functions_offset;
  header->schema_offset = plan.schema_offset;
  header->schema_size = plan.schema_text.size();
  node.copy(header->node_name, sizeof(header->node_name) - 1);
  const auto put = [&](std::uint64_t offset, const void* from, std::size_t size) {
    if (size != 0) {
      std::memcpy(memory + offset, from, size);
    }
  };
  put(plan.directory_offset, plan.directory.data(), plan.directory.size() * sizeof(DirectoryEntry));
  put(plan.schema_offset, plan.schema_text.data(), plan.schema_text.size());
  const Error no_locks{Errc::Unsupported, 0, "a lock that processes share"};
  for (const DirectoryEntry& entry : plan.directory) {
    if (!fill_entry(memory + entry.offset, plan.schema.variables[entry.schema_index])) {
      return no_locks;
    }
  }
  if (!init_forces(header->forces) || !init_call_area(memory, plan.functions_offset, plan.schema)) {
    return no_locks;
  }
  return {};
}

bool locks_work(std::byte* memory, std::span<const DirectoryEntry> directory) noexcept {
  return std::all_of(directory.begin(), directory.end(), [&](const DirectoryEntry& entry) {
    return entry.kind == abi::Kind::Scalar ||
           check_ring(*reinterpret_cast<abi::RingHeader*>(memory + entry.offset), entry.value_size);
  });
}

void sign_in(BlockHeader& header, std::uint64_t generation) noexcept {
  header.node_start_time.store(process_start_time(::getpid()), std::memory_order_relaxed);
  header.node_pid.store(::getpid(), std::memory_order_relaxed);
  header.heartbeat_ns.store(rt::now_ns(), std::memory_order_relaxed);
  header.virtual_ns.store(0, std::memory_order_relaxed);
  header.generation.store(generation, std::memory_order_release);
}

Status check_header(std::span<const std::byte> memory) {
  if (memory.size() < sizeof(BlockHeader)) {
    return Error{Errc::Corrupt, 0, "store is shorter than its header"};
  }
  const BlockHeader& header = *header_of(memory.data());
  const std::uint64_t magic = header.magic.load(std::memory_order_acquire);
  if (magic == 0) {
    return Error{Errc::Busy, 0, "store is not complete yet"};
  }
  if (magic != kMagic) {
    return Error{Errc::Corrupt, 0, "not a store"};
  }
  if (header.abi != abi::kVersion || header.header_size != sizeof(BlockHeader)) {
    return Error{Errc::VersionMismatch, 0, "store made by another version of InduRoP"};
  }
  const BlockState state = header.state.load(std::memory_order_acquire);
  const bool known_state = state == BlockState::Ready || state == BlockState::Retired;
  if (header.total_size > memory.size() || header.total_size % kPage != 0 || !known_state ||
      std::memchr(header.node_name, 0, sizeof(header.node_name)) == nullptr) {
    return Error{Errc::Corrupt, 0, "header of the store"};
  }
  return {};
}

Result<BlockIndex> check_block(std::span<const std::byte> memory) {
  if (Status status = check_header(memory); !status) {
    return status.error();
  }
  const BlockHeader& header = *header_of(memory.data());
  const std::uint64_t growths = header.growths.load(std::memory_order_acquire);
  const Catalog catalog = catalog_of(header, growths);
  const std::uint64_t end = std::min<std::uint64_t>(catalog.total_size, memory.size());
  auto index = read_catalog(memory.first(end), header, catalog);
  std::atomic_thread_fence(std::memory_order_acquire);
  const bool overwritten = header.growths.load(std::memory_order_relaxed) != growths;  // perhaps the next but one
  const bool longer = growths != 0 && catalog.total_size > memory.size();
  if (!index && (overwritten || longer)) {
    return Error{Errc::Busy, 0, "store has just grown"};
  }
  if (index) {
    index->growths = growths;
    index->layout_hash = catalog.layout_hash;
  }
  return index;
}

bool sort_by_name(BlockIndex& index) {
  index.by_name.resize(index.directory.size());
  std::iota(index.by_name.begin(), index.by_name.end(), 0U);
  const auto hash = [&](std::uint32_t place) { return index.directory[place].name_hash; };
  std::sort(index.by_name.begin(), index.by_name.end(),
            [&](std::uint32_t a, std::uint32_t b) { return hash(a) < hash(b); });
  return std::adjacent_find(index.by_name.begin(), index.by_name.end(), [&](std::uint32_t a, std::uint32_t b) {
           return hash(a) == hash(b);
         }) == index.by_name.end();
}

const DirectoryEntry* BlockIndex::find(std::uint64_t name_hash) const noexcept {
  const auto at =
      std::lower_bound(by_name.begin(), by_name.end(), name_hash,
                       [this](std::uint32_t place, std::uint64_t hash) { return directory[place].name_hash < hash; });
  return at != by_name.end() && directory[*at].name_hash == name_hash ? &directory[*at] : nullptr;
}

}  // namespace indurop::vars
