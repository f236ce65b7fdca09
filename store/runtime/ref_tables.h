// SPDX-License-Identifier: Apache-2.0
// The tables of variables of everything loaded into this process, and the address of each variable's entry.

#pragma once

#include <indurop/detail/abi.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "store/runtime/attachment.h"
#include "store/runtime/module_file.h"
#include "store/runtime/private_memory.h"

namespace indurop::runtime {

// A variable that stays in private memory although there is a store.
struct BindingProblem {
  std::string text;   // "variable knu::Robot::joints: this program was built with ...: rebuild ..."
  bool used = false;  // the code of the module accesses it; otherwise the problem has no effect
};

class RefTables {
 public:
  // Registers the rows and binds them, to private memory if `to` is null. Returns the problems.
  std::vector<BindingProblem> add(abi::Ref* refs, std::uint32_t count, const Attachment* to);
  void remove(const abi::Ref* refs);
  // Binds the rows of the loaded file that holds `inside` to copies of the present values, which only that file sees,
  // or back to the store.
  void bind_apart(const void* inside, const Attachment& values);
  void bind_back(const void* inside, const Attachment& to);
  // Binds all rows again.
  std::vector<BindingProblem> bind(const Attachment* to);
  [[nodiscard]] bool empty() const noexcept { return tables_.empty(); }
  // Which variables the code of the loaded files reads or writes, by the hash of their names.
  [[nodiscard]] std::map<std::uint64_t, schema::Access> access();
  // A number, not 0, that changes when rows that were bound get other addresses. Any thread; real-time safe.
  [[nodiscard]] static std::uint32_t bindings() noexcept;

 private:
  struct Table {
    abi::Ref* refs = nullptr;
    std::uint32_t count = 0;
    std::uint32_t times = 0;               // one for each source file of the module that includes the header
    std::optional<ModuleFacts> facts;      // read when first needed
    std::unique_ptr<PrivateMemory> apart;  // copies of values; the file may keep addresses of them until it is unloaded
  };
  static void bind_table_apart(Table& table, const Attachment& values);
  void bind_table(Table& table, const Attachment* to, std::vector<BindingProblem>& problems);
  static const ModuleFacts& facts_of(Table& table);
  static BindingProblem describe(Table& table, const abi::Ref& ref, const Attachment& to);

  std::vector<Table> tables_;
  PrivateMemory private_;
};

}  // namespace indurop::runtime
