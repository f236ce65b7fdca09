// SPDX-License-Identifier: Apache-2.0
#include "node/replay/other_declarations.h"

#include <algorithm>
#include <utility>

#include "node/exchange/variable_change.h"
#include "store/operate/reload.h"
#include "store/vars/store.h"

namespace indurop::node {

OtherDeclarations other_declarations(const std::string& node, const ModuleLibrary::Uses& uses,
                                     std::span<const schema::Variable> declared) {
  OtherDeclarations others;
  const auto store = vars::Store::attach(node, vars::Mode::ReadOnly);
  if (!store) {
    return others;
  }
  for (const schema::Variable& variable : declared) {
    if (store->find(variable.name_hash()) == nullptr) {
      others.appearing.insert(variable.name_hash());
    }
  }
  const VariableChange change = VariableChange::of(*store, uses, declared);
  for (const VariableChange::Changed& one : change.changed()) {
    others.former.push_back(one.from);
  }
  operate::ReloadPlan plan;
  (void)change.list(*store, plan);
  others.added = std::move(plan.appeared);
  others.converted = std::move(plan.converted);
  return others;
}

const schema::Variable* former_of(std::span<const schema::Variable> former, std::uint64_t name_hash) noexcept {
  const auto found = std::find_if(former.begin(), former.end(),
                                  [name_hash](const schema::Variable& one) { return one.name_hash() == name_hash; });
  return found != former.end() ? &*found : nullptr;
}

}  // namespace indurop::node
