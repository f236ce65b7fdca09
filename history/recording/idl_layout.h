// SPDX-License-Identifier: Apache-2.0
// The layout of a channel's messages, from its OMG IDL: the numbers of a struct one after the other, as in CDR. For
// readers of recordings who do not know our types; understands what history/recording/omg_idl.h writes.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"

namespace indurop::recording {

struct IdlLeaf {
  enum class Kind : std::uint8_t { Bool, Char, I8, U8, I16, U16, I32, U32, I64, U64, F32, F64, Enum, Text };
  std::string name;  // appended to the channel's name: ".x", "[2].y"; empty: the whole value
  Kind kind{};
};

inline constexpr std::size_t kMaxLeaves = 4096;

// Returns the numbers of struct `name` of this text, in the order of its bytes. A struct of module indurop with the
// single member `value` is replaced by that member. Errors: unsupported IDL; more than kMaxLeaves.
Result<std::vector<IdlLeaf>, base::Problem> idl_layout(std::string_view text, std::string_view name);

// Reads one number for each leaf; texts become NaN. Returns false if `cdr` is no such message.
bool read_leaves(const std::vector<IdlLeaf>& layout, std::span<const std::uint8_t> cdr, std::vector<double>& values);

// Reads the leaves as texts, without loss: "-5", "0.1", "true", a text unchanged.
bool read_leaf_texts(const std::vector<IdlLeaf>& layout, std::span<const std::uint8_t> cdr,
                     std::vector<std::string>& values);

}  // namespace indurop::recording
