// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/shared_names.h"

#include <set>

#include "glb2idl/names.h"

namespace indurop::plc {
namespace {

using glb2idl::NameRole;

std::string allowed(std::string_view name, NameRole role, bool global) {
  return glb2idl::objection(name, role, global) ? glb2idl::proposal(name, role, global) : std::string(name);
}

// Names that stay unchanged are assigned first, so that no other item gets them. `reserved`: further names that cannot
// be used.
template <class List, class Reserved>
void name_all(List& list, NameRole role, Reserved reserved) {
  std::set<std::string> taken;
  for (const bool keep : {true, false}) {
    for (auto& one : list) {
      std::string name = allowed(one.name, role, false);
      const bool kept = name == one.name && !reserved(name);
      if (kept != keep || !one.shared.empty()) {
        continue;
      }
      while (reserved(name) || taken.contains(upper(name))) {
        name += "_value";
      }
      taken.insert(upper(name));
      one.shared = std::move(name);
    }
  }
}

struct Named {
  std::string name;
  std::string shared;
};

}  // namespace

void name_types(Context& context) {
  std::vector<Named> types;
  std::set<std::string> names;
  for (const Type* type : context.program.named_types) {
    types.push_back({type->name, type->shared_name.empty() ? "" : type->name});
  }
  name_all(types, NameRole::Type, [](const std::string&) { return false; });
  for (const Named& one : types) {
    names.insert({one.name, one.shared});
  }
  auto named = types.begin();
  for (Type* type : context.program.named_types) {
    const std::string shared = (named++)->shared;
    if (!type->shared_name.empty()) {
      continue;  // of another .glb: unchanged
    }
    type->glb_name = shared;
    name_all(type->fields, NameRole::Field, [&](const std::string& name) {  // IDL ignores case
      return names.contains(name) || same_name(name, type->name) || same_name(name, shared);
    });
    name_all(type->items, NameRole::Enumerator, [](const std::string&) { return false; });
  }
}

std::string name_of_shared(std::string_view name) {
  return allowed(name, NameRole::Variable, false);
}

std::string name_of_space(std::string_view name) {
  return name == "main" ? "plc" : allowed(name, NameRole::Namespace, true);  // C++ keeps the name main for itself
}

std::string_view last_name(std::string_view full) noexcept {
  const std::size_t at = full.rfind("::");
  return at == std::string_view::npos ? full : full.substr(at + 2);
}

}  // namespace indurop::plc
