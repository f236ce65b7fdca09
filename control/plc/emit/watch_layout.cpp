// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/watch_layout.h"

#include <indurop/detail/abi.h>

#include <algorithm>
#include <bit>

#include "control/plc/check/shared_names.h"
#include "control/plc/library/standard.h"

namespace indurop::plc {
namespace {

constexpr std::size_t kMarkBytes = 8;
constexpr std::size_t kStepBytes = 256;           // at least, of the size of a program's variable
constexpr std::size_t kMaxVariableBytes = 16384;  // of one variable: larger arrays are not reported

bool is_watchable(const Type& type) {
  switch (type.kind) {
    case Type::Kind::Elementary:
    case Type::Kind::Enum:
    case Type::Kind::Block:
      return true;
    case Type::Kind::Array:
      return is_watchable(*type.element);
    case Type::Kind::Struct:
      return !type.overlaps && std::all_of(type.fields.begin(), type.fields.end(),
                                           [](const Field& one) { return is_watchable(*one.type); });
    case Type::Kind::Pointer:
    case Type::Kind::Interface:
      break;
  }
  return false;
}

std::uint64_t count_of(const Type& array) {
  std::uint64_t count = 1;
  for (const Bounds& one : array.dimensions) {
    count *= one.count();
  }
  return count;
}

// Sizes are a few, at most a quarter or 256 bytes too large: usually, a program that gets another rung can be exchanged
// while its node runs, because the type of this variable stays.
std::size_t rounded(std::size_t bytes) {
  const std::size_t step = std::max(kStepBytes, std::bit_floor(bytes) / 4);
  return (bytes + step - 1) / step * step;
}

bool holds_blocks(const Type& type) {
  return type.kind == Type::Kind::Block || (type.kind == Type::Kind::Array && holds_blocks(*type.element));
}

class Layout {
 public:
  WatchLayout run(const TaskProgram& program) {
    out_.variable = name_of_shared(program.instance + "_watch");
    out_.bytes = kMarkBytes;
    pou(*program.pou, {});
    out_.bytes = rounded(out_.bytes);
    std::string text = std::to_string(program.text) + "\n";
    for (const WatchedVariable& one : out_.variables) {
      text += one.path + ":" + to_string(*one.type) + "\n";
    }
    out_.mark = abi::fnv1a64(text.data(), text.size());
    return std::move(out_);
  }

  FrameLayout frame(const Pou& pou) {
    if (const Pou* holder = holder_of(pou)) {
      members(*holder, {});
    }
    for (const Variable* one : variables_of_call(pou)) {
      variable(*one->type, one->name);
    }
    if (is_result_watchable(pou)) {
      variable(*pou.result, pou.name);
    }
    return {out_.bytes, std::move(out_.variables)};
  }

  FrameLayout globals(const std::vector<const Global*>& globals) {
    for (const Global* one : globals) {
      if (is_global_watchable(*one)) {
        variable(*one->type, one->name);
      }
    }
    return {out_.bytes, std::move(out_.variables)};
  }

 private:
  // The name as written: "Motor.delay".
  using Name = std::string;

  void pou(const Pou& pou, const Name& name) {
    out_.instances.push_back({upper(name), name, &pou});
    members(pou, name);
  }

  // Inherited ones first.
  void members(const Pou& pou, const Name& name) {
    if (pou.base != nullptr) {
      members(*pou.base, name);
    }
    for (const Variable& one : pou.variables) {
      if (is_watched(one)) {
        variable(*one.type, (name.empty() ? "" : name + ".") + one.name);
      }
    }
  }

  void variable(const Type& type, const Name& name) {
    if (type.kind == Type::Kind::Array && holds_blocks(type)) {
      elements(type, name, 0, "");
    } else if (type.kind != Type::Kind::Block) {
      out_.variables.push_back({upper(name), &type, out_.bytes, name});
      out_.bytes += packed_size(type);
    } else if (type.pou != nullptr) {
      pou(*type.pou, name);
    } else {
      library(*type.block, name);
    }
  }

