// SPDX-License-Identifier: Apache-2.0
// Libraries of DDS types built by indurop_add_glb(... TYPES), loaded to look up descriptors by name.

#pragma once

#include <string>
#include <vector>

#include "config/model/config.h"

namespace indurop::node {

class TypeLibraries {
 public:
  TypeLibraries() = default;
  TypeLibraries(TypeLibraries&&) noexcept = default;
  TypeLibraries& operator=(TypeLibraries&&) = delete;
  TypeLibraries(const TypeLibraries&) = delete;
  TypeLibraries& operator=(const TypeLibraries&) = delete;
  ~TypeLibraries();

  // Libraries that cannot be loaded are left out and reported in `problems`.
  void load(const config::TypeFiles& files, std::vector<std::string>& problems);

  struct Found {
    const void* descriptor = nullptr;  // valid as long as the libraries are loaded; null: not found
    std::string library;               // as written in the XML
  };
  // Returns the match in the first library that has one.
  [[nodiscard]] Found find(const std::string& symbol) const;

 private:
  struct Library {
    std::string name;
    void* handle = nullptr;
  };
  std::vector<Library> libraries_;
};

}  // namespace indurop::node
