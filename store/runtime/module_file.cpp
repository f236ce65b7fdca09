// SPDX-License-Identifier: Apache-2.0

#include "store/runtime/module_file.h"

#include <dlfcn.h>
#include <link.h>

#include <optional>
#include <utility>

namespace indurop::runtime {

namespace {

// Without the lock of the loader, unlike dladdr(): dlopen() holds that one while a module registers what it uses, and
// waits for locks that callers of this function hold.
std::optional<dl_find_object> find_object(const void* address) noexcept {
  dl_find_object found{};
  const bool done = ::_dl_find_object(const_cast<void*>(address), &found) == 0;  // NOLINT(*-const-cast): only read
  return done ? std::optional(found) : std::nullopt;
}

}  // namespace

const schema::Variable* ModuleFacts::variable(std::uint64_t name_hash) const noexcept {
  for (const auto& variable : schema.variables) {
    if (variable.name_hash() == name_hash) {
      return &variable;
    }
  }
  return nullptr;
}

bool ModuleFacts::uses(std::uint64_t name_hash) const noexcept {
  if (!readable) {
    return true;
  }
  const auto found = file.access.find(name_hash);
  return found != file.access.end() && (found->second.reads || found->second.writes);
}

// Not where it is mapped: the segments of a file may lie apart (ARM64 aligns them to 64 KiB), and each has its own
// start.
const void* image_of(const void* address) noexcept {
  const auto found = find_object(address);
  return found ? found->dlfo_link_map : nullptr;
}

std::string path_of(const void* address) {
  const auto found = find_object(address);
  if (!found) {
    return {};
  }
  const std::string name = found->dlfo_link_map->l_name;
  return name.empty() ? "/proc/self/exe" : name;  // the program itself has no name
}

ModuleFacts read_module_of(const void* address) {
  ModuleFacts facts;
  facts.path = path_of(address);
  auto file = schema::read_module_file(facts.path);
  if (!file) {
    return facts;
  }
  facts.readable = true;
  facts.file = std::move(file).value();
  if (auto schema = schema::from_json(facts.file.schema_json)) {
    facts.schema = std::move(schema).value();
  }
  return facts;
}

}  // namespace indurop::runtime
