// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/program.h"

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

const std::vector<const Variable*>& parameters_of(const Pou& pou) {
  if (!pou.parameters) {
    pou.parameters = pou.base != nullptr ? parameters_of(*pou.base) : std::vector<const Variable*>();
    for (const Variable& one : pou.variables) {
      if (one.section == ast::Section::Input || one.section == ast::Section::Output ||
          one.section == ast::Section::InOut) {
        pou.parameters->push_back(&one);
      }
    }
  }
  return *pou.parameters;
}

const Pou* find_method(const Pou& pou, std::string_view name, ast::Accessor accessor) {
  const std::pair key(accessor, upper(name));
  for (const Pou* at = &pou; at != nullptr; at = at->base) {
    if (const auto found = at->method_names.find(key); found != at->method_names.end()) {
      return found->second;
    }
  }
  if (pou.tree->kind != ast::Pou::Kind::Interface && !pou.tree->is_abstract) {
    return nullptr;
  }
  for (auto at = pou.ancestors.rbegin(); at != pou.ancestors.rend(); ++at) {
    const bool is_interface = (*at)->tree->kind == ast::Pou::Kind::Interface;
    if (const auto found = (*at)->method_names.find(key); is_interface && found != (*at)->method_names.end()) {
      return found->second;
    }
  }
  return nullptr;
}

bool is_a(const Pou& pou, const Pou& other) noexcept {
  return &pou == &other || std::find(pou.ancestors.begin(), pou.ancestors.end(), &other) != pou.ancestors.end();
}

}  // namespace indurop::plc
