// SPDX-License-Identifier: Apache-2.0
#include "plc/check/program.h"

#include <algorithm>

namespace indurop::plc {

Variable* Pou::find(const std::string& capitals) const {
  for (const Pou* pou = this; pou != nullptr; pou = pou->owner != nullptr ? pou->owner : pou->base) {
    if (const auto found = pou->names.find(capitals); found != pou->names.end()) {
      return found->second;
    }
  }
  return nullptr;
}

const Pou* Pou::self() const noexcept {
  const bool has_methods = tree->kind == ast::Pou::Kind::Program && !methods.empty();
  return owner != nullptr ? owner : is_block() || has_methods ? this : nullptr;
}

std::string Pou::title() const {
  return owner == nullptr ? name : name.starts_with('@') ? owner->name : owner->name + "." + name;
}

std::vector<const Variable*> all_variables(const Pou& pou) {
  std::vector<const Variable*> out = pou.base != nullptr ? all_variables(*pou.base) : std::vector<const Variable*>();
  for (const Variable& one : pou.variables) {
    out.push_back(&one);
  }
  return out;
}

const Pou* find_method(const Pou& pou, std::string_view name, ast::Accessor accessor) {
  for (const Pou* at = &pou; at != nullptr; at = at->base) {
    const auto found = std::find_if(at->methods.begin(), at->methods.end(), [&](const Pou* one) {
      return one->tree->accessor == accessor && same_name(one->name, name);
    });
    if (found != at->methods.end()) {
      return *found;
    }
  }
  if (pou.tree->kind != ast::Pou::Kind::Interface && !pou.tree->is_abstract) {
    return nullptr;
  }
  for (const Pou* at = &pou; at != nullptr; at = at->base) {
    for (const Pou* one : at->interfaces) {
      if (const Pou* found = find_method(*one, name, accessor)) {
        return found;
      }
    }
  }
  return nullptr;
}

bool is_a(const Pou& pou, const Pou& other) noexcept {
  return &pou == &other || (pou.base != nullptr && is_a(*pou.base, other)) ||
         std::any_of(pou.interfaces.begin(), pou.interfaces.end(), [&](const Pou* one) { return is_a(*one, other); });
}

}  // namespace indurop::plc
