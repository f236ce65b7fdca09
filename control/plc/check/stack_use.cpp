// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/stack_use.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "control/plc/check/saturating.h"
#include "control/plc/model/walk.h"

namespace indurop::plc {
namespace {

// A quarter of the stack: calls through interfaces are not visible here, and the compiler has temporaries of its own.
constexpr std::uint64_t kMaxStackBytes = std::uint64_t{128} * 1024;

// Sizes approximately as in C++.
class Sizes {
 public:
  std::uint64_t of(const Type& type) {
    if (const auto known = known_.find(&type); known != known_.end()) {
      return known->second;
    }
    const std::uint64_t bytes = computed(type);
    known_.emplace(&type, bytes);
    return bytes;
  }

 private:
  std::uint64_t computed(const Type& type) {
    constexpr std::uint64_t kPointer = 24;
    constexpr std::uint64_t kSlice = 64;
    constexpr std::uint64_t kLibraryBlock = 128;
    if (type.is_text()) {
      return (type.length + 1) * (type.is(Elementary::Wstring) ? sizeof(char16_t) : 1);
    }
    switch (type.kind) {
      case Type::Kind::Elementary:
      case Type::Kind::Enum:
        return (bits_of(type.elementary) + 7) / 8;
      case Type::Kind::Pointer:
      case Type::Kind::Interface:
        return kPointer;
      case Type::Kind::Array:
        return type.open ? kSlice : array(type);
      case Type::Kind::Struct:
        return structure(type);
      case Type::Kind::Block:
        return type.pou != nullptr ? instance(*type.pou) : kLibraryBlock;
    }
    return 0;
  }

  std::uint64_t array(const Type& type) {
    std::uint64_t bytes = of(*type.element);
    for (const Bounds& one : type.dimensions) {
      bytes = product_of(bytes, one.count());
    }
    return bytes;
  }

  std::uint64_t structure(const Type& type) {
    std::uint64_t bytes = 0;
    for (const Field& one : type.fields) {
      bytes = type.overlaps ? std::max(bytes, of(*one.type)) : sum_of(bytes, of(*one.type));
    }
    return bytes;
  }

  std::uint64_t instance(const Pou& pou) {
    std::uint64_t bytes = 0;
    for (const Variable* one : all_variables(pou)) {
      if (one->type != nullptr && one->global == nullptr && one->section != ast::Section::Temp) {
        bytes = sum_of(bytes, one->section == ast::Section::InOut ? sizeof(void*) : of(*one->type));
      }
    }
    return bytes;
  }

  std::map<const Type*, std::uint64_t> known_;
};

// One contribution to the stack of a call.
struct Part {
  std::string name;
  Place at;
  std::uint64_t bytes = 0;
};

class StackChecker {
 public:
  explicit StackChecker(Context& context) : context_(context) {}

  void run() {
    for (const Pou* pou : context_.program.order) {  // called POUs come first
      check(*pou);
    }
  }

 private:
  void check(const Pou& pou) {
    std::vector<Part> parts = variables(pou);
    std::uint64_t own = temporaries(pou);
    for (const Part& one : parts) {
      own = sum_of(own, one.bytes);
    }
    std::uint64_t below = 0;
    const Pou* deepest = nullptr;
    for (const Pou* one : pou.calls) {
      if (const auto known = depth_.find(one); known != depth_.end() && known->second > below) {
        below = known->second;
        deepest = one;
      }
    }
    const std::uint64_t all = sum_of(own, below);
    depth_[&pou] = std::min(all, kMaxStackBytes);  // reported once
    if (all > kMaxStackBytes) {
      complain(pou, parts, own > kMaxStackBytes ? nullptr : deepest, all);
    }
  }

  std::vector<Part> variables(const Pou& pou) {
    std::vector<Part> parts;
    if (pou.result != nullptr) {
      parts.push_back({"its result", pou.tree->at, sizes_.of(*pou.result)});
    }
    for (const Variable& one : pou.variables) {
      const bool inside =
          one.section == ast::Section::Temp ||
          (pou.is_callable() && (one.section == ast::Section::Local || one.section == ast::Section::Input ||
                                 one.section == ast::Section::Output));
      if (inside && one.type != nullptr && one.global == nullptr && !one.declared->is_static &&
          !one.declared->of_instance) {
        parts.push_back({"'" + one.name + "'", one.declared->at, sizes_.of(*one.type)});
      }
    }
    return parts;
  }

  // Returns the size of texts returned by functions, for the statement with the largest sum.
  std::uint64_t temporaries(const Pou& pou) {
    std::uint64_t most = 0;
    for (ast::Statement& one : pou.tree->body) {
      std::uint64_t bytes = 0;
      ast::each_expression(one, [&](const ast::Expression& part) {
        if (part.kind == ast::Expression::Kind::Call && part.type != nullptr && part.type->is_text()) {
          bytes = sum_of(bytes, sizes_.of(*part.type));
        }
      });
      most = std::max(most, bytes);
    }
    return most;
  }

  void complain(const Pou& pou, const std::vector<Part>& parts, const Pou* called, std::uint64_t bytes) {
    const auto largest =
        std::max_element(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.bytes < b.bytes; });
    std::string what = fmt::format("a call of {} needs {} bytes of the stack, at most {} are possible", pou.title(),
                                   bytes, kMaxStackBytes);
    if (largest != parts.end() && largest->bytes > 0) {
      what += fmt::format("; {} has {}", largest->name, largest->bytes);
    }
    if (called != nullptr) {
      what += fmt::format("; {}, which it calls, has {}", called->title(), depth_[called]);
    }
    context_.error(largest != parts.end() && called == nullptr ? largest->at : pou.tree->at,
                   what +
                       "; declare large variables in VAR_GLOBAL, or in VAR of a program or function block, and give "
                       "them as VAR_IN_OUT");
  }

  Context& context_;
  Sizes sizes_;
  std::map<const Pou*, std::uint64_t> depth_;
};

}  // namespace

void check_stack(Context& context) {
  if (!context.diagnostics.failed()) {
    StackChecker(context).run();
  }
}

}  // namespace indurop::plc
