// SPDX-License-Identifier: Apache-2.0
#include "store/vars/growth.h"

#include <indurop/detail/variable_access.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "store/vars/scalar.h"
#include "store/vars/tear_free_ring.h"

namespace indurop::vars {
namespace {

constexpr std::uint64_t kGrowthPage = 4096;

// Position in the directory; its size if there is none.
std::size_t position_of(const BlockIndex& index, std::uint64_t offset) {
  const auto found = std::find_if(index.directory.begin(), index.directory.end(),
                                  [offset](const DirectoryEntry& entry) { return entry.offset == offset; });
  return static_cast<std::size_t>(found - index.directory.begin());
}

std::size_t position_of(const BlockIndex& index, const std::string& name) {
  const std::uint64_t hash = abi::fnv1a64(name.data(), name.size());
  const auto found = std::find_if(index.directory.begin(), index.directory.end(),
                                  [hash](const DirectoryEntry& entry) { return entry.name_hash == hash; });
  return static_cast<std::size_t>(found - index.directory.begin());
}

void give_name(BlockIndex& index, std::size_t position, const schema::Variable& variable) {
  DirectoryEntry& entry = index.directory[position];
  entry.name_hash = variable.name_hash();
  entry.flags = variable.retain ? kRetain : 0;
  index.schema.variables[entry.schema_index] = variable;
}

std::string free_name(const BlockIndex& index, const std::string& name) {
  std::string free = name + "_before";
  for (int i = 2; position_of(index, free) < index.directory.size(); ++i) {
    free = name + "_before" + std::to_string(i);
  }
  return free;
}

// It can be read, and has no effect.
schema::Variable former(schema::Variable variable, const std::string& name) {
  variable.name = name;
  variable.retain = false;
  variable.alarms.clear();
  return variable;
}

std::vector<std::uint8_t> initial_of(const schema::Variable& variable) {
  return variable.initial.empty() ? std::vector<std::uint8_t>(variable.type.size()) : variable.initial;
}

}  // namespace

Growth::Growth(ShmFile& file, const BlockIndex& first) : file_(file), end_(file.size()) {
  for (const DirectoryEntry& entry : first.directory) {
    places_.push_back({first.schema.variables[entry.schema_index], entry});
  }
}

const Growth::Place* Growth::find(std::uint64_t name_hash, std::uint64_t type_hash) const noexcept {
  const auto found = std::find_if(places_.begin(), places_.end(), [&](const Place& place) {
    return place.entry.name_hash == name_hash && place.entry.type_hash == type_hash;
  });
  return found != places_.end() ? &*found : nullptr;
}

void* Growth::place(std::uint64_t name_hash, std::uint64_t type_hash) const {
  const std::lock_guard lock(mutex_);
  const Place* const found = find(name_hash, type_hash);
  return found != nullptr ? at(found->entry) : nullptr;
}

Result<std::uint64_t> Growth::allocate(std::uint64_t bytes) {
  const std::uint64_t begin = round_up(end_, abi::kAlign);
  if (const Status grown = file_.grow(round_up(begin + bytes, kGrowthPage)); !grown) {
    return grown.error();
  }
  end_ = begin + bytes;
  return begin;
}

Status Growth::reserve(const BlockIndex& now, std::span<const schema::Variable> variables) {
  const std::lock_guard lock(mutex_);
  for (const schema::Variable& variable : variables) {
    const auto known = std::find_if(places_.begin(), places_.end(), [&variable](const Place& place) {
      return place.entry.name_hash == variable.name_hash() && place.entry.type_hash == variable.type_hash;
    });
    const bool named = known != places_.end() &&
                       std::any_of(now.directory.begin(), now.directory.end(),
                                   [&](const DirectoryEntry& one) { return one.offset == known->entry.offset; });
    if (named) {
      continue;
    }
    if (known == places_.end()) {
      if (const Status made = make_place(variable); !made) {
        return made;
      }
      continue;
    }
    // Static objects of a version that was loaded and did not run may have written it.
    known->variable = variable;
    if (const Status done = put(known->entry, initial_of(variable)); !done) {
      return done;
    }
  }
  return {};
}

std::optional<schema::Variable> Growth::declared(std::uint64_t name_hash, std::uint64_t type_hash) const {
  const std::lock_guard lock(mutex_);
  const Place* const found = find(name_hash, type_hash);
  return found != nullptr ? std::optional(found->variable) : std::nullopt;
}

Status Growth::read(std::uint64_t name_hash, std::uint64_t type_hash, std::vector<std::uint8_t>& to) const {
  const std::lock_guard lock(mutex_);
  const Place* const found = find(name_hash, type_hash);
  if (found == nullptr) {
    return Error{Errc::NotFound, 0, "place of a variable"};
  }
  const DirectoryEntry& entry = found->entry;
  to.resize(entry.value_size);
  if (entry.kind == abi::Kind::Scalar) {
    read_scalar(at(entry), entry.value_size, 0, to);
  } else {
    read_slow(*reinterpret_cast<abi::RingHeader*>(at(entry)), entry.value_size, to.data(), 0, entry.value_size);
  }
  return {};
}

Status Growth::write(std::uint64_t name_hash, std::uint64_t type_hash, std::span<const std::uint8_t> value) {
  const std::lock_guard lock(mutex_);
  const Place* const found = find(name_hash, type_hash);
  return found != nullptr ? put(found->entry, value) : Status(Error{Errc::NotFound, 0, "place of a variable"});
}

Status Growth::make_place(const schema::Variable& variable) {
  auto entry = plan_variable(variable, 0);
  if (!entry) {
    return entry.error();
  }
  const auto offset = allocate(abi::entry_size(entry->kind, entry->value_size));
  if (!offset) {
    return offset.error();
  }
  entry->offset = *offset;
  if (!fill_entry(at(*entry), variable)) {
    return Error{Errc::Unsupported, 0, "a lock that processes share"};
  }
  places_.push_back({variable, *entry});
  return {};
}

Status Growth::put(const DirectoryEntry& entry, std::span<const std::uint8_t> value) const noexcept {
  if (entry.kind == abi::Kind::Scalar) {
    write_scalar(at(entry), entry.value_size, 0, value);
    return {};
  }
  auto& ring = *reinterpret_cast<abi::RingHeader*>(at(entry));
  void* const slot = begin_write(ring, 0, entry.value_size);
  if (slot == nullptr) {
    return Error{Errc::Busy, 0, "write lock of a variable"};
  }
  indurop::detail::copy_to_shared(slot, value.data(), value.size());
  commit(ring);
  return {};
}

// Gives the places their names. Returns what else has to be stored in the block.
Result<std::vector<NextCatalog::Word>> Growth::list(BlockIndex& next,
                                                    std::span<const schema::Variable> variables) const {
  std::vector<NextCatalog::Word> words;
  for (const schema::Variable& variable : variables) {
    const Place* const place = find(variable.name_hash(), variable.type_hash);
    if (place == nullptr) {
      return Error{Errc::NotFound, 0, "place of a variable"};
    }
    const std::size_t holder = position_of(next, variable.name);
    const std::size_t position = position_of(next, place->entry.offset);
    if (holder < next.directory.size() && holder != position) {
      const auto variable_of = [&next](std::size_t which) {
        return next.schema.variables[next.directory[which].schema_index];
      };
      const bool exchanged = position < next.directory.size();
      give_name(next, holder,
                former(variable_of(holder), exchanged ? variable_of(position).name : free_name(next, variable.name)));
      words.push_back({&moved_of(at(next.directory[holder]), next.directory[holder].kind), next.growths});
    }
    if (position == next.directory.size()) {
      next.directory.push_back(place->entry);
      next.directory.back().schema_index = static_cast<std::uint32_t>(next.schema.variables.size());
      next.schema.variables.push_back(variable);
    }
    give_name(next, position, variable);
    words.push_back({&moved_of(at(place->entry), place->entry.kind), 0});
  }
  return words;
}

Status Growth::write_catalog(BlockIndex& next) {
  const std::string text = schema::to_json(next.schema);
  const std::uint64_t directory_bytes = next.directory.size() * sizeof(DirectoryEntry);
  const std::uint64_t needed = round_up(directory_bytes, abi::kAlign) + text.size();
  Area& area = areas_[next.growths % kCatalogs];
  if (needed > area.bytes) {
    const std::uint64_t wanted = needed + needed / 2;  // for more of them
    const auto offset = allocate(wanted);
    if (!offset) {
      return offset.error();
    }
    area = {*offset, wanted};
  }
  const std::uint64_t schema_offset = area.offset + round_up(directory_bytes, abi::kAlign);
  indurop::detail::copy_to_shared(file_.data() + area.offset, next.directory.data(), directory_bytes);
  indurop::detail::copy_to_shared(file_.data() + schema_offset, text.data(), text.size());
  next.layout_hash = layout_hash_of(next.directory, text);
  const Catalog catalog{next.layout_hash, file_.size(), area.offset, schema_offset, text.size(), next.directory.size()};
  indurop::detail::copy_to_shared(&header().catalogs[next.growths % kCatalogs], &catalog, sizeof catalog);
  return {};
}

Result<NextCatalog> Growth::prepare(const BlockIndex& now, std::span<const schema::Variable> variables) {
  const std::lock_guard lock(mutex_);
  auto next = std::make_unique<BlockIndex>(now);
  next->growths = now.growths + 1;
  auto words = list(*next, variables);
  if (!words) {
    return words.error();
  }
  if (const Status written = write_catalog(*next); !written) {
    return written.error();
  }
  if (!sort_by_name(*next)) {
    return Error{Errc::AlreadyExists, 0, "two shared variables of one name"};
  }
  words->push_back({&header().growths, next->growths});
  return NextCatalog{std::move(next), std::move(words).value()};
}

}  // namespace indurop::vars
