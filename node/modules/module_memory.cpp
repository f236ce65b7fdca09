// SPDX-License-Identifier: Apache-2.0
#include "node/modules/module_memory.h"

#include <csetjmp>
#include <cstring>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/rt/guard.h"

namespace indurop::node {
namespace {

constexpr std::string_view kByFunctions = "bytes of its save()";

struct FormLine {
  std::string_view name;
  std::string_view type;
  std::size_t size = 0;
};

// Takes the first line off a form; nullopt: it is none.
std::optional<FormLine> next_line(std::string_view& form) {
  const std::size_t name_end = form.find('\t');
  const std::size_t type_end = name_end == std::string_view::npos ? name_end : form.find('\t', name_end + 1);
  const std::size_t end = type_end == std::string_view::npos ? type_end : form.find('\n', type_end);
  if (end == std::string_view::npos) {
    return std::nullopt;
  }
  FormLine line{form.substr(0, name_end), form.substr(name_end + 1, type_end - name_end - 1), 0};
  const auto read = std::from_chars(form.data() + type_end + 1, form.data() + end, line.size);
  form.remove_prefix(end + 1);
  return read.ec == std::errc() && read.ptr == form.data() - 1 ? std::optional(line) : std::nullopt;
}

// A run may write what is being read: its bytes are discarded then, see KeyframePart.
[[gnu::no_sanitize("thread")]] void copy_racing(std::byte* to, const void* from, std::size_t size) noexcept {
  const auto* const bytes = static_cast<const volatile std::byte*>(from);
  std::size_t i = 0;
  for (; i < size && (reinterpret_cast<std::uintptr_t>(from) + i) % sizeof(std::uint64_t) != 0; ++i) {
    to[i] = bytes[i];
  }
  for (; i + sizeof(std::uint64_t) <= size; i += sizeof(std::uint64_t)) {
    const std::uint64_t word = *reinterpret_cast<const volatile std::uint64_t*>(bytes + i);
    std::memcpy(to + i, &word, sizeof word);
  }
  for (; i < size; ++i) {
    to[i] = bytes[i];
  }
}

}  // namespace

ModuleMemory::ModuleMemory(const StateDescriptor& declared)
    : declared_(true), functions_(declared), missing_(declared.missing != nullptr ? declared.missing : "") {
  const auto* at = reinterpret_cast<const std::byte*>(declared.items);
  for (std::uint32_t i = 0; i < declared.item_count; ++i, at += declared.item_size) {
    StateItem item;
    std::memcpy(static_cast<void*>(&item), at, std::min<std::size_t>(declared.item_size, sizeof item));
    items_.push_back({{item.name, item.name_length}, {item.type, item.type_length}, item.address, item.size});
    form_ += fmt::format("{}\t{}\t{}\n", items_.back().name, items_.back().type, item.size);
    most_ += item.size;
    if (item.size == 0) {
      missing_ += (missing_.empty() ? "" : ", ") + items_.back().name;
    }
  }
  if (uses_functions()) {
    form_ += fmt::format("\t{}\t{}\n", kByFunctions, declared.most);
    most_ += declared.most;
  }
}

std::size_t ModuleMemory::save(std::span<std::byte> to) const {
  std::size_t at = 0;
  for (const Item& item : items_) {
    copy_racing(to.data() + at, item.address, item.size);
    at += item.size;
  }
  if (!uses_functions()) {
    return at;
  }
  const std::size_t by_function = save_by_function(to.subspan(at, functions_.most));
  return by_function == 0 ? 0 : at + by_function;
}

// A run that begins meanwhile may leave it something inconsistent: a fault of it is one more reason to try again.
std::size_t ModuleMemory::save_by_function(std::span<std::byte> to) const {
  rt::Guard guard;
  guard.enter();
  volatile std::size_t written = 0;
  if (sigsetjmp(guard.target(), 0) != 0) {
    guard.recovered();
    guard.leave();
    return 0;
  }
  guard.arm();
  try {
    written = functions_.save(to.data(), to.size());
  } catch (...) {
    written = 0;
  }
  guard.disarm();
  guard.leave();
  return written <= to.size() ? written : 0;
}

std::vector<std::string> ModuleMemory::restore(std::string_view form, std::span<const std::uint8_t> bytes) const {
  std::vector<std::string> differing;
  std::vector<bool> restored(items_.size(), false);
  bool by_function = !uses_functions();
  while (const auto line = next_line(form)) {
    if (line->type == kByFunctions) {
      by_function = uses_functions() && functions_.restore(bytes.data(), bytes.size());
      bytes = {};
      continue;
    }
    if (line->size > bytes.size()) {
      break;
    }
    const auto item =
        std::find_if(items_.begin(), items_.end(), [&](const Item& one) { return one.name == line->name; });
    if (item == items_.end() || item->type != line->type || item->size != line->size) {
      differing.emplace_back(line->name);
    } else {
      std::memcpy(item->address, bytes.data(), item->size);
    }
    if (item != items_.end()) {
      restored[static_cast<std::size_t>(item - items_.begin())] = true;
    }
    bytes = bytes.subspan(line->size);
  }
  for (std::size_t i = 0; i < items_.size(); ++i) {
    if (!restored[i]) {
      differing.push_back(items_[i].name);
    }
  }
  if (!by_function) {
    differing.emplace_back("what its restore() takes");
  }
  return differing;
}

}  // namespace indurop::node
