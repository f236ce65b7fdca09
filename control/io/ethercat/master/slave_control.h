// SPDX-License-Identifier: Apache-2.0
// Brings one slave from nothing to OP, watches it there, and begins again when it was lost: everything is applied
// again. It has at most one datagram on the way, and never waits. Real-time safe after construction.

#pragma once

#include <optional>

#include "control/io/ethercat/master/eeprom_reader.h"
#include "control/io/ethercat/master/events.h"
#include "control/io/ethercat/master/operation_watch.h"
#include "control/io/ethercat/master/plan.h"
#include "control/io/ethercat/master/sdo_client.h"
#include "control/io/ethercat/master/sync_setup.h"

namespace indurop::io::ethercat {

// What the master calls the slave at this position.
constexpr std::uint16_t station_of(std::size_t place) noexcept {
  return static_cast<std::uint16_t>(0x1001 + place);
}

class SlaveControl {
 public:
  SlaveControl(const SlavePlan& plan, std::size_t place, Events& events, Clocks& clocks);

  std::optional<Query> query(Clock now) noexcept;
  void answer(Bytes data, bool is_answered, Clock now) noexcept;
  void lost(Clock now) noexcept;
  // The working counter of its process data came back.
  void check_counter(std::uint16_t wkc, Clock now) noexcept;

  [[nodiscard]] bool operates() const noexcept { return step_ == Step::Operate; }
  [[nodiscard]] Problem problem() const noexcept { return problem_; }
  [[nodiscard]] std::uint16_t expected_counter() const noexcept { return expected_; }
  [[nodiscard]] std::uint64_t wrong_counters() const noexcept { return wrong_counters_; }
  // Broken frames and lost links at its ports since it was found first.
  [[nodiscard]] std::uint64_t port_errors() const noexcept { return operation_.port_errors(); }
  // How long after the frame of a tick its pulse (SYNC0) is, as the slave says; nothing if it does not know or has
  // none.
  [[nodiscard]] std::optional<Clock> pulse_after() const noexcept {
    return operates() ? sync_.pulse_after() : std::nullopt;
  }
  // Begins a transfer of an application's. False: not now.
  bool start(SdoTransfer& transfer, Clock now) noexcept;

 private:
  enum class Step {
    Pause,
    Find,
    Address,
    Channels,  // how many FMMUs and SyncManagers it has, and whether it runs LRW
    ClearFmmus,
    ClearManagers,
    Identity,
    Release,  // gives the EEPROM to the processor of the device
    Request,
    Wait,
    Mailbox,
    Objects,
    Managers,
    Fmmus,
    Sync,
    Operate
  };

  void enter(Step step, Clock now) noexcept;
  void request(AlState state, Clock now) noexcept;
  void finish_step(Bytes data, Clock now) noexcept;
  void reached(Clock now) noexcept;
  void fail(Problem problem, std::uint32_t detail, Clock pause, Clock now) noexcept;
  void found(std::uint16_t station, std::uint16_t alias, Clock now) noexcept;
  void check_identity(Bytes data, bool is_answered, Clock now) noexcept;
  void check_state(Bytes data, Clock now) noexcept;
  void next_object(Clock now) noexcept;
  void judge_object(Clock now) noexcept;
  void judge_sync(SyncSetup::Outcome outcome, Clock now) noexcept;

  const SlavePlan& plan_;
  std::uint16_t place_;
  Events& events_;
  std::uint16_t expected_;
  Step step_ = Step::Find;
  Problem problem_ = Problem::None;
  std::uint32_t detail_ = 0;
  Clock since_{0};        // the step began
  Clock answered_at_{0};  // the last frame with a query of this slave came back
  Clock resume_at_{0};
  AlState target_ = AlState::Init;
  std::array<std::uint8_t, 2> word_{};  // that a query writes
  std::size_t fmmus_ = 0;
  std::size_t managers_ = 0;
  bool has_lrw_ = true;
  EepromReader eeprom_;
  std::uint16_t eeprom_word_ = 0;
  Identity identity_;
  SdoClient mailbox_;
  SyncSetup sync_;
  std::size_t object_ = 0;
  SdoTransfer transfer_;
  OperationWatch operation_;
  std::uint64_t wrong_counters_ = 0;
};

}  // namespace indurop::io::ethercat
