// SPDX-License-Identifier: Apache-2.0
// What another file of a module declares that the node of the recording does not have, or has with another type: a
// shadow runs with it, as the node would after the exchange.

#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/schema/schema.h"
#include "node/modules/module_library.h"

namespace indurop::node {

struct OtherDeclarations {
  std::set<std::uint64_t> appearing;     // hashes of the names of variables that the node does not have
  std::vector<schema::Variable> former;  // of variables whose type changes, as the node has them
  // The same for the report, as a plan of the exchange names them: "cell::limit", "cell::axis.more".
  std::vector<std::string> added;
  std::vector<std::string> converted;
};

// Compares what the code of a version uses, and what its .glb files declare, with the store of this node, which is only
// read. Returns nothing if the node has no store on this machine. Not real-time safe.
OtherDeclarations other_declarations(const std::string& node, const ModuleLibrary::Uses& uses,
                                     std::span<const schema::Variable> declared);

// Returns nullptr if the type of this variable does not change.
const schema::Variable* former_of(std::span<const schema::Variable> former, std::uint64_t name_hash) noexcept;

}  // namespace indurop::node
