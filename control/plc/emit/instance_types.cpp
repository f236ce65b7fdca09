// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/instance_types.h"

#include <algorithm>
#include <map>
#include <set>

#include "control/plc/emit/watch_layout.h"
#include "control/plc/library/standard.h"
#include "control/plc/lower/chart.h"

namespace indurop::plc {
namespace {

// The function block of an instance, or of an array of them; null for other types.
const Type* block_of(const Type& type) {
  const Type* inner = &type;
  while (inner->kind == Type::Kind::Array) {
    inner = inner->element;
  }
  return inner->kind == Type::Kind::Block ? inner : nullptr;
}

std::size_t instances_in(const Type& type) {
  std::size_t count = 1;
  for (const Type* inner = &type; inner->kind == Type::Kind::Array; inner = inner->element) {
    for (const Bounds& one : inner->dimensions) {
      count *= static_cast<std::size_t>(one.count());
    }
  }
  return count;
}

// Finds the variables that other programs see, too, and that a POU uses by their names without a declaration.
std::vector<const Global*> undeclared(const Pou& pou) {
  std::set<const Global*> declared;
  for (const Variable& one : pou.variables) {
    declared.insert(one.global);
  }
  std::vector<const Global*> out;
  const auto add = [&](const Pou& user) {
    for (const auto& [global, use] : user.globals) {
      const bool shared = global->kind == Global::Kind::Own || global->kind == Global::Kind::Foreign;
      if (shared && declared.insert(global).second) {
        out.push_back(global);
      }
    }
  };
  add(pou);
  for (const Pou* method : pou.methods) {
    add(*method);
  }
  std::sort(out.begin(), out.end(), [](const Global* a, const Global* b) { return a->shared_name < b->shared_name; });
  return out;
}

// Follows the order of watch_layout().
class Collector {
 public:
  InstanceTypes run(const std::vector<const TaskProgram*>& programs) {
    for (const TaskProgram* one : programs) {
      out_.programs.push_back(type_of(*one->pou));
    }
    return std::move(out_);
  }

 private:
  std::size_t type_of(const Pou& pou) {
    if (const auto known = pous_.find(&pou); known != pous_.end()) {
      return known->second;
    }
    InstanceType made;
    made.name = pou.name;
    made.pou = &pou;
    if (pou.base != nullptr) {
      made.base = type_of(*pou.base);
      made.bytes = out_.types[made.base].bytes;
    }
    for (const Variable& one : pou.variables) {
      add(one, made);
    }
    for (const Global* global : undeclared(pou)) {
      made.variables.push_back({global->name, ast::Section::External, global->type, nullptr, global});
    }
    return pous_[&pou] = keep(std::move(made));
  }

  void add(const Variable& variable, InstanceType& to) {
    InstanceVariable made{variable.name, variable.section, variable.type, &variable, variable.global};
    if (is_watched(variable)) {
      made.offset = to.bytes;
      if (const Type* block = block_of(*variable.type)) {
        made.of = block->pou != nullptr ? type_of(*block->pou) : type_of(*block->block);
        to.bytes += instances_in(*variable.type) * out_.types[made.of].bytes;
      } else {
        to.bytes += packed_size(*variable.type);
      }
    }
    made.step = variable.declared->made && variable.type->name == lower::kStepType;
    const bool added = variable.declared->made && !made.step;
    const bool ends_with_call = variable.section == ast::Section::Temp;
    if (!added && !ends_with_call) {
      to.variables.push_back(std::move(made));
    }
  }

  std::size_t type_of(const LibraryBlock& block) {
    if (const auto known = blocks_.find(&block); known != blocks_.end()) {
      return known->second;
    }
    InstanceType made;
    made.name = block.name;
    pins(block.inputs, ast::Section::Input, made);
    pins(block.outputs, ast::Section::Output, made);
    return blocks_[&block] = keep(std::move(made));
  }

  static void pins(const std::vector<LibraryParameter>& pins, ast::Section section, InstanceType& to) {
    for (const LibraryParameter& pin : pins) {
      if (const Type* type = watched_type_of(pin)) {
        InstanceVariable made{pin.name, section, type};
        made.offset = to.bytes;
        to.bytes += packed_size(*type);
        to.variables.push_back(std::move(made));
      }
    }
  }

  std::size_t keep(InstanceType made) {
    out_.types.push_back(std::move(made));
    return out_.types.size() - 1;
  }

  InstanceTypes out_;
  std::map<const Pou*, std::size_t> pous_;
  std::map<const LibraryBlock*, std::size_t> blocks_;
};

}  // namespace

InstanceTypes instance_types(const std::vector<const TaskProgram*>& programs) {
  return Collector().run(programs);
}

}  // namespace indurop::plc
