// SPDX-License-Identifier: Apache-2.0

#include "store/runtime/ref_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

namespace indurop::runtime {

namespace {

// Begins with 1: code that has cached no address yet has seen 0.
std::atomic<std::uint32_t> bindings_done{1};  // NOLINT(*avoid-non-const-global*): one number for the process

std::string type_text(const schema::Type& type) {
  return fmt::format("{} ({} bytes)", display_name(type), type.size());
}

}  // namespace

std::vector<BindingProblem> RefTables::add(abi::Ref* refs, std::uint32_t count, const Attachment* to) {
  std::vector<BindingProblem> problems;
  for (Table& table : tables_) {
    if (table.refs == refs) {
      ++table.times;
      return problems;
    }
  }
  tables_.push_back({refs, count, 1, {}, nullptr});
  bind_table(tables_.back(), to, problems);
  return problems;
}

void RefTables::remove(const abi::Ref* refs) {
  std::erase_if(tables_, [refs](Table& table) { return table.refs == refs && --table.times == 0; });
}

std::vector<BindingProblem> RefTables::bind(const Attachment* to) {
  std::vector<BindingProblem> problems;
  for (Table& table : tables_) {
    bind_table(table, to, problems);
  }
  bindings_done.fetch_add(1, std::memory_order_release);
  return problems;
}

void RefTables::bind_table(Table& table, const Attachment* to, std::vector<BindingProblem>& problems) {
  for (abi::Ref& ref : std::span(table.refs, table.count)) {
    void* entry = nullptr;
    if (to != nullptr) {
      const vars::DirectoryEntry* found = to->store().find(ref.name_hash);
      const bool wrong = found != nullptr && found->type_hash == ref.type_hash &&
                         (found->kind != ref.kind || found->value_size != ref.value_size);
      entry = wrong ? nullptr : to->store().place(ref.name_hash, ref.type_hash);
      if (entry == nullptr) {
        problems.push_back(describe(table, ref, *to));
      }
    }
    // Other threads may be using the old entry, which stays mapped.
    __atomic_store_n(&ref.entry, entry != nullptr ? entry : private_.entry_of(ref), __ATOMIC_RELEASE);
  }
}

void RefTables::bind_table_apart(Table& table, const Attachment& values) {
  table.apart = std::make_unique<PrivateMemory>();
  std::vector<std::uint8_t> bytes;
  for (abi::Ref& ref : std::span(table.refs, table.count)) {
    const vars::DirectoryEntry* found = values.store().find(ref.name_hash);
    abi::Ref copy = ref;
    bytes.resize(ref.value_size);
    if (found != nullptr && found->type_hash == ref.type_hash && found->value_size == ref.value_size &&
        values.store().read(*found, 0, bytes).ok()) {
      copy.initial = bytes.data();
    }
    __atomic_store_n(&ref.entry, table.apart->entry_of(copy), __ATOMIC_RELEASE);
  }
}

void RefTables::bind_apart(const void* inside, const Attachment& values) {
  const void* const image = image_of(inside);
  for (Table& table : tables_) {
    if (image_of(table.refs) == image) {
      bind_table_apart(table, values);
    }
  }
}

void RefTables::bind_back(const void* inside, const Attachment& to) {
  const void* const image = image_of(inside);
  // Scans cache addresses, and the file has had none between the two: the others need not look theirs up again.
  std::vector<BindingProblem> known;  // since the file was loaded
  for (Table& table : tables_) {
    if (image_of(table.refs) == image) {
      bind_table(table, &to, known);
    }
  }
}

std::uint32_t RefTables::bindings() noexcept {
  return bindings_done.load(std::memory_order_acquire);
}

const ModuleFacts& RefTables::facts_of(Table& table) {
  if (!table.facts) {
    table.facts = read_module_of(table.refs);
  }
  return *table.facts;
}

std::map<std::uint64_t, schema::Access> RefTables::access() {
  std::map<std::uint64_t, schema::Access> all;
  for (Table& table : tables_) {
    for (const auto& [name_hash, access] : facts_of(table).file.access) {
      all[name_hash].reads = all[name_hash].reads || access.reads;
      all[name_hash].writes = all[name_hash].writes || access.writes;
    }
  }
  return all;
}

BindingProblem RefTables::describe(Table& table, const abi::Ref& ref, const Attachment& to) {
  const ModuleFacts& facts = facts_of(table);
  BindingProblem problem;
  problem.used = facts.uses(ref.name_hash);
  const schema::Variable* mine = facts.variable(ref.name_hash);
  const vars::DirectoryEntry* entry = to.store().find(ref.name_hash);
  if (entry == nullptr) {
    problem.text = fmt::format(
        "variable {}: node '{}' does not have it, so no other process sees it: name this program in the node's "
        "module.xml "
        "and restart the node",
        ref.name, to.node());
    return problem;
  }
  const auto& variables = to.store().schema().variables;
  const schema::Variable* theirs = entry->schema_index < variables.size() ? &variables[entry->schema_index] : nullptr;
  const std::string difference = mine != nullptr && theirs != nullptr ? first_difference(mine->type, theirs->type) : "";
  problem.text =
      fmt::format("variable {}: this program was built with {}, node '{}' has {}{}{}: rebuild against the same .glb",
                  ref.name, mine != nullptr ? type_text(mine->type) : fmt::format("{} bytes", ref.value_size),
                  to.node(), theirs != nullptr ? type_text(theirs->type) : fmt::format("{} bytes", entry->value_size),
                  difference.empty() ? "" : "; ", difference);
  return problem;
}

}  // namespace indurop::runtime
