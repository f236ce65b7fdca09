// SPDX-License-Identifier: Apache-2.0
// A simulated slave: the application of the controller chip. State machine with the checks of a real one, mailbox with
// CoE, process data, and the faults that a script asks for. In virtual time: the same frames give the same bytes.

#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "control/io/ethercat/coe.h"
#include "control/io/ethercat/frame.h"
#include "control/io/ethercat/sii.h"
#include "control/io/ethercat/simulator/esc.h"
#include "control/io/ethercat/simulator/foe_server.h"
#include "control/io/ethercat/simulator/object_dictionary.h"

namespace indurop::io::ethercat {

struct SlaveConfig {
  EscConfig esc;  // with the EEPROM, from which the slave knows its mailbox and process data
  ObjectDictionary objects;
  Time state_time{1'000'000};  // from a request for a state to the answer
  Time mailbox_time{200'000};
};

class Slave {
 public:
  // Called by compute(): what the slave applies (only in OP, else empty), and the inputs to fill.
  using Application = std::function<void(Bytes outputs, std::span<std::uint8_t> inputs)>;

  explicit Slave(SlaveConfig config, Application application = {});

  // A frame passes: `now` when it comes in at port 0.
  void process(std::span<std::uint8_t> frame, Time now, const Returns& returns);
  // Runs the application if a frame brought outputs or another state. The frame has left by then, as with a real
  // slave: what the application computes goes into later frames.
  void compute();
  void set_power(bool on);
  // The ports to which something is linked: the master or another slave.
  void set_ports(const std::array<bool, kPorts>& open) noexcept;

  void send_emergency(const Emergency& emergency);
  // Refuses the next requests for this state with this code.
  void refuse_state(AlState state, std::uint16_t code, unsigned times);
  // Takes so long for changes of its state until then.
  void slow_down(Time state_time, Time until) noexcept;
  // Sends each answer of its mailbox twice until then, with the same counter.
  void repeat_answers(Time until) noexcept { repeats_until_ = until; }
  // Falls into this state with this code, as a drive does that detects a fault of its own.
  void fall_to(AlState state, std::uint16_t code) noexcept;

  [[nodiscard]] bool is_on() const noexcept { return on_; }
  [[nodiscard]] AlState state() const noexcept;
  [[nodiscard]] Esc& esc() noexcept { return esc_; }
  // What its EEPROM says.
  [[nodiscard]] const Sii& sii() const noexcept { return sii_; }
  [[nodiscard]] ObjectDictionary& objects() noexcept { return objects_; }
  [[nodiscard]] SdoServer& sdo() noexcept { return sdo_; }
  [[nodiscard]] FoeServer& foe() noexcept { return foe_; }

 private:
  static constexpr unsigned kMailboxOut = 0;  // SyncManagers
  static constexpr unsigned kMailboxIn = 1;
  struct Area {
    std::uint16_t start = 0;
    std::uint16_t length = 0;
  };

  void run_datagram(const Datagram& datagram, std::span<std::uint8_t> frame, Time now, const Returns& returns);
  [[nodiscard]] bool is_station(std::uint16_t address) const noexcept;
  void access(const Datagram& datagram, std::span<std::uint8_t> frame, bool reads, bool writes, Time now);
  void access_logical(const Datagram& datagram, std::span<std::uint8_t> frame, Time now);
  void react(Time now);
  void advance_device(Time now);
  void change_state(std::uint8_t request);
  void emulate_state() noexcept;
  [[nodiscard]] std::uint16_t take_refusal(AlState to) noexcept;
  [[nodiscard]] std::uint16_t check_change(AlState from, AlState to) const;
  [[nodiscard]] std::uint16_t check_boot(AlState from, AlState to) const;
  [[nodiscard]] bool mailbox_fits(const MailboxArea& area) const;
  [[nodiscard]] bool process_data_fits(SyncManagerUse use, unsigned number) const;
  [[nodiscard]] std::size_t process_bytes(SyncManagerUse use) const;
  [[nodiscard]] Area area_of(unsigned sync_manager) const noexcept;
  void receive_mailbox(Time now);
  void answer_with(MailboxType type, Bytes bytes, Time now);
  void answer_coe(const Mailbox& mailbox, Time now);
  void deliver_mailbox(Time now);

  unsigned dl_status_;
  Esc esc_;
  ObjectDictionary objects_;
  Application application_;
  Time state_time_;
  Time slow_time_{0};
  Time slow_until_{0};
  Time mailbox_time_;
  Sii sii_;
  // SyncManagers of the process data; those after a mailbox if the EEPROM names none.
  unsigned output_manager_ = 2;
  unsigned input_manager_ = 3;
  SdoServer sdo_;
  FoeServer foe_;
  bool on_ = true;
  std::optional<Time> state_due_;
  struct Message {
    Time due{0};
    std::vector<std::uint8_t> bytes;
  };
  std::deque<Message> answers_;
  Time repeats_until_{0};
  std::vector<std::uint8_t> last_answer_;
  std::uint8_t last_counter_ = 0;
  std::uint8_t own_counter_ = 0;
  Time outputs_at_{0};
  bool outputs_off_ = false;  // by the watchdog
  bool is_due_ = false;       // the application
  struct Refusal {
    AlState state = AlState::None;
    std::uint16_t code = 0;
    unsigned times = 0;
  } refusal_;
};

}  // namespace indurop::io::ethercat
