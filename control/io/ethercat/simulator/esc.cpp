// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/simulator/esc.h"

#include <algorithm>
#include <utility>

namespace indurop::io::ethercat {

namespace {

constexpr std::size_t kAddressSpace = 0x10000;

// Offsets in a SyncManager.
constexpr std::uint16_t kSmLength = 2;
constexpr std::uint16_t kSmControl = 4;
constexpr std::uint16_t kSmStatus = 5;
constexpr std::uint16_t kSmActivate = 6;
constexpr std::uint16_t kSmPdi = 7;
constexpr std::uint8_t kSmModeMask = 0x03;
constexpr std::uint8_t kSmMailbox = 0x02;
constexpr std::uint8_t kSmWritten = 0x04;  // by the master
constexpr std::uint8_t kSmFull = 0x08;
// A mailbox remembers which side was there last.
constexpr std::uint8_t kSmWasWritten = 0x01;
constexpr std::uint8_t kSmWasRead = 0x02;
constexpr std::uint8_t kSmRepeat = 0x02;

constexpr std::size_t kEepromEnd = reg::kEepromData + 8U;
constexpr std::size_t kLongBytes = 8;  // that one access to an EEPROM brings
constexpr std::size_t kShortBytes = 4;
constexpr std::uint16_t kEepromCommands = kEepromRead | kEepromWrite | kEepromReload;

constexpr std::uint16_t kLastWatchdog = 0x0422;

// Where the master may write registers.
struct Writable {
  std::uint16_t first;
  std::uint16_t end;
};
constexpr Writable kWritable[] = {{0x0010, 0x0012},        {0x0020, 0x0022}, {0x0040, 0x0042}, {0x0100, 0x0104},
                                  {0x0108, 0x010A},        {0x0120, 0x0122}, {0x0200, 0x0202}, {0x0300, 0x0314},
                                  {0x0400, kLastWatchdog}, {0x0442, 0x0444}, {0x0500, 0x0510}, {0x0510, 0x0518},
                                  {0x0600, 0x0700},        {0x0800, 0x0880}, {0x0900, 0x0918}, {0x0920, 0x092C},
                                  {0x0930, 0x0936},        {0x0980, 0x09D0}, {0x0F00, 0x1000}};

bool overlaps(std::size_t offset, std::size_t size, std::size_t first, std::size_t length) noexcept {
  return offset < first + length && first < offset + size;
}

std::size_t sync_manager_at(unsigned number) noexcept {
  return reg::kSyncManager + std::size_t{number} * kSyncManagerBytes;
}

}  // namespace

Esc::Esc(EscConfig config) : config_(std::move(config)) {
  reset();
}

void Esc::reset() {
  memory_.assign(kAddressSpace, 0);
  events_ = {};
  clock_adjusted_ = Time(0);
  has_pulses_ = false;
  eeprom_command_ = 0;
  eeprom_errors_ = 0;
  set<std::uint8_t>(reg::kType, config_.type);
  set<std::uint8_t>(reg::kType + 1U, config_.revision);
  set<std::uint16_t>(reg::kType + 2U, config_.build);
  set<std::uint8_t>(reg::kFmmuCount, config_.fmmus);
  set<std::uint8_t>(reg::kSyncManagerCount, config_.sync_managers);
  set<std::uint8_t>(reg::kRamSize, config_.ram_kilobytes);
  set<std::uint8_t>(reg::kPorts, config_.ports);
  set<std::uint16_t>(reg::kFeatures, config_.features);
  set<std::uint32_t>(reg::kDlControl, 0x00070001);
  set<std::uint16_t>(reg::kAlStatus, static_cast<std::uint16_t>(AlState::Init));
  set<std::uint16_t>(reg::kWatchdogDivider, 0x09C2);
  set<std::uint16_t>(reg::kWatchdogPdi, 0x03E8);
  set<std::uint16_t>(reg::kWatchdogProcessData, 0x03E8);
  if (config_.eeprom.size() >= 0x0A) {
    set<std::uint16_t>(reg::kPdiControl, load<std::uint16_t>(config_.eeprom, 0));
    set<std::uint16_t>(reg::kAlias, load<std::uint16_t>(config_.eeprom, 0x08));
  }
  if (config_.pdi_control) {
    set<std::uint16_t>(reg::kPdiControl, *config_.pdi_control);
  }
}

std::span<std::uint8_t> Esc::memory(std::size_t offset, std::size_t size) noexcept {
  return std::span(memory_).subspan(offset, std::min<std::size_t>(size, kAddressSpace - offset));
}

EscEvents Esc::take_events() noexcept {
  return std::exchange(events_, {});
}

bool Esc::has(std::size_t offset) const noexcept {
  const auto within = [offset](std::size_t first, std::size_t length) {
    return offset >= first && offset < first + length;
  };
  if (within(reg::kFmmu, 0x200)) {
    return offset < reg::kFmmu + std::size_t{config_.fmmus} * kFmmuBytes;
  }
  if (within(reg::kSyncManager, 0x100)) {
    return offset < reg::kSyncManager + std::size_t{config_.sync_managers} * kSyncManagerBytes;
  }
  if (within(reg::kReceiveTimes, reg::kSystemTime - reg::kReceiveTimes)) {
    return (config_.features & kHasClock) != 0;
  }
  if (within(reg::kSystemTime, reg::kMemory - reg::kSystemTime - 0x100)) {
    return config_.has_clock && (config_.features & kHasClock) != 0;
  }
  return offset < reg::kMemory + std::size_t{config_.ram_kilobytes} * 1024;
}

bool Esc::is_writable(std::size_t offset) const noexcept {
  if ((at(reg::kEepromConfig) & kEepromOfDevice) != 0 && offset >= reg::kEepromControl && offset < kEepromEnd) {
    return false;
  }
  return has(offset) && (offset >= reg::kMemory ||
                         std::any_of(std::begin(kWritable), std::end(kWritable), [offset](const Writable& area) {
                           return offset >= area.first && offset < area.end;
                         }));
}

bool Esc::is_there(std::uint16_t offset, std::size_t size, bool write) const noexcept {
  for (std::size_t at = offset; at < std::min(offset + size, kAddressSpace); ++at) {
    if (write ? is_writable(at) : has(at)) {
      return true;
    }
  }
  return false;
}

bool Esc::may_access(std::uint16_t offset, std::size_t size, bool write) const noexcept {
  for (unsigned i = 0; i < config_.sync_managers; ++i) {
    const std::size_t manager = sync_manager_at(i);
    if ((at(manager + kSmActivate) & 1U) == 0 ||
        !overlaps(offset, size, value<std::uint16_t>(manager), value<std::uint16_t>(manager + kSmLength))) {
      continue;
    }
    const std::uint8_t control = at(manager + kSmControl);
    if (((control & kSmWritten) != 0) != write) {
      return false;
    }
    const bool full = (at(manager + kSmStatus) & kSmFull) != 0;
    if ((control & kSmModeMask) == kSmMailbox && full == write) {
      return false;
    }
  }
  return true;
}

void Esc::after_access(std::uint16_t offset, std::size_t size, bool write) noexcept {
  for (unsigned i = 0; i < config_.sync_managers; ++i) {
    const std::size_t manager = sync_manager_at(i);
    const auto start = value<std::uint16_t>(manager);
    const auto length = value<std::uint16_t>(manager + kSmLength);
    if ((at(manager + kSmActivate) & 1U) == 0 || !overlaps(offset, size, start, length)) {
      continue;
    }
    const bool mailbox = (at(manager + kSmControl) & kSmModeMask) == kSmMailbox;
    const bool last_byte = offset + size >= std::size_t{start} + length;
    if (mailbox && last_byte) {
      set_mailbox_full(i, write);
      events_.mailbox |= write;
    } else if (!mailbox && write) {
      events_.outputs = true;
    }
  }
}

bool Esc::mailbox_is_full(unsigned sync_manager) const noexcept {
  return (at(sync_manager_at(sync_manager) + kSmStatus) & kSmFull) != 0;
}

void Esc::set_mailbox_full(unsigned sync_manager, bool full) noexcept {
  auto& status = memory_[sync_manager_at(sync_manager) + kSmStatus];
  status = static_cast<std::uint8_t>(full ? (status & ~kSmWasRead) | kSmFull | kSmWasWritten
                                          : (status & ~(kSmFull | kSmWasWritten)) | kSmWasRead);
}

bool Esc::read(std::uint16_t offset, std::span<std::uint8_t> to, Time now) {
  if (!is_there(offset, to.size(), false) || !may_access(offset, to.size(), false)) {
    return false;
  }
  refresh(offset, to.size(), now);
  for (std::size_t i = 0; i < to.size(); ++i) {
    to[i] = has(offset + i) ? memory_[offset + i] : std::uint8_t{0};
  }
  after_access(offset, to.size(), false);
  return true;
}

bool Esc::write(std::uint16_t offset, Bytes from, Time now) {
  if (!is_there(offset, from.size(), true) || !may_access(offset, from.size(), true)) {
    return false;
  }
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (is_writable(offset + i)) {
      write_register(static_cast<std::uint16_t>(offset + i), from[i]);
    }
  }
  after_access(offset, from.size(), true);
  if (offset < reg::kMemory) {
    if (offset == reg::kSystemTime && from.size() >= sizeof(std::uint32_t)) {
      follow_reference(Time(load<std::uint32_t>(from, 0)), now);
    }
    after_write(offset, from.size(), now);
  }
  return true;
}

