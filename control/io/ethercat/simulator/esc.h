// SPDX-License-Identifier: Apache-2.0
// The controller chip of a simulated slave: registers and memory as a master reaches them, with SyncManagers, FMMUs,
// the EEPROM interface and the distributed clock. What its application does is in slave.h.

#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "control/io/ethercat/bytes.h"
#include "control/io/ethercat/registers.h"

namespace indurop::io::ethercat {

using Time = std::chrono::nanoseconds;  // virtual, since the simulation began
// When a frame comes back through each port but 0, where it came in first; nothing where no slave is linked.
using Returns = std::array<std::optional<Time>, kPorts>;

struct EscConfig {
  std::uint8_t type = 0x11;
  std::uint8_t revision = 0;
  std::uint16_t build = 0;
  std::uint8_t fmmus = 8;
  std::uint8_t sync_managers = 8;
  std::uint8_t ram_kilobytes = 8;
  std::uint8_t ports = 0x0F;        // how each is built, two bits for each; ports 0 and 1
  std::uint16_t features = 0x000C;  // without kHasLongClock the clock has 32 bits
  bool has_clock = true;            // the unit is switched on; receive times of ports exist without it
  std::uint8_t dl_status = 0x01;    // the device and its processor are ready: the low four bits
  std::uint16_t eeprom_features = kEepromEightBytes;  // of its interface: how many bytes at a time, who answers
  std::optional<std::uint16_t> pdi_control;           // what the EEPROM's first word does not decide
  Time clock_start{0};                                // what its clock shows when the simulation begins
  std::int64_t drift_ppb = 0;                         // how much faster than time its clock runs, 1e-9
  Time eeprom_time{100'000};                          // busy for each access
  std::vector<std::uint8_t> eeprom;
};

// What the master did that the device has to see.
struct EscEvents {
  bool al_control = false;
  bool mailbox = false;  // a message arrived in SyncManager 0
  bool repeat = false;   // the answer in SyncManager 1 is asked for again
  bool outputs = false;  // a SyncManager of outputs was written
};

class Esc {
 public:
  explicit Esc(EscConfig config);

  // As after power-on: registers have their first values, the EEPROM keeps its own.
  void reset();

  // Access of the master. False: refused, the working counter does not rise.
  bool read(std::uint16_t offset, std::span<std::uint8_t> to, Time now);
  bool write(std::uint16_t offset, Bytes from, Time now);
  bool read_logical(std::uint32_t address, std::span<std::uint8_t> to, Time now);
  bool write_logical(std::uint32_t address, Bytes from);
  // A frame with a write to the receive times passed.
  void latch_receive_times(Time in, const Returns& returns) noexcept;

  // Access by the application of the device.
  [[nodiscard]] std::uint8_t at(std::size_t offset) const noexcept { return memory_[offset]; }
  template <class T>
  [[nodiscard]] T value(std::size_t offset) const noexcept {
    return load<T>(memory_, offset);
  }
  template <class T>
  void set(std::size_t offset, T value) noexcept {
    store<T>(memory_, offset, value);
  }
  [[nodiscard]] std::span<std::uint8_t> memory(std::size_t offset, std::size_t size) noexcept;
  EscEvents take_events() noexcept;
  [[nodiscard]] bool mailbox_is_full(unsigned sync_manager) const noexcept;
  void set_mailbox_full(unsigned sync_manager, bool full) noexcept;

  // Its clock, and that with the offset the master has set.
  [[nodiscard]] Time local_time(Time now) const noexcept;
  [[nodiscard]] Time system_time(Time now) const noexcept;
  // What a slave without a processor does: its state is the one that the master writes.
  [[nodiscard]] bool emulates_device() const noexcept { return (at(reg::kPdiControl + 1U) & 1U) != 0; }
  void jump_clock(Time by) noexcept { clock_adjusted_ += by; }
  // From now on its clock is so much faster, 1e-9.
  void add_drift(std::int64_t ppb, Time now) noexcept;
  // How long ago the last pulse of SYNC0 was; nothing if there was none, because none was asked for or its begin was
  // past when it was switched on.
  [[nodiscard]] std::optional<Time> since_pulse(Time now) const noexcept;
  [[nodiscard]] bool wants_pulses() const noexcept { return (at(reg::kSyncActivation + 1U) & kSyncActive) != 0; }
  [[nodiscard]] bool has_pulses() const noexcept { return has_pulses_; }

  void hold_eeprom_busy(Time until) noexcept { eeprom_busy_until_ = until; }
  [[nodiscard]] std::vector<std::uint8_t>& eeprom() noexcept { return config_.eeprom; }

 private:
  static constexpr unsigned kSyncActive = 0x03;  // cyclic operation, SYNC0

  [[nodiscard]] bool has(std::size_t offset) const noexcept;
  [[nodiscard]] bool is_writable(std::size_t offset) const noexcept;
  // Any byte of an access counts: those that are not there read as 0, and are not written.
  [[nodiscard]] bool is_there(std::uint16_t offset, std::size_t size, bool write) const noexcept;
  [[nodiscard]] bool may_access(std::uint16_t offset, std::size_t size, bool write) const noexcept;
  void after_access(std::uint16_t offset, std::size_t size, bool write) noexcept;
  void refresh(std::uint16_t offset, std::size_t size, Time now) noexcept;
  void write_register(std::uint16_t offset, std::uint8_t byte) noexcept;
  void after_write(std::uint16_t offset, std::size_t size, Time now);
  void run_eeprom_command(Time now);
  void follow_reference(Time received, Time now) noexcept;
  [[nodiscard]] Time long_time(Time now) const noexcept;
  void start_pulses(Time now) noexcept;
  void show_next_pulse(Time now) noexcept;

  struct Mapping {  // one FMMU
    std::uint64_t first_bit = 0;
    std::uint64_t end_bit = 0;
    std::uint64_t physical_bit = 0;
    bool reads = false;
    bool writes = false;
  };
  [[nodiscard]] bool mapping(unsigned number, Mapping& found) const noexcept;
  struct MappedPart {              // of the data of a datagram
    std::uint64_t data_bit = 0;    // first bit in the data
    std::uint64_t memory_bit = 0;  // its place in the memory
    std::uint64_t bits = 0;
    std::uint16_t offset = 0;  // the bytes of the memory that have these bits
    std::size_t size = 0;
  };
  // Returns what an FMMU maps of `bytes` bytes at a logical address, if the master may access it.
  [[nodiscard]] std::optional<MappedPart> mapped(unsigned fmmu, std::uint32_t address, std::size_t bytes,
                                                 bool write) const noexcept;

  EscConfig config_;
  std::vector<std::uint8_t> memory_;
  EscEvents events_;
  Time eeprom_busy_until_{0};
  Time clock_adjusted_{0};
  Time followed_at_{0};  // the reference
  std::uint16_t eeprom_command_ = 0;
  std::uint16_t eeprom_errors_ = 0;
  Time first_pulse_{0};  // by the clock as if it had 64 bits
  bool has_pulses_ = false;
};

}  // namespace indurop::io::ethercat
