// SPDX-License-Identifier: Apache-2.0
// Finds the comment that describes a declaration: the one after it on its line, else those directly above it.

#pragma once

#include <string>
#include <vector>

#include "glb2idl/token_reader.h"

namespace indurop::glb2idl {

class Descriptions {
 public:
  Descriptions(const Sources& sources, std::uint32_t file, const std::vector<Comment>& comments)
      : sources_(sources), file_(file), comments_(comments) {}

  // Returns the description of the declaration that began with token `begin` of `in` and has just been read.
  [[nodiscard]] std::string find(const TokenReader& in, std::size_t begin) const;

 private:
  [[nodiscard]] std::string above(Span first) const;

  const Sources& sources_;
  std::uint32_t file_;
  const std::vector<Comment>& comments_;
};

}  // namespace indurop::glb2idl