void Esc::write_register(std::uint16_t offset, std::uint8_t byte) noexcept {
  if (offset >= reg::kMemory) {
    memory_[offset] = byte;
    return;
  }
  const bool in_manager = offset >= reg::kSyncManager && offset < reg::kSyncManager + 0x80;
  const unsigned field = offset % kSyncManagerBytes;
  if (in_manager && (field == kSmStatus || field == kSmPdi)) {
    return;
  }
  if (in_manager && field == kSmActivate && (byte & 1U) == 0) {
    memory_[offset - 1U] = 0;  // a SyncManager that is switched off is empty
  }
  if (offset >= reg::kRxErrors && offset < reg::kRxErrors + 0x14) {
    byte = 0;  // a write clears a counter
  }
  if (offset >= reg::kReceiveTimes && offset < reg::kReceiveTimeUnit) {
    return;  // latches or compares, see after_write()
  }
  memory_[offset] = byte;
}

void Esc::after_write(std::uint16_t offset, std::size_t size, Time now) {
  events_.al_control |= overlaps(offset, size, reg::kAlControl, 1);
  if (overlaps(offset, size, reg::kEepromControl + 1, 1)) {
    run_eeprom_command(now);
  }
  if (overlaps(offset, size, reg::kSyncActivation + 1, 1)) {
    start_pulses(now);
  }
  const std::size_t answer = sync_manager_at(1);
  if (overlaps(offset, size, answer + kSmActivate, 1) &&
      ((at(answer + kSmActivate) ^ at(answer + kSmPdi)) & kSmRepeat) != 0) {
    events_.repeat = true;
    memory_[answer + kSmPdi] ^= kSmRepeat;
  }
}

