// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/inheritance.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "control/plc/check/in_order.h"

namespace indurop::plc {
namespace {

constexpr std::size_t kMaxAncestors = 256;  // including those of interfaces

class Inheritance {
 public:
  explicit Inheritance(Context& context) : context_(context) {}

  void run() {
    walk_.run(
        context_.program.pous,
        [this](const Pou& pou) {
          std::vector<Pou*> out;
          for (const Pou* one : parents_of(pou)) {
            out.push_back(&context_.program.pous[one->index]);
          }
          return out;
        },
        [this](const Pou& last) { break_circle(last); }, [this](Pou& pou, const auto&) { complete(pou); });
  }

 private:
  static std::vector<const Pou*> parents_of(const Pou& pou) {
    std::vector<const Pou*> out = pou.interfaces;
    if (pou.base != nullptr) {
      out.push_back(pou.base);
    }
    return out;
  }

  // Breaks a circle: its first POU in the text extends nothing from now on; those that wait for it continue.
  void break_circle(const Pou& last) {
    const auto& open = walk_.open();
    auto first = std::find_if(open.begin(), open.end(), [&](const auto& one) { return one.one == &last; });
    first =
        std::min_element(first, open.end(), [](const auto& a, const auto& b) { return a.one->index < b.one->index; });
    Pou& pou = *first->one;
    while (open.back().one != &pou) {
      walk_.put_off();
    }
    extend_nothing(pou, fmt::format("{} extends itself, remove this EXTENDS", pou.name));
    walk_.end();
  }

  void complete(Pou& pou) {
    std::set<const Pou*> known;
    std::size_t depth = 0;
    for (const Pou* parent : parents_of(pou)) {
      for (const Pou* one : parent->ancestors) {
        if (known.insert(one).second) {
          pou.ancestors.push_back(one);
        }
      }
      if (known.insert(parent).second) {
        pou.ancestors.push_back(parent);
      }
      depth = std::max(depth, depth_[parent] + 1);
    }
    depth_[&pou] = depth;
    if (depth > kMaxExtends || pou.ancestors.size() > kMaxAncestors) {
      extend_nothing(
          pou,
          depth > kMaxExtends
              ? fmt::format("{} is the last of more than {} that extend each other, use fewer", pou.name, kMaxExtends)
              : fmt::format("{} extends and implements more than {} others, use fewer", pou.name, kMaxAncestors));
    }
  }

  void extend_nothing(Pou& pou, std::string why) {
    const auto& tree = *pou.tree;
    context_.error(!tree.bases.empty()        ? tree.bases.front().at
                   : !tree.interfaces.empty() ? tree.interfaces.front().at
                                              : tree.at,
                   std::move(why));
    pou.base = nullptr;
    pou.interfaces.clear();
    pou.ancestors.clear();
    depth_[&pou] = 0;
  }

  Context& context_;
  InOrder<Pou> walk_;
  std::map<const Pou*, std::size_t> depth_;
};

}  // namespace

void resolve_inheritance(Context& context) {
  Inheritance(context).run();
}

}  // namespace indurop::plc
