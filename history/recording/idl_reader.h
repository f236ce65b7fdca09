// SPDX-License-Identifier: Apache-2.0
// The structs and enums of an OMG IDL text, as history/recording/omg_idl.h writes them; the names of types are full.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::recording {

inline constexpr int kMaxIdlDepth = 32;  // of types within types

struct IdlMember {
  std::string type;         // "string" for all texts
  std::uint64_t bound = 0;  // characters of a bounded string; 0: none is stated
  std::string name;
  std::vector<std::uint64_t> dims;
};
struct IdlEnumerator {
  std::string name;
  std::int64_t value = 0;
};
struct IdlDefinition {
  bool is_enum = false;
  std::vector<IdlMember> members;
  std::vector<IdlEnumerator> enumerators;
};
using IdlDefinitions = std::map<std::string, IdlDefinition>;

// Returns nothing for IDL that it does not understand.
std::optional<IdlDefinitions> read_idl(std::string_view text);

// Returns true for a struct that only wraps its member `value`, because a message must be a struct.
bool is_wrapper(const std::string& name, const IdlDefinition& definition);

}  // namespace indurop::recording
