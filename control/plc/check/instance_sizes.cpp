// SPDX-License-Identifier: Apache-2.0
// Circles are found later, by order_pous().
#include "control/plc/check/instance_sizes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "control/plc/check/in_order.h"
#include "control/plc/check/instance_contents.h"
#include "control/plc/check/saturating.h"
#include "control/plc/check/value_tree.h"
#include "control/plc/library/standard.h"

namespace indurop::plc {
namespace {

constexpr std::size_t kMaxNesting = 64;                     // nesting of instances
constexpr std::uint64_t kMaxVariables = 1'000'000;          // in the instances of one POU
constexpr std::uint64_t kMaxVariablesTogether = 4'000'000;  // in those of all programs and globals

// Returns true for INTEGRAL and the like, whose internal memory RETAIN does not keep.
bool forgets(const LibraryBlock& block) {
  constexpr std::array<std::string_view, 5> kForgetful{"INTEGRAL", "DERIVATIVE", "PID", "RAMP", "RTC"};
  return std::find(kForgetful.begin(), kForgetful.end(), block.name) != kForgetful.end();
}

// Returns the number of variables in a variable of the type, including inner ones, if its function block was measured.
std::uint64_t variables_in(const Type& type) {
  switch (type.kind) {
    case Type::Kind::Array:
      return holds_instances(type) ? product_of(elements_of(type), variables_in(*type.element)) : 1;
    case Type::Kind::Block:
      return type.block != nullptr ? 1 + type.block->inputs.size() + type.block->outputs.size()
                                   : sum_of(1, type.pou->variables_inside);
    default:
      return 1;
  }
}

// Returns whether the variable is stored in the instance.
bool is_inside(const Variable& one) noexcept {
  return one.type != nullptr && one.section != ast::Section::InOut && one.section != ast::Section::External;
}

class Measurer {
 public:
  explicit Measurer(Context& context) : context_(context) {}

  bool run() {
    InOrder<Pou> walk;
    walk.run(
        context_.program.pous,
        [this](const Pou& pou) {
          std::vector<Pou*> out;
          for (const Pou* one : pou.holds) {
            out.push_back(&context_.program.pous[one->index]);
          }
          return out;
        },
        [](const Pou&) {}, [this](Pou& pou, const auto& held) { measure(pou, held); });
    if (fine_) {
      together();
    }
    return fine_;
  }

 private:
  void measure(Pou& pou, const std::vector<Pou*>& held) {
    std::size_t depth = 0;
    for (const Pou* one : held) {
      depth = std::max(depth, depth_[one] + 1);
    }
    depth_[&pou] = depth;
    if (pou.base != nullptr) {
      pou.variables_inside = pou.base->variables_inside;
      pou.holds_places = pou.base->holds_places;
      pou.forgets = pou.base->forgets;
    }
    for (const Variable& one : pou.variables) {
      if (!is_inside(one)) {
        continue;
      }
      pou.variables_inside = sum_of(pou.variables_inside, variables_in(*one.type));
      pou.holds_places = pou.holds_places || is_placeless(one) || plc::holds_places(*one.type);
      if (pou.forgets == nullptr && one.section == ast::Section::Local) {
        pou.forgets = forgetful_block(*one.type);
      }
    }
    if (depth > kMaxNesting) {
      complain(pou, fmt::format("more than {} instances lie inside each other, use fewer", kMaxNesting));
      depth_[&pou] = 0;
    } else if (pou.variables_inside > kMaxVariables) {
      complain(pou, fmt::format("{} has more than {} variables with those of the instances in it, use smaller arrays",
                                pou.title(), kMaxVariables));
      pou.variables_inside = 1;
    }
  }

  void complain(const Pou& pou, std::string why) {
    fine_ = false;
    context_.error(pou.tree->at, std::move(why));
  }

  void together() {
    std::uint64_t sum = 0;
    const auto count = [&](const Place& at, std::uint64_t one) {
      sum = sum_of(sum, one);
      if (fine_ && sum > kMaxVariablesTogether) {
        fine_ = false;
        context_.error(at, fmt::format("all programs and global variables have more than {} variables with those of "
                                       "their instances, use fewer",
                                       kMaxVariablesTogether));
      }
    };
    for (const Pou& pou : context_.program.pous) {
      if (pou.tree->kind == ast::Pou::Kind::Program) {
        count(pou.tree->at, pou.variables_inside);
      }
    }
    for (const Global& one : context_.program.globals) {
      if (one.type != nullptr && holds_instances(*one.type)) {
        count(one.at, variables_in(*one.type));
      }
    }
  }

  Context& context_;
  bool fine_ = true;
  std::map<const Pou*, std::size_t> depth_;
};

}  // namespace

const LibraryBlock* forgetful_block(const Type& type) {
  if (type.kind == Type::Kind::Array) {
    return forgetful_block(*type.element);
  }
  if (type.kind != Type::Kind::Block) {
    return nullptr;
  }
  return type.block == nullptr ? type.pou->forgets : forgets(*type.block) ? type.block : nullptr;
}

bool measure_instances(Context& context) {
  return Measurer(context).run();
}

}  // namespace indurop::plc
