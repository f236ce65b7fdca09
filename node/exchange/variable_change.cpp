// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/variable_change.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <indurop/detail/abi.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/schema/carry.h"
#include "core/schema/conversion.h"

namespace indurop::node {
namespace {

using Bytes = std::vector<std::uint8_t>;

// Of a scalar, it is its value.
const std::atomic<std::uint64_t>* version_of(void* entry, abi::Kind kind) noexcept {
  return kind == abi::Kind::Ring ? &static_cast<abi::RingHeader*>(entry)->seq
                                 : static_cast<std::atomic<std::uint64_t>*>(entry);
}

bool is_forced(const vars::Store& store, std::uint64_t name_hash) {
  const std::vector<vars::Force> forces = store.forces();
  return std::any_of(forces.begin(), forces.end(),
                     [name_hash](const vars::Force& force) { return force.variable->name_hash == name_hash; });
}

Bytes initial_value(const schema::Variable& variable) {
  return variable.initial.empty() ? Bytes(variable.type.size()) : variable.initial;
}

// Returns lines for values that do not fit; nothing if the present value cannot be read.
std::optional<std::vector<std::string>> convert_value(const vars::Store& store, const VariableChange::Changed& one,
                                                      Bytes& to) {
  const vars::DirectoryEntry* const entry = store.find(one.from.name_hash());
  Bytes from(one.from.type.size());
  if (entry == nullptr || entry->type_hash != one.from.type_hash || !store.read(*entry, 0, from).ok()) {
    return std::nullopt;
  }
  return schema::carry_what_fits(one.from.name, {one.from.type, one.from.unit}, from, {one.to.type, one.to.unit}, to);
}

}  // namespace

VariableChange VariableChange::of(const vars::Store& store, const ModuleLibrary::Uses& uses,
                                  std::span<const schema::Variable> declared) {
  VariableChange change;
  for (const schema::Variable& variable : declared) {
    const vars::DirectoryEntry* const entry = store.find(variable.name_hash());
    if (entry == nullptr) {
      change.appearing_.push_back(variable);
    } else if (entry->type_hash != variable.type_hash && uses.contains(variable.name_hash())) {
      change.changed_.push_back({store.schema().variables[entry->schema_index], variable});
    }
  }
  return change;
}

VariableChange VariableChange::back_to(vars::Store& store, const ModuleLibrary::Uses& uses) {
  std::vector<schema::Variable> declared;
  for (const auto& [name, use] : uses) {
    if (auto variable = store.growth().declared(name, use.type); variable) {
      declared.push_back(*std::move(variable));
    }
  }
  VariableChange change = of(store, uses, declared);
  change.back_ = true;
  return change;
}

std::vector<schema::Variable> VariableChange::places() const {
  std::vector<schema::Variable> all = appearing_;
  std::transform(changed_.begin(), changed_.end(), std::back_inserter(all), [](const Changed& one) { return one.to; });
  return all;
}

bool VariableChange::list(const vars::Store& store, operate::ReloadPlan& plan) const {
  for (const schema::Variable& variable : appearing_) {
    plan.appeared.push_back(variable.name);
  }
  for (const Changed& one : changed_) {
    const schema::Conversion parts = schema::convert(one.from, one.to);
    plan.converted.insert(plan.converted.end(), parts.carried.begin(), parts.carried.end());
    plan.appeared.insert(plan.appeared.end(), parts.added.begin(), parts.added.end());
    plan.lost.insert(plan.lost.end(), parts.lost.begin(), parts.lost.end());
    Bytes to = initial_value(one.to);
    if (const auto misfits = convert_value(store, one, to); misfits) {
      plan.lost.insert(plan.lost.end(), misfits->begin(), misfits->end());
    }
  }
  return !plan.lost.empty();
}

bool VariableChange::let_appear(vars::Store& store) {
  std::erase_if(appearing_, [&store](const schema::Variable& one) {
    return store.entry(one.name_hash(), one.type_hash) != nullptr;
  });
  if (appearing_.empty()) {
    return true;
  }
  const bool taken = std::any_of(appearing_.begin(), appearing_.end(), [&store](const schema::Variable& one) {
    return store.find(one.name_hash()) != nullptr;
  });
  auto next = taken ? Result<vars::NextCatalog>(Error{Errc::TypeMismatch, 0, "variable"}) : store.prepare(appearing_);
  if (!next) {
    return false;
  }
  store.announce(std::move(next).value());
  return true;
}

bool VariableChange::changes_type_of(std::uint64_t name_hash) const noexcept {
  return std::any_of(changed_.begin(), changed_.end(),
                     [name_hash](const Changed& one) { return one.from.name_hash() == name_hash; });
}

bool VariableChange::prepare(vars::Store& store, scheduler::Exchange::Settings& settings) {
  if (changed_.empty()) {
    return true;
  }
  std::vector<schema::Variable> now;
  std::transform(changed_.begin(), changed_.end(), std::back_inserter(now), [](const Changed& one) { return one.to; });
  auto next = store.prepare(now);
  if (!next) {
    return false;
  }
  next_ = std::move(next).value();
  for (const vars::NextCatalog::Word& word : next_->words) {
    settings.words.push_back({word.to, word.value});
  }
  for (const Changed& one : changed_) {
    void* const place = store.place(one.from.name_hash(), one.from.type_hash);
    if (place == nullptr) {
      return false;
    }
    settings.zeros.push_back(&abi::forces_offset_of(place, one.from.kind));
    settings.versions.push_back({version_of(place, one.from.kind)});
  }
  return true;
}

std::string VariableChange::carry(vars::Store& store, bool lossy) const {
  for (const Changed& one : changed_) {
    Bytes to = initial_value(one.to);
    if (back_ && !store.growth().read(one.to.name_hash(), one.to.type_hash, to)) {
      return fmt::format("variable {} cannot be read", one.to.name);
    }
    const auto misfits = convert_value(store, one, to);
    if (!misfits) {
      return fmt::format("variable {} cannot be read", one.from.name);
    }
    if (!misfits->empty() && !lossy) {
      return fmt::format("a value would be lost: {}", fmt::join(*misfits, "; "));
    }
    if (!store.growth().write(one.to.name_hash(), one.to.type_hash, to)) {
      return fmt::format("variable {} cannot be written", one.to.name);
    }
  }
  return "";
}

std::string VariableChange::forced(const vars::Store& store) const {
  const auto found = std::find_if(changed_.begin(), changed_.end(),
                                  [&store](const Changed& one) { return is_forced(store, one.from.name_hash()); });
  return found != changed_.end() ? found->from.name : "";
}

void VariableChange::follow(vars::Store& store) {
  if (next_) {
    store.follow(std::move(*std::exchange(next_, std::nullopt)));
  }
}

std::string VariableChange::change_at_once(vars::Store& store, bool lossy) {
  scheduler::Exchange::Settings words;
  if (!prepare(store, words)) {
    return "there is no memory for the variables whose types change";
  }
  if (std::any_of(words.zeros.begin(), words.zeros.end(), [](const auto* forced) { return forced->load() != 0; })) {
    return "a variable whose type changes is forced: release it (indurop unforce)";
  }
  if (std::string why = carry(store, lossy); !why.empty()) {
    return why;
  }
  if (next_) {
    store.announce(std::move(*std::exchange(next_, std::nullopt)));
  }
  return "";
}

namespace {

// Returns why the type of one variable cannot change; empty: it can.
std::string objection(const VariableChange::Changed& one, const TypeUsers& users) {
  const std::uint64_t hash = one.from.name_hash();
  for (std::size_t i = 0; i < users.libraries.size(); ++i) {
    const bool uses = users.libraries[i].uses().contains(hash) || users.configured[i].contains(hash);
    if (i != users.module && uses) {
      return fmt::format("module {}, which stays, uses its layout", users.config.modules[i].name);
    }
  }
  for (const config::Module& module : users.config.modules) {
    for (const config::FailSafe& failsafe : module.failsafe) {
      const auto place = schema::find_place(users.store.schema(), failsafe.variable);
      if (place && place->variable->name_hash() == hash) {
        return fmt::format("module {} has a fail-safe value for it", module.name);
      }
    }
  }
  return is_forced(users.store, hash) ? "it is forced: release it (indurop unforce)" : "";
}

}  // namespace

ConfiguredUses configured_uses_of(const config::CheckResult& check, std::size_t index, const std::string& module) {
  ConfiguredUses uses;
  const auto names_it = [&module](const std::vector<std::string>& modules) {
    return std::find(modules.begin(), modules.end(), module) != modules.end();
  };
  for (const config::VariableUse& use : check.uses) {
    const std::uint64_t hash = abi::fnv1a64(use.name.data(), use.name.size());
    const bool by_code = index < check.facts.size() && check.facts[index].file.access.contains(hash);
    if (!by_code && (names_it(use.readers) || names_it(use.writers))) {
      uses.insert(hash);
    }
  }
  return uses;
}

std::vector<std::string> objections(const VariableChange& change, const TypeUsers& users) {
  std::vector<std::string> all;
  for (const VariableChange::Changed& one : change.changed()) {
    if (const std::string why = objection(one, users); !why.empty()) {
      all.push_back(fmt::format("variable {} has another layout in this node: {}; {}", one.from.name,
                                schema::first_difference(one.to.type, one.from.type), why));
    }
  }
  return all;
}

}  // namespace indurop::node
