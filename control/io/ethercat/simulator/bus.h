// SPDX-License-Identifier: Apache-2.0
// A wire for the master in virtual time, with a segment of slaves at its end, and faults that happen when a list says
// so.

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "control/io/ethercat/master/query.h"
#include "control/io/ethercat/simulator/segment.h"

namespace indurop::io::ethercat {

enum class FaultKind : std::uint8_t {
  FramesLost,     // all frames, for the duration
  FramesLate,     // all frames, by `value` ns, for the duration
  FramesDoubled,  // all frames, for the duration
  FramesSwapped,  // each frame comes back before the one that was sent before it, for the duration
  FramesBroken,   // on their way to the slave: its port counts errors
  ForeignFrame,   // one that no one of this bus has sent
  WrongCounter,   // of the slave's process data, for the duration
  PowerOff,       // of the slave, for the duration; what is behind it is cut off, too
  StateRefused,   // the slave falls to SAFEOP and refuses the next OP, with `value` as its code
  StateLost,      // the slave falls to SAFEOP with `value` as its code
  SdoAborted,     // the slave's next answer is an abort with `value`, after it was restarted
  SdoSilence,     // the slave does not answer the next request, after it was restarted
  SdoRepeated,    // the slave sends each answer twice, for the duration, after it was restarted
  StateSlow,      // the slave takes `value` ns for each change of its state, for the duration, after it was restarted
  OtherIdentity,  // the slave's EEPROM has another product code, for the duration, after it was restarted
  EepromBusy,     // for the duration, after the slave was restarted
  Emergency,      // the slave sends one with `value` as its code
  ClockJumps,     // the slave's, forward by `value` ns
  ClockDrifts,    // the slave's is faster by `value` ppm, for the duration
  CableCut,       // before the slave, or behind the last one, for the duration
  ObjectSet       // no fault: what a sensor of the slave measures; the object becomes `value`
};
inline constexpr std::uint8_t kFaultKinds = 21;

struct Fault {
  FaultKind kind = FaultKind::FramesLost;
  Time at{0};
  Time duration{0};
  std::size_t slave = 0;
  std::uint32_t value = 0;
  std::uint32_t object = 0;  // index and subindex, 0x600001
};

class SimulatedBus final : public Link {
 public:
  explicit SimulatedBus(Time delay = Time(500)) : segment_(delay) {}

  [[nodiscard]] Segment& segment() noexcept { return segment_; }
  // The cable leads back to the master; returns its other end.
  Link& make_ring();
  void add_fault(const Fault& fault) { faults_.push_back({fault, false, false}); }
  // Time passes; faults begin and end.
  void advance(Time now);

  // When the next frame comes back to the master; nothing if none is under way.
  [[nodiscard]] std::optional<Time> next_arrival() const noexcept;

  bool send(Bytes frame) noexcept override { return send(frame, Segment::End::First); }
  std::size_t receive(std::span<std::uint8_t> to) noexcept override { return receive(to, Segment::End::First); }

 private:
  struct Planned {
    Fault fault;
    bool has_begun = false;
    bool has_ended = false;
  };
  class LastEnd final : public Link {
   public:
    explicit LastEnd(SimulatedBus& bus) : bus_(bus) {}
    bool send(Bytes frame) noexcept override { return bus_.send(frame, Segment::End::Last); }
    std::size_t receive(std::span<std::uint8_t> to) noexcept override { return bus_.receive(to, Segment::End::Last); }

   private:
    SimulatedBus& bus_;
  };
  struct Arrival {
    Segment::Passed passed;
    std::size_t size = 0;
    std::array<std::uint8_t, kMaxFrame> bytes{};
  };

  void begin(const Fault& fault);
  void end(const Fault& fault);
  void restart(std::size_t slave);
  void add_to_product(std::size_t slave, std::uint32_t number);
  [[nodiscard]] const Fault* active(FaultKind kind) const noexcept;
  bool send(Bytes frame, Segment::End end) noexcept;
  std::size_t receive(std::span<std::uint8_t> to, Segment::End end) noexcept;
  void arrive(Segment::Passed passed, Bytes frame);
  void spoil_counter(std::span<std::uint8_t> frame, std::size_t slave) noexcept;

  Segment segment_;
  Time now_{0};
  std::vector<Planned> faults_;
  std::vector<Arrival> arrivals_;
  LastEnd last_end_{*this};
};

}  // namespace indurop::io::ethercat
