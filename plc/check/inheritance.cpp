// SPDX-License-Identifier: Apache-2.0
// No recursion: thousands of declarations may extend each other, and interfaces form diamonds.
#include "plc/check/inheritance.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace indurop::plc {
namespace {

constexpr std::size_t kMaxAncestors = 256;  // with those of interfaces

class Inheritance {
 public:
  explicit Inheritance(Context& context) : context_(context) {}

  void run() {
    for (Pou& pou : context_.program.pous) {
      begin(pou);
      while (!open_.empty()) {
        step();
      }
    }
  }

 private:
  // One whose ancestors are looked at.
  struct Open {
    Pou* pou = nullptr;
    std::vector<const Pou*> parents;
    std::size_t next = 0;
  };

  static std::vector<const Pou*> parents_of(const Pou& pou) {
    std::vector<const Pou*> out = pou.interfaces;
    if (pou.base != nullptr) {
      out.push_back(pou.base);
    }
    return out;
  }

  void begin(Pou& pou) {
    if (done_.insert(&pou).second) {
      waiting_.insert(&pou);
      open_.push_back({&pou, parents_of(pou), 0});
    }
  }

  void step() {
    Open& top = open_.back();
    if (top.next == top.parents.size()) {
      complete(*top.pou);
      end();
      return;
    }
    const Pou& parent = *top.parents[top.next++];
    if (waiting_.contains(&parent)) {
      break_circle(parent);
    } else {
      begin(*context_.program.pou_names.at(upper(parent.name)));
    }
  }

  void end() {
    waiting_.erase(open_.back().pou);
    open_.pop_back();
  }

  // The first of the circle in the text extends nothing any more; what waits for it goes on.
  void break_circle(const Pou& last) {
    auto first = std::find_if(open_.begin(), open_.end(), [&](const Open& one) { return one.pou == &last; });
    first =
        std::min_element(first, open_.end(), [](const Open& a, const Open& b) { return a.pou->index < b.pou->index; });
    Pou& pou = *first->pou;
    while (open_.back().pou != &pou) {
      done_.erase(open_.back().pou);
      end();
    }
    extend_nothing(pou, fmt::format("{} extends itself, remove this EXTENDS", pou.name));
    end();
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
  std::vector<Open> open_;
  std::set<const Pou*> waiting_;  // those in `open_`
  std::set<const Pou*> done_;     // looked at, or open
  std::map<const Pou*, std::size_t> depth_;
};

}  // namespace

void resolve_inheritance(Context& context) {
  Inheritance(context).run();
}

}  // namespace indurop::plc
