// SPDX-License-Identifier: Apache-2.0
// The master's side of a slave's mailbox: SDO transfers of any length, emergencies, and repetition of what was lost.
// One datagram each time it is asked; allocates only in open(). Real-time safe but for that.

#pragma once

#include <optional>
#include <vector>

#include "control/io/ethercat/coe.h"
#include "control/io/ethercat/master/query.h"
#include "control/io/ethercat/sii.h"

namespace indurop::io::ethercat {

// One transfer; lives with the caller until it is Done or failed.
struct SdoTransfer {
  std::uint16_t index = 0;
  std::uint8_t subindex = 0;
  bool complete = false;  // all subindices
  bool upload = false;
  Bytes sent;                    // of a download
  std::span<std::uint8_t> room;  // of an upload
  std::size_t size = 0;          // of an upload: bytes that came
  enum class State { Waiting, Done, Aborted, TimedOut } state = State::Waiting;
  std::uint32_t abort_code = 0;
};

class SdoClient {
 public:
  void open(std::uint16_t station, const MailboxArea& area);
  // The slave begins from INIT: nothing of an earlier start is valid.
  void reset() noexcept;
  [[nodiscard]] bool is_open() const noexcept { return area_.receive_size >= kSdoHeader; }
  [[nodiscard]] bool is_idle() const noexcept { return transfer_ == nullptr; }
  void start(SdoTransfer& transfer, Clock now) noexcept;

  // Nothing: it has nothing to ask now.
  std::optional<Query> query(Clock now) noexcept;
  void answer(Bytes data, bool is_answered, Clock now) noexcept;
  void lost(Clock now) noexcept;  // the frame of the last query did not come back
  std::optional<Emergency> take_emergency() noexcept;

 private:
  enum class Step { Idle, Write, Poll, Read, Repeat, RepeatAck };

  void begin_message(std::size_t size) noexcept;
  void write_request(Clock now) noexcept;
  void write_segment() noexcept;
  void write_upload_segment() noexcept;
  [[nodiscard]] bool is_repeated(const Mailbox& mailbox, Bytes bytes) noexcept;
  void receive(Bytes bytes) noexcept;
  void receive_download(unsigned command) noexcept;
  void receive_upload(unsigned command, Bytes data) noexcept;
  void take(Bytes data) noexcept;
  void finish(SdoTransfer::State state, std::uint32_t code = 0) noexcept;
  [[nodiscard]] bool times_out(Clock now) noexcept;

  std::uint16_t station_ = 0;
  MailboxArea area_;
  std::vector<std::uint8_t> message_;
  std::vector<std::uint8_t> received_;  // the latest message of the slave
  SdoTransfer* transfer_ = nullptr;
  Step step_ = Step::Idle;
  Step asked_ = Step::Idle;  // what the query on its way is for
  std::uint8_t counter_ = 0;
  bool toggle_ = false;
  bool in_segments_ = false;
  std::size_t done_ = 0;
  std::size_t total_ = 0;  // of an upload, as it was announced
  std::uint8_t repeat_ = 0;
  Clock deadline_{0};
  Clock next_poll_{0};
  std::optional<Emergency> emergency_;
};

}  // namespace indurop::io::ethercat
