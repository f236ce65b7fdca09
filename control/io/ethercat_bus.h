// SPDX-License-Identifier: Apache-2.0
// One EtherCAT bus for all of its slaves that are devices of this module. A thread of its own opens the interface,
// finds out who is on the cable and says what happens there; the exchange itself belongs to the tick.

#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "control/io/ethercat/master/copies.h"
#include "control/io/ethercat/master/master.h"
#include "control/io/ethercat/master/scan.h"
#include "control/io/ethercat_field.h"
#include "control/io/ethercat_losses.h"
#include "control/io/ethercat_members.h"
#include "control/io/ethercat_wires.h"
#include "core/rt/thread.h"

namespace indurop::io {

class EthercatBus {
 public:
  // `interface`: as ioconfig.xml has it, two of a ring: "eth1,eth2".
  EthercatBus(std::string interface, EthercatWires wires)
      : interface_(std::move(interface)), wires_(std::move(wires)) {}
  EthercatBus(const EthercatBus&) = delete;
  EthercatBus& operator=(const EthercatBus&) = delete;
  ~EthercatBus();

  // Before start(). Returns the number of the member.
  std::size_t add(EthercatMember member);
  // Starts the thread, whose messages are those of the calling module; a simulation has none: slaves are there when
  // this returns. False: the system has no thread. Does nothing if it was started already.
  bool start();
  // Brings all slaves to INIT and ends the thread. No tick may run any more.
  void stop();

  // In the tick, each member once: the first one takes what came back, the last one copies from slave to slave and
  // sends. Null: there are no slaves yet. Real-time safe.
  ethercat::Master* begin_turn() noexcept;
  void end_turn() noexcept;
  // As Driver::cut(); of the latest turn.
  [[nodiscard]] std::uint32_t cut() const noexcept;
  // Where the points of a member are in its process data; only after begin_turn() returned a master.
  using Fields = std::vector<std::optional<EthercatField>>;
  [[nodiscard]] const Fields& outputs(std::size_t member) const noexcept { return running_->outputs[member]; }
  [[nodiscard]] const Fields& inputs(std::size_t member) const noexcept { return running_->inputs[member]; }
  // Its position on the cable, from 0.
  [[nodiscard]] std::size_t place(std::size_t member) const noexcept { return running_->places[member]; }

 private:
  struct Running {
    Running(ethercat::Link& link, std::vector<ethercat::SlavePlan> plans, ethercat::Clock period, EthercatPlaces at)
        : master(link, std::move(plans), period), places(std::move(at)) {}
    ethercat::Master master;
    ethercat::Copies copies;
    EthercatPlaces places;  // by member, as the following
    std::vector<Fields> outputs;
    std::vector<Fields> inputs;
  };
  // What the tick tells the thread: one writes, one reads.
  class EventQueue {
   public:
    void push(const ethercat::Event& event) noexcept;
    bool pop(ethercat::Event& event) noexcept;

   private:
    std::array<ethercat::Event, 256> events_{};
    std::atomic<std::size_t> written_{0};
    std::atomic<std::size_t> read_{0};
  };

  static constexpr std::uint64_t kWhole = ~std::uint64_t{0};

  static void report_pulse(const ethercat::Master& master) noexcept;
  void work();
  [[nodiscard]] std::string prepare();
  [[nodiscard]] std::string check(const std::vector<ethercat::FoundSlave>& found) const;
  [[nodiscard]] std::string map(std::vector<ethercat::FoundSlave>& found, const EthercatPlaces& places) const;
  void make_fields(const std::vector<ethercat::FoundSlave>& found, Running& running) const;
  [[nodiscard]] Fields fields_of(const EthercatMember& member, const std::vector<config::IoPoint>& points,
                                 const std::vector<ethercat::Pdo>& pdos) const;
  void report(const std::string& problem);
  void report_all();
  void report_events();
  void report_carrier();
  void report_cut();
  void report_losses();
  bool wait(std::chrono::milliseconds time);

  std::string interface_;
  EthercatWires wires_;
  std::vector<EthercatMember> members_;
  std::unique_ptr<ethercat::Wire> wire_;
  std::unique_ptr<Running> owned_;
  std::atomic<Running*> ready_{nullptr};
  Running* running_ = nullptr;          // the tick's
  std::size_t turn_ = 0;                // members that had theirs in this tick
  std::chrono::nanoseconds period_{0};  // of the module
  EventQueue events_;
  EthercatLosses losses_;
  std::atomic<std::uint64_t> cut_{kWhole};  // where the ring is: the tick writes, the thread reads
  std::uint64_t reported_cut_ = kWhole;
  std::string reported_;
  bool had_carrier_ = true;
  bool tried_ = false;  // a simulated bus is prepared once, however many devices start it
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;  // guarded by the mutex
  rt::Thread thread_;
};

}  // namespace indurop::io
