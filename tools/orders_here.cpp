// SPDX-License-Identifier: Apache-2.0
// Orders about modules of a node of this machine, through its run block.
#include <fmt/format.h>

#include "rt/clock.h"
#include "tools/interrupt.h"
#include "tools/node_choice.h"
#include "tools/orders.h"
#include "tools/suggest.h"
#include "tools/units.h"

namespace indurop::tools {
namespace {

using scheduler::ModuleOrder;
using scheduler::OrderResult;

constexpr std::int64_t kLookNs = 2'000'000;

// The module's record; null after an error message.
scheduler::ModuleRecord* find_module(Context& context, RunView& run, const std::string& node,
                                     const std::string& module) {
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < run.module_count(); ++i) {
    names.push_back(fixed_text(run.module(i).name));
    if (names.back() == module) {
      return &run.module_to_order(i);
    }
  }
  context.out.error(fmt::format("node '{}' has no module '{}'.{} indurop status lists them", node, printable(module),
                                did_you_mean(module, names)));
  return nullptr;
}

int conclude(Context& context, ModuleOrder order, const scheduler::ModuleRecord& record, OrderResult result,
             std::int64_t took_ns) {
  const std::string module = printable(fixed_text(record.name));
  switch (result) {
    case OrderResult::Done:
      context.out.note(fmt::format("module '{}' {} after {}", module, past_of(order), human_ns(took_ns)));
      return kOk;
    case OrderResult::Unchanged:
      context.out.note(
          fmt::format("module '{}' {} already", module, order == ModuleOrder::Stop ? "is stopped" : "runs"));
      return kOk;
    case OrderResult::Ending:
      context.out.error(fmt::format("module '{}' was not {}: the node itself ends", module, past_of(order)));
      return kUnreachable;
    case OrderResult::Failed:
    case OrderResult::None:
      break;
  }
  const std::string why = printable(fixed_text(record.last_fault));
  context.out.error(
      fmt::format("module '{}' could not be {}{}", module, past_of(order), why.empty() ? "" : ": " + why));
  return kFailed;
}

}  // namespace

int order_here(Context& context, ModuleOrder order, const std::string& module, std::int64_t timeout_ns) {
  int code = kOk;
  const auto node = choose_node(context, code);
  if (!node) {
    return code;
  }
  auto run = RunView::open(*node, vars::Mode::ReadWrite);
  if (!run.ok()) {
    context.out.error(run.error().code == Errc::NotFound ? fmt::format("node '{}' does not run", *node)
                                                         : explain_open_error(run.error(), *node, true));
    return exit_code_of(run.error());
  }
  if (!run.value().node_alive() || run.value().block().state.load() != scheduler::NodeState::Running) {
    context.out.error(fmt::format("node '{}' does not run, so there is no module to be {}", *node, past_of(order)));
    return kUnreachable;
  }
  scheduler::ModuleRecord* record = find_module(context, run.value(), *node, module);
  if (record == nullptr) {
    return kFailed;
  }
  const std::int64_t begin = rt::now_ns();
  std::optional<scheduler::OrderTicket> ticket;
  while (rt::now_ns() < begin + timeout_ns && !interrupted() && run.value().node_alive()) {
    if (!ticket) {
      ticket = scheduler::place_order(*record, order);
    } else if (const auto result = scheduler::result_of(*record, *ticket); result != OrderResult::None) {
      return conclude(context, order, *record, result, rt::now_ns() - begin);
    }
    wait_until(rt::now_ns() + kLookNs);
  }
  if (interrupted()) {
    return interrupt_code();
  }
  context.out.error(run.value().node_alive()
                        ? fmt::format("module '{}' was not {} within {}; the node is still at it (indurop status)",
                                      printable(module), past_of(order), human_age(timeout_ns))
                        : fmt::format("node '{}' has ended meanwhile", *node));
  return kUnreachable;
}

}  // namespace indurop::tools
