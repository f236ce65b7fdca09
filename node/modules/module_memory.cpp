// SPDX-License-Identifier: Apache-2.0
#include "node/modules/module_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "store/tape/grown_array.h"
#include "store/tape/state_copy.h"
#include "store/tape/state_form.h"

namespace indurop::node {
namespace {

constexpr std::string_view kPlaces = "place of each of these";

StateAddress address_in(const std::byte* bytes, std::size_t size) noexcept {
  StateAddress address;
  std::memcpy(static_cast<void*>(&address), bytes, size < sizeof address ? sizeof address.to : sizeof address);
  return address;
}

}  // namespace

// An item as a keyframe has it.
struct ModuleMemory::Old {
  std::string_view name;
  std::string_view type;
  std::span<const std::uint8_t> bytes;
};

ModuleMemory::ModuleMemory(const StateDescriptor& declared)
    : declared_(true), functions_(declared), missing_(declared.missing != nullptr ? declared.missing : "") {
  const auto* at = reinterpret_cast<const std::byte*>(declared.items);
  for (std::uint32_t i = 0; i < declared.item_count; ++i, at += declared.item_size) {
    StateItem item;
    std::memcpy(static_cast<void*>(&item), at, std::min<std::size_t>(declared.item_size, sizeof item));
    add(item);
  }
  if (has_addresses_) {
    const std::size_t bytes = items_.size() * sizeof(std::uint64_t);
    form_ += fmt::format("\t{}\t{}\n", kPlaces, bytes);
    most_ += bytes;
  }
  if (uses_functions()) {
    form_ += fmt::format("\t{}\t{}\n", tape::kFormOfFunctions, declared.most);
    most_ += declared.most;
  }
}

ModuleMemory::Kind ModuleMemory::kind_of(std::string_view type) noexcept {
  constexpr std::array<std::pair<std::string_view, Kind>, 3> kBeginnings{
      {{kStateAddress, Kind::Address}, {kStatePlace, Kind::Place}, {kStateShown, Kind::Shown}}};
  for (const auto& [beginning, kind] : kBeginnings) {
    if (type.starts_with(beginning)) {
      return kind;
    }
  }
  return Kind::Value;
}

void ModuleMemory::add(const StateItem& item) {
  const std::string_view type(item.type, item.type_length);
  const Kind kind = kind_of(type);
  items_.push_back({{item.name, item.name_length}, std::string(type), item.address, item.size, kind});
  const Item& added = items_.back();
  form_ += fmt::format("{}\t{}\t{}\n", added.name, added.type, added.bytes());
  most_ += added.bytes();
  if (item.size == 0) {
    missing_ += (missing_.empty() ? "" : ", ") + added.name;
  }
  has_addresses_ = has_addresses_ || kind == Kind::Address;
  const auto place = reinterpret_cast<std::uintptr_t>(item.address);
  here_.add(place, item.size, place);
}

bool ModuleMemory::is_astray(const Item& item, const std::byte* bytes) const noexcept {
  return item.kind == Kind::Address && !here_.find(address_in(bytes, item.size));
}

std::string ModuleMemory::astray() const {
  std::string names;
  for (const Item& item : items_) {
    if (is_astray(item, static_cast<const std::byte*>(item.address))) {
      names += (names.empty() ? "" : ", ") + item.name;
    }
  }
  return names;
}

std::string ModuleMemory::led_to(const Item& item) const {
  const StateAddress address = address_in(static_cast<const std::byte*>(item.address), item.size);
  if (address.to == nullptr) {
    return "nothing";
  }
  const auto to = reinterpret_cast<std::uintptr_t>(address.to);
  const Item* inside = nullptr;  // the smallest one around it
  for (const Item& one : items_) {
    const auto begin = reinterpret_cast<std::uintptr_t>(one.address);
    if (to >= begin && to - begin < one.size && (inside == nullptr || one.size < inside->size)) {
      inside = &one;
    }
  }
  if (inside == nullptr) {
    return "what is not kept";
  }
  const std::uintptr_t offset = to - reinterpret_cast<std::uintptr_t>(inside->address);
  return offset == 0 ? inside->name : fmt::format("{} + {} bytes", inside->name, offset);
}

std::size_t ModuleMemory::save(std::span<std::byte> to) const {
  std::size_t at = 0;
  for (const Item& item : items_) {
    tape::copy_racing(to.data() + at, item.address, item.bytes());
    if (is_astray(item, to.data() + at)) {
      return 0;
    }
    at += item.bytes();
  }
  for (std::size_t i = 0; has_addresses_ && i < items_.size(); ++i, at += sizeof(std::uint64_t)) {
    const auto place = reinterpret_cast<std::uintptr_t>(items_[i].address);
    std::memcpy(to.data() + at, &place, sizeof place);
  }
  if (!uses_functions()) {
    return at;
  }
  const std::size_t by_function = tape::save_by_function(functions_, to.subspan(at, functions_.most));
  return by_function == 0 ? 0 : at + by_function;
}

const ModuleMemory::Item* ModuleMemory::find(const Old& old) const noexcept {
  const auto item = std::find_if(items_.begin(), items_.end(), [&](const Item& one) {
    const bool same = one.type == old.type && one.bytes() == old.bytes.size();
    const bool grown = one.kind == Kind::Value && tape::has_grown(old.type, one.type) && old.bytes.size() < one.bytes();
    return one.name == old.name && (same || grown);
  });
  return item == items_.end() ? nullptr : &*item;
}

std::vector<std::string> ModuleMemory::restore(std::string_view form, std::span<const std::uint8_t> bytes) const {
  std::vector<Old> all;
  std::span<const std::uint8_t> places;
  bool by_function = !uses_functions();
  while (const auto line = tape::take_line(form)) {
    if (line->type == tape::kFormOfFunctions) {
      by_function = uses_functions() && functions_.restore(bytes.data(), bytes.size());
      break;  // they are the last ones
    }
    if (line->size > bytes.size()) {
      break;
    }
    const auto of_line = bytes.first(line->size);
    bytes = bytes.subspan(line->size);
    if (line->name.empty()) {
      places = of_line;
    } else {
      all.push_back({line->name, line->type, of_line});
    }
  }
  std::vector<std::string> differing = restore(all, places);
  if (!by_function) {
    differing.emplace_back("what its restore() takes");
  }
  return differing;
}

std::vector<std::string> ModuleMemory::restore(std::span<const Old> all, std::span<const std::uint8_t> places) const {
  std::vector<std::string> differing;
  std::vector<bool> known(items_.size(), false);
  Relocation moved;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Item* const item = find(all[i]);
    if (item == nullptr) {
      if (kind_of(all[i].type) != Kind::Shown) {
        differing.emplace_back(all[i].name);
      }
      continue;
    }
    known[static_cast<std::size_t>(item - items_.data())] = true;
    if (item->bytes() > 0) {
      std::memcpy(item->address, all[i].bytes.data(), all[i].bytes.size());
    }
    if (std::uint64_t before = 0; (i + 1) * sizeof before <= places.size()) {
      std::memcpy(&before, places.data() + i * sizeof before, sizeof before);
      moved.add(before, item->size, reinterpret_cast<std::uintptr_t>(item->address));
    }
  }
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const Item& item = items_[i];
    const bool named = std::find(differing.begin(), differing.end(), item.name) != differing.end();
    if ((!known[i] && !named && item.kind != Kind::Shown) ||
        (known[i] && item.kind == Kind::Address && !lead(item, moved))) {
      differing.push_back(item.name);
    }
  }
  return differing;
}

// Lets an address that was put back lead to where its variable is now. Returns false, and lets it lead nowhere, if that
// is not kept.
bool ModuleMemory::lead(const Item& item, const Relocation& moved) {
  const auto to = moved.find(address_in(static_cast<const std::byte*>(item.address), item.size));
  const std::uint64_t now = to.value_or(0);
  std::memcpy(item.address, &now, sizeof now);
  return to.has_value();
}

}  // namespace indurop::node
