// SPDX-License-Identifier: Apache-2.0
// Orders POUs: each after those it calls and those whose variables it contains.

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "control/plc/check/in_order.h"
#include "control/plc/check/pou_checker.h"

namespace indurop::plc {
namespace {

class PouOrder {
 public:
  explicit PouOrder(Context& context) : context_(context) {}

  void run() {
    walk_.run(
        context_.program.pous,
        [](const Pou& pou) {  // in text order
          std::vector<const Pou*> needed;
          std::set_union(pou.holds.begin(), pou.holds.end(), pou.calls.begin(), pou.calls.end(),
                         std::back_inserter(needed), pou.holds.key_comp());
          std::sort(needed.begin(), needed.end(), [](const Pou* a, const Pou* b) { return a->index < b->index; });
          return needed;
        },
        [this](const Pou& pou) { complain(pou); },
        [this](const Pou& pou, const auto&) { context_.program.order.push_back(&pou); });
  }

 private:
  void complain(const Pou& pou) {
    if (context_.diagnostics.full()) {  // further errors are only counted
      context_.error(pou.tree->at, "recursion is not possible");
      return;
    }
    constexpr std::size_t kShown = 20;
    const auto& open = walk_.open();
    const auto first = std::find_if(open.begin(), open.end(), [&](const auto& one) { return one.one == &pou; });
    const auto count = static_cast<std::size_t>(open.end() - first);
    std::string way;
    for (std::size_t i = 0; i < std::min(count, kShown); ++i) {
      way += first[static_cast<std::ptrdiff_t>(i)].one->title() + " -> ";
    }
    way += count > kShown ? "... -> " : "";
    context_.error(pou.tree->at,
                   fmt::format("recursion is not possible: {}{}, remove one of the calls", way, pou.title()));
  }

  Context& context_;
  InOrder<const Pou> walk_;
};

}  // namespace

void order_pous(Context& context) {
  PouOrder(context).run();
}

}  // namespace indurop::plc
