// SPDX-License-Identifier: Apache-2.0
#include "scheduler/module_order.h"

namespace indurop::scheduler {
namespace {

// A ticket and, in the lowest byte, what it is about.
constexpr unsigned kTicketShift = 8;
constexpr std::uint64_t kWhat = 0xff;

}  // namespace

std::optional<OrderTicket> place_order(ModuleRecord& record, ModuleOrder order) noexcept {
  std::uint64_t last = record.order.load(std::memory_order_acquire);
  const OrderTicket ticket = last >> kTicketShift;
  if (record.answer.load(std::memory_order_acquire) >> kTicketShift != ticket) {
    return std::nullopt;
  }
  const std::uint64_t next = (ticket + 1) << kTicketShift | static_cast<std::uint64_t>(order);
  if (!record.order.compare_exchange_strong(last, next, std::memory_order_acq_rel)) {
    return std::nullopt;
  }
  return ticket + 1;
}

OrderResult result_of(const ModuleRecord& record, OrderTicket ticket) noexcept {
  const std::uint64_t answer = record.answer.load(std::memory_order_acquire);
  if (answer >> kTicketShift < ticket) {
    return OrderResult::None;
  }
  return answer >> kTicketShift == ticket ? static_cast<OrderResult>(answer & kWhat) : OrderResult::Done;
}

ModuleOrder waiting_order(const ModuleRecord& record) noexcept {
  const std::uint64_t order = record.order.load(std::memory_order_acquire);
  const std::uint64_t answer = record.answer.load(std::memory_order_relaxed);
  const std::uint64_t what = order & kWhat;
  const bool known = what <= static_cast<std::uint64_t>(ModuleOrder::Restart);
  return order >> kTicketShift != answer >> kTicketShift && known ? static_cast<ModuleOrder>(what) : ModuleOrder::None;
}

void answer_order(ModuleRecord& record, OrderResult result) noexcept {
  const OrderTicket ticket = record.order.load(std::memory_order_acquire) >> kTicketShift;
  record.answer.store(ticket << kTicketShift | static_cast<std::uint64_t>(result), std::memory_order_release);
}

}  // namespace indurop::scheduler