void Esc::run_eeprom_command(Time now) {
  const auto control = value<std::uint16_t>(reg::kEepromControl);
  const std::uint16_t command = control & kEepromCommands;
  const std::size_t first = std::size_t{2} * value<std::uint32_t>(reg::kEepromAddress);
  auto& image = config_.eeprom;
  eeprom_errors_ = 0;
  if (now < eeprom_busy_until_ || (command == kEepromWrite && (control & kEepromWriteEnable) == 0)) {
    eeprom_errors_ = kEepromAckError;
  } else if (command == kEepromWrite) {
    if (first + 2 <= image.size()) {
      std::copy_n(memory_.begin() + reg::kEepromData, 2, image.begin() + static_cast<std::ptrdiff_t>(first));
    }
  } else if (command == kEepromRead) {
    const std::size_t count = (config_.eeprom_features & kEepromEightBytes) != 0 ? kLongBytes : kShortBytes;
    for (std::size_t i = 0; i < count; ++i) {
      memory_[reg::kEepromData + i] = first + i < image.size() ? image[first + i] : 0xFF;
    }
  }
  eeprom_command_ = command;
  if (command != 0) {
    eeprom_busy_until_ = std::max(eeprom_busy_until_, now + config_.eeprom_time);
  }
}

void Esc::refresh(std::uint16_t offset, std::size_t size, Time now) noexcept {
  if (overlaps(offset, size, reg::kEepromControl, 2)) {
    const unsigned busy = now < eeprom_busy_until_ ? kEepromBusy | eeprom_command_ : 0U;
    set<std::uint16_t>(reg::kEepromControl,
                       static_cast<std::uint16_t>(config_.eeprom_features | eeprom_errors_ | busy));
  }
  if (overlaps(offset, size, reg::kSystemTime, 8)) {
    set<std::int64_t>(reg::kSystemTime, system_time(now).count());
  }
  if (overlaps(offset, size, reg::kSyncStart, 8)) {
    show_next_pulse(now);
  }
}

