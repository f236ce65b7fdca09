// SPDX-License-Identifier: Apache-2.0
// Each POU behind those it calls and those whose variables lie in it.

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <vector>

#include "plc/check/pou_checker.h"

namespace indurop::plc {
namespace {

// No recursion, because thousands of functions may call each other.
class PouOrder {
 public:
  explicit PouOrder(Context& context) : context_(context) {}

  void run() {
    for (const Pou& pou : context_.program.pous) {
      begin(pou);
      while (!open_.empty()) {
        step();
      }
    }
  }

 private:
  struct Open {
    const Pou* pou = nullptr;
    std::vector<const Pou*> needed;  // in the order of the text
    std::size_t next = 0;
  };

  void begin(const Pou& pou) {
    if (waiting_.contains(&pou)) {
      complain(pou);
      return;
    }
    if (!done_.insert(&pou).second) {
      return;
    }
    Open made;
    made.pou = &pou;
    std::set_union(pou.holds.begin(), pou.holds.end(), pou.calls.begin(), pou.calls.end(),
                   std::back_inserter(made.needed), pou.holds.key_comp());
    std::sort(made.needed.begin(), made.needed.end(), [](const Pou* a, const Pou* b) { return a->index < b->index; });
    open_.push_back(std::move(made));
    waiting_.insert(&pou);
  }

  void step() {
    Open& top = open_.back();
    if (top.next < top.needed.size()) {
      begin(*top.needed[top.next++]);
      return;
    }
    context_.program.order.push_back(top.pou);
    waiting_.erase(top.pou);
    open_.pop_back();
  }

  void complain(const Pou& pou) {
    if (context_.diagnostics.full()) {  // it only counts
      context_.error(pou.tree->at, "recursion is not possible");
      return;
    }
    constexpr std::size_t kShown = 20;
    const auto first = std::find_if(open_.begin(), open_.end(), [&](const Open& one) { return one.pou == &pou; });
    const auto count = static_cast<std::size_t>(open_.end() - first);
    std::string way;
    for (std::size_t i = 0; i < std::min(count, kShown); ++i) {
      way += first[static_cast<std::ptrdiff_t>(i)].pou->title() + " -> ";
    }
    way += count > kShown ? "... -> " : "";
    context_.error(pou.tree->at,
                   fmt::format("recursion is not possible: {}{}, remove one of the calls", way, pou.title()));
  }

  Context& context_;
  std::set<const Pou*> done_;
  std::set<const Pou*> waiting_;  // those in `open_`
  std::vector<Open> open_;
};

}  // namespace

void order_pous(Context& context) {
  PouOrder(context).run();
}

}  // namespace indurop::plc
