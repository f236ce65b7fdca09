// SPDX-License-Identifier: Apache-2.0

#include "store/runtime/module_file.h"

#include <dlfcn.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace indurop::runtime {

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

std::string path_of(const void* address) {
  Dl_info info{};
  if (::dladdr(address, &info) == 0 || info.dli_fname == nullptr) {
    return {};
  }
  // The program itself is reported as it was invoked, which need not be a path.
  return std::strcmp(info.dli_fname, program_invocation_name) == 0 ? "/proc/self/exe" : info.dli_fname;
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