  void elements(const Type& array, const Name& name, std::size_t dimension, const std::string& indices) {
    if (dimension == array.dimensions.size()) {
      variable(*array.element, name + "[" + indices + "]");
      return;
    }
    const Bounds& bounds = array.dimensions[dimension];
    for (std::int64_t i = bounds.low; i <= bounds.high; ++i) {
      elements(array, name, dimension + 1, indices + (indices.empty() ? "" : ",") + std::to_string(i));
    }
  }

  void library(const LibraryBlock& block, const Name& name) {
    for (const auto* pins : {&block.inputs, &block.outputs}) {
      for (const LibraryParameter& pin : *pins) {
        if (const Type* type = watched_type_of(pin)) {
          const Name of_pin = name + "." + pin.name;
          out_.variables.push_back({upper(of_pin), type, out_.bytes, of_pin});
          out_.bytes += packed_size(*type);
        }
      }
    }
  }

  WatchLayout out_;
};

}  // namespace

const WatchedVariable* WatchLayout::find(std::string_view path) const {
  const auto found =
      std::find_if(variables.begin(), variables.end(), [&](const WatchedVariable& one) { return one.path == path; });
  return found == variables.end() ? nullptr : &*found;
}

bool is_watched(const Variable& variable) {
  using ast::Section;
  return variable.section != Section::External && variable.section != Section::Temp &&
         variable.section != Section::InOut && variable.global == nullptr && !variable.is_constant &&
         !variable.declared->is_static && !variable.declared->of_instance && is_watchable(*variable.type) &&
         packed_size(*variable.type) <= kMaxVariableBytes;
}

const Type* watched_type_of(const LibraryParameter& pin) {
  static const TypeTable kTypes;
  const auto* known = std::get_if<Elementary>(&pin.type);
  return known == nullptr || is_text(*known) ? nullptr : kTypes.elementary(*known);
}

std::size_t packed_size(const Type& type) {
  constexpr unsigned kBits = 8;
  switch (type.kind) {
    case Type::Kind::Elementary:
      if (type.is_text()) {
        return (type.length + 1) * (type.is(Elementary::Wstring) ? 2 : 1);
      }
      [[fallthrough]];
    case Type::Kind::Enum:
      return std::max(bits_of(type.elementary), kBits) / kBits;
    case Type::Kind::Array: {
      const std::uint64_t count = std::min<std::uint64_t>(count_of(type), kMaxVariableBytes + 1);
      return std::min<std::size_t>(count * packed_size(*type.element), kMaxVariableBytes + 1);
    }
    case Type::Kind::Struct: {
      std::size_t sum = 0;
      for (const Field& one : type.fields) {
        sum += packed_size(*one.type);
      }
      return sum;
    }
    case Type::Kind::Block:  // its contents are watched separately; in an array its number counts
      return 1;
    case Type::Kind::Pointer:
    case Type::Kind::Interface:
      break;
  }
  return 0;
}

WatchLayout watch_layout(const TaskProgram& program) {
  return Layout().run(program);
}

FrameLayout frame_layout(const Pou& pou) {
  return Layout().frame(pou);
}

FrameLayout globals_layout(const std::vector<const Global*>& globals) {
  return Layout().globals(globals);
}

const Pou* holder_of(const Pou& pou) {
  return pou.owner != nullptr ? pou.owner : pou.is_callable() ? nullptr : &pou;
}

std::vector<const Variable*> variables_of_call(const Pou& pou) {
  using ast::Section;
  std::vector<const Variable*> out;
  for (const Variable& one : pou.variables) {
    const bool of_call = pou.is_callable() || one.section == Section::Temp || one.section == Section::InOut;
    const bool elsewhere = one.section == Section::External || one.global != nullptr || one.is_constant ||
                           one.declared->of_instance || one.type->open;
    if (of_call && !elsewhere && is_watchable(*one.type) && !holds_blocks(*one.type) &&
        packed_size(*one.type) <= kMaxVariableBytes) {
      out.push_back(&one);
    }
  }
  return out;
}

bool is_result_watchable(const Pou& pou) {
  return pou.result != nullptr && is_watchable(*pou.result) && packed_size(*pou.result) <= kMaxVariableBytes;
}

bool is_global_watchable(const Global& global) {
  return global.kind != Global::Kind::Fixed && is_watchable(*global.type) &&
         packed_size(*global.type) <= kMaxVariableBytes;
}

}  // namespace indurop::plc
