// SPDX-License-Identifier: Apache-2.0
// Compiles .glb texts that live in the test instead of in files.

#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "glb2idl/compiler.h"
#include "glb2idl/emit.h"

namespace indurop::glb2idl::test {

using Files = std::map<std::string, std::string>;

inline Compilation compile_files(const Files& files, const std::vector<std::string>& inputs) {
  return compile(inputs, [&files](const std::string& path) {
    const auto found = files.find(path);
    return found == files.end() ? ReadResult{std::nullopt, "", "there is no such file"}
                                : ReadResult{found->second, path, ""};
  });
}

inline std::string messages(const Compilation& compilation) {
  return base::to_text(compilation.diagnostics, "glb2idl");
}

inline Compilation compile_text(const std::string& text) {
  return compile_files({{"in.glb", text}}, {"in.glb"});
}

// The variable of that full name.
inline schema::Variable variable(const Compilation& compilation, const std::string& name) {
  for (const GlbFile& unit : compilation.program.units) {
    for (const Item& item : unit.items) {
      const auto* found = std::get_if<schema::Variable>(&item);
      if (found != nullptr && found->name == name) {
        return *found;
      }
    }
  }
  throw std::runtime_error("no variable " + name + "\n" + messages(compilation));
}

}  // namespace indurop::glb2idl::test
