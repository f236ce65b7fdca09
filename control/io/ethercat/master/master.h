// SPDX-License-Identifier: Apache-2.0
// The master of one bus. cycle() belongs to the tick: it takes what came back, sends the process data of all slaves
// (or of those whose turn it is, if they are exchanged less often), and one more frame in which each slave that is not
// in OP gets its next datagram. Real-time safe after construction.

#pragma once

#include <array>
#include <deque>
#include <memory>
#include <vector>

#include "control/io/ethercat/master/slave_control.h"

namespace indurop::io::ethercat {

struct BusCounters {
  std::uint64_t sent = 0;
  std::uint64_t lost = 0;        // did not come back before the next cycle
  std::uint64_t late = 0;        // came back after they were counted as lost
  std::uint64_t duplicates = 0;  // came back twice
  std::uint64_t foreign = 0;     // not ours, or changed on the way
  std::uint64_t not_sent = 0;    // the link took none
};

class Master {
 public:
  // The plans in the order of the slaves on the cable; `period`: between two cycles.
  Master(Link& link, std::vector<SlavePlan> plans, Clock period);
  Master(const Master&) = delete;
  Master& operator=(const Master&) = delete;
  ~Master() = default;

  // One cycle: takes what came back of the last one, then sends. An application that has to see its inputs before it
  // writes its outputs calls the two halves itself.
  void cycle(Clock now) noexcept {
    receive(now);
    send(now);
  }
  void receive(Clock now) noexcept;
  void send(Clock now) noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return plans_.size(); }
  [[nodiscard]] const SlavePlan& plan(std::size_t place) const noexcept { return plans_[place]; }
  [[nodiscard]] const SlaveControl& slave(std::size_t place) const noexcept { return slaves_[place]; }
  // The application's outputs; sent while they are good and the slave is in OP, else its safe outputs are.
  [[nodiscard]] std::span<std::uint8_t> outputs(std::size_t place) noexcept { return data_[place].outputs; }
  void set_outputs_good(std::size_t place, bool good) noexcept { data_[place].outputs_good = good; }
  [[nodiscard]] Bytes inputs(std::size_t place) const noexcept { return data_[place].inputs; }
  // The inputs came with the last cycle in which they are exchanged, from a slave in OP with the right working counter.
  [[nodiscard]] bool is_fresh(std::size_t place) const noexcept {
    return data_[place].fresh && slaves_[place].operates();
  }
  bool start(std::size_t place, SdoTransfer& transfer, Clock now) noexcept {
    return slaves_[place].start(transfer, now);
  }

  [[nodiscard]] const BusCounters& counters() const noexcept { return counters_; }
  // How many slaves answered in the last cycle, in the configuration or not.
  [[nodiscard]] std::uint16_t slaves_seen() const noexcept { return slaves_seen_; }
  bool next_event(Event& event) noexcept { return events_.pop(event); }
  // Not used, and nothing is sent for them, unless a plan wants pulses of a slave's clock.
  [[nodiscard]] const Clocks& clocks() const noexcept { return clocks_; }

 private:
  struct Item {  // a datagram of a slave in a frame
    std::uint16_t place = 0;
    std::size_t data_at = 0;
    std::size_t size = 0;
  };
  struct Pair {  // the process data of a slave without LRW: where it is in a frame, 0 if it has none
    std::uint16_t place = 0;
    std::size_t write_at = 0;
    std::size_t read_at = 0;
  };
  struct Frame {
    FrameBuilder builder{kMasterMac};
    std::vector<Item> items;
    std::vector<Pair> pairs;
    unsigned every = 1;     // of process data: sent in cycles whose number divided by this
    unsigned phase = 0;     // leaves this rest
    bool was_sent = false;  // in the last cycle
    std::uint8_t index = 0;
    bool is_out = false;
    unsigned age = 0;  // cycles since it was sent
  };
  struct Data {
    std::vector<std::uint8_t> outputs;
    std::vector<std::uint8_t> inputs;
    bool outputs_good = false;
    bool fresh = false;
  };
  enum class Slot : std::uint8_t { Free, Out, Lost, Back };

  void plan_frames();
  void plan_frames(unsigned every);
  void take_frames(Clock now) noexcept;
  void take_frame(Bytes bytes, Clock now) noexcept;
  void take_process(const Frame& frame, Bytes bytes, Clock now) noexcept;
  void take_pair(const Pair& pair, Bytes bytes, Clock now) noexcept;
  void take_inputs(std::size_t place, std::uint16_t wkc, Bytes bytes, Clock now) noexcept;
  void take_service(const Frame& frame, Bytes bytes, Clock now) noexcept;
  [[nodiscard]] Frame* frame_of(std::uint8_t index) noexcept;
  void expire(Clock now) noexcept;
  void send_process(Clock now) noexcept;
  void add_pair(Frame& frame, Pair& pair) noexcept;
  [[nodiscard]] Bytes outputs_now(std::size_t place) const noexcept;
  void add_clock(Frame& frame, Clock now) noexcept;
  void take_clock(Bytes bytes, Clock now) noexcept;
  void send_service(Clock now) noexcept;
  void add_clock_query(Clock now) noexcept;
  static std::optional<std::size_t> add(Frame& frame, const Query& query) noexcept;
  void lose_service(Clock now) noexcept;
  void send_frame(Frame& frame) noexcept;

  Link& link_;
  std::vector<SlavePlan> plans_;
  Events events_;
  Clocks clocks_;
  std::deque<SlaveControl> slaves_;
  std::vector<Data> data_;
  std::vector<Frame> process_;
  Frame service_;
  std::size_t next_service_ = 0;  // the slave whose turn it is
  std::array<Slot, 256> slots_{};
  std::uint8_t next_index_ = 0;
  std::uint64_t cycles_ = 0;
  BusCounters counters_;
  std::uint16_t slaves_seen_ = 0;
  std::size_t clock_at_ = 0;  // of the reference's time in the first frame; 0: it is not in it
  Clock clock_sent_at_{0};
};

}  // namespace indurop::io::ethercat
