// SPDX-License-Identifier: Apache-2.0
#include "scheduler/module_command.h"

namespace indurop::scheduler {
namespace {

// A ticket and, in the lowest byte, the command or result.
constexpr unsigned kTicketShift = 8;
constexpr std::uint64_t kWhat = 0xff;

}  // namespace

std::optional<CommandTicket> place_command(ModuleRecord& record, ModuleCommand command) noexcept {
  std::uint64_t last = record.command.load(std::memory_order_acquire);
  const CommandTicket ticket = last >> kTicketShift;
  if (record.answer.load(std::memory_order_acquire) >> kTicketShift != ticket) {
    return std::nullopt;
  }
  const std::uint64_t next = (ticket + 1) << kTicketShift | static_cast<std::uint64_t>(command);
  if (!record.command.compare_exchange_strong(last, next, std::memory_order_acq_rel)) {
    return std::nullopt;
  }
  return ticket + 1;
}

CommandResult result_of(const ModuleRecord& record, CommandTicket ticket) noexcept {
  const std::uint64_t answer = record.answer.load(std::memory_order_acquire);
  if (answer >> kTicketShift < ticket) {
    return CommandResult::None;
  }
  return answer >> kTicketShift == ticket ? static_cast<CommandResult>(answer & kWhat) : CommandResult::Done;
}

ModuleCommand waiting_command(const ModuleRecord& record) noexcept {
  const std::uint64_t command = record.command.load(std::memory_order_acquire);
  const std::uint64_t answer = record.answer.load(std::memory_order_relaxed);
  const std::uint64_t what = command & kWhat;
  const bool known = what <= static_cast<std::uint64_t>(ModuleCommand::Schedule);
  return command >> kTicketShift != answer >> kTicketShift && known ? static_cast<ModuleCommand>(what)
                                                                    : ModuleCommand::None;
}

void answer_command(ModuleRecord& record, CommandResult result) noexcept {
  const CommandTicket ticket = record.command.load(std::memory_order_acquire) >> kTicketShift;
  record.answer.store(ticket << kTicketShift | static_cast<std::uint64_t>(result), std::memory_order_release);
}

}  // namespace indurop::scheduler