// --- logical addresses ---

bool Esc::mapping(unsigned number, Mapping& found) const noexcept {
  const std::size_t fmmu = reg::kFmmu + std::size_t{number} * kFmmuBytes;
  const std::uint64_t length = value<std::uint16_t>(fmmu + 4);
  if ((at(fmmu + 12) & 1U) == 0 || length == 0) {
    return false;
  }
  const std::uint64_t start = value<std::uint32_t>(fmmu);
  found.first_bit = start * 8 + (at(fmmu + 6) & 7U);
  found.end_bit = (start + length - 1) * 8 + (at(fmmu + 7) & 7U) + 1;
  found.physical_bit = std::uint64_t{value<std::uint16_t>(fmmu + 8)} * 8 + (at(fmmu + 10) & 7U);
  found.reads = (at(fmmu + 11) & 1U) != 0;
  found.writes = (at(fmmu + 11) & 2U) != 0;
  return true;
}

std::optional<Esc::MappedPart> Esc::mapped(unsigned fmmu, std::uint32_t address, std::size_t bytes,
                                           bool write) const noexcept {
  Mapping map;
  if (!mapping(fmmu, map) || !(write ? map.writes : map.reads)) {
    return std::nullopt;
  }
  const std::uint64_t first = std::uint64_t{address} * 8;
  const std::uint64_t begin = std::max(first, map.first_bit);
  const std::uint64_t end = std::min(first + bytes * 8, map.end_bit);
  if (begin >= end) {
    return std::nullopt;
  }
  MappedPart part{begin - first, map.physical_bit + (begin - map.first_bit), end - begin, 0, 0};
  part.offset = static_cast<std::uint16_t>(part.memory_bit / 8);
  part.size = (part.memory_bit + part.bits + 7) / 8 - part.offset;
  return is_there(part.offset, part.size, write) && may_access(part.offset, part.size, write) ? std::optional(part)
                                                                                              : std::nullopt;
}

bool Esc::read_logical(std::uint32_t address, std::span<std::uint8_t> to, Time now) {
  bool any = false;
  for (unsigned i = 0; i < config_.fmmus; ++i) {
    if (const auto part = mapped(i, address, to.size(), false)) {
      refresh(part->offset, part->size, now);
      copy_bits(memory_, part->memory_bit, to, part->data_bit, part->bits);
      after_access(part->offset, part->size, false);
      any = true;
    }
  }
  return any;
}

bool Esc::write_logical(std::uint32_t address, Bytes from) {
  bool any = false;
  for (unsigned i = 0; i < config_.fmmus; ++i) {
    if (const auto part = mapped(i, address, from.size(), true)) {
      copy_bits(from, part->data_bit, memory_, part->memory_bit, part->bits);
      after_access(part->offset, part->size, true);
      any = true;
    }
  }
  return any;
}

}  // namespace indurop::io::ethercat
