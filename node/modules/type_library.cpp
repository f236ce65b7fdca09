// SPDX-License-Identifier: Apache-2.0
#include "node/modules/type_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

namespace indurop::node {

TypeLibraries::~TypeLibraries() {
  for (const Library& library : libraries_) {
    ::dlclose(library.handle);
  }
}

void TypeLibraries::load(const config::TypeFiles& files, std::vector<std::string>& problems) {
  for (std::size_t i = 0; i < files.types.size(); ++i) {
    void* handle = ::dlopen(files.types[i].c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) {
      const char* reason = ::dlerror();
      problems.push_back(fmt::format("cannot load the types library {}: {}", files.types_as_written[i],
                                     reason != nullptr ? reason : "unknown reason"));
      continue;
    }
    libraries_.push_back({files.types_as_written[i], handle});
  }
}

TypeLibraries::Found TypeLibraries::find(const std::string& symbol) const {
  for (const Library& library : libraries_) {
    if (const void* found = ::dlsym(library.handle, symbol.c_str()); found != nullptr) {
      return {found, library.name};
    }
  }
  return {};
}

}  // namespace indurop::node
