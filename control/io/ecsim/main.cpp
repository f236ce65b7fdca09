// SPDX-License-Identifier: Apache-2.0
// `indurop-ecsim`: simulated EtherCAT slaves at a network interface, for a master at the other end of a cable or of a
// veth pair. It answers a frame first and computes what is behind it afterwards.

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <optional>

#include "control/io/ecsim/pcap_file.h"
#include "control/io/ethercat/link/packet_link.h"
#include "control/io/slaves/script.h"
#include "control/io/slaves/slave_word.h"
#include "core/base/exit_code.h"
#include "core/base/options.h"
#include "core/base/print.h"
#include "core/base/read_file.h"
#include "core/base/stop_signal.h"
#include "core/base/text.h"
#include "core/rt/clock.h"
#include "core/rt/thread.h"

namespace indurop::io::ecsim {
namespace {

using slaves::read_script;
using slaves::read_slave_word;
using slaves::Script;
using slaves::SlaveModel;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr const char* kDetails = R"(A SLAVE is
  drive                        a simulated servo drive (CiA 402)
  drive:start=-20,speed=220    with start, deg; speed, deg/s; acceleration, deg/s2;
                               following, deg; torque_bandwidth, Hz, with which the torque
                               follows its set point; counts of its encoder in a revolution;
                               alias, by which a master can find it; lrw=0: a chip without LRW
  el2004.bin                   the device of this EEPROM
  terminals.xml:EL2004         the device of a maker's file (ESI); without :EL2004 if it has one
  drive@1.3                    any of these at port 3 of slave 1, instead of behind the slave before
Devices of files keep the values of their outputs and send those of their inputs, which a
script sets.

Two ends of a cable without hardware:
  ip link add ec0 type veth peer name ec1
  ip link set ec0 up; ip link set ec1 up
  indurop-ecsim ec1 drive drive
  indurop io scan ec0

Lines of a script; times count from the first frame, slaves from 0. With --script -
lines come from the standard input, and times count from each of them:
)";

struct Setup {
  std::string interface;
  std::string ring;
  std::vector<std::string> slaves;
  std::filesystem::path script;
  std::filesystem::path pcap;
};

class Simulation {
 public:
  Simulation(ethercat::PacketLink& link, std::unique_ptr<PcapFile> pcap) : link_(link), pcap_(std::move(pcap)) {}

  // The cable comes in at this link, too.
  void make_ring(std::unique_ptr<ethercat::PacketLink> last) {
    last_link_ = std::move(last);
    last_end_ = &bus_.make_ring();
  }

  // Returns what is wrong with its place on the cable, empty: nothing.
  std::string add(SlaveModel model) {
    return slaves::add_slave(bus_.segment(), std::move(model), [this] { return now(); });
  }

  // Their times count from the first frame, or from now if it has come.
  void add_faults(const std::vector<ethercat::Fault>& faults) {
    for (ethercat::Fault fault : faults) {
      fault.at += now();
      bus_.add_fault(fault);
    }
  }
  void read_faults_from(int input) { input_ = input; }

  // Returns false if the file of frames could not be written.
  bool run(base::StopSignal& stop) {
    while (stop.wait(nanoseconds(0)) == 0) {
      link_.wait(patience());
      read_lines();
      answer();
      const auto next = bus_.next_arrival();
      if (!next || *next > now() + milliseconds(1)) {
        bus_.segment().compute();
        if (pcap_ != nullptr && !pcap_->flush()) {
          return false;
        }
      }
    }
    return true;
  }

 private:
  // Time since the first frame; before it, time stands still.
  [[nodiscard]] nanoseconds now() const { return began_ ? rt::MonoClock::now() - *began_ : nanoseconds(0); }

  [[nodiscard]] nanoseconds patience() const {
    const auto next = bus_.next_arrival();
    const nanoseconds longest = milliseconds(10);
    return next ? std::clamp(*next - now(), nanoseconds(0), longest) : longest;
  }

  // Reads what has come in as far as it is whole lines.
  void read_lines() {
    pollfd ready{input_, POLLIN, 0};
    if (input_ < 0 || poll(&ready, 1, 0) <= 0) {
      return;
    }
    std::array<char, 4096> bytes{};
    const ssize_t size = read(input_, bytes.data(), bytes.size());
    input_ = size > 0 ? input_ : -1;
    lines_.append(bytes.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
    const std::size_t end = lines_.rfind('\n') + 1;
    const Script script = read_script(lines_.substr(0, end), "-", bus_.segment().size());
    lines_.erase(0, end);
    base::print(stderr, "{}", base::to_text(script.diagnostics));
    add_faults(script.faults);
  }

  void answer() {
    take(link_, bus_);
    if (last_link_ != nullptr) {
      take(*last_link_, *last_end_);
    }
    bus_.advance(now());
    give(bus_, link_);
    if (last_link_ != nullptr) {
      give(*last_end_, *last_link_);
    }
  }
  void take(ethercat::Link& from, ethercat::Link& to) {
    std::array<std::uint8_t, ethercat::kMaxFrame> frame{};
    while (const std::size_t size = from.receive(frame)) {
      began_ = began_ ? began_ : rt::MonoClock::now();
      record(ethercat::Bytes(frame).first(size));
      bus_.advance(now());
      to.send(ethercat::Bytes(frame).first(size));
    }
  }
  void give(ethercat::Link& from, ethercat::Link& to) {
    std::array<std::uint8_t, ethercat::kMaxFrame> frame{};
    while (const std::size_t size = from.receive(frame)) {
      to.send(ethercat::Bytes(frame).first(size));
      record(ethercat::Bytes(frame).first(size));
    }
  }

  void record(ethercat::Bytes frame) {
    if (pcap_ != nullptr) {
      pcap_->add(nanoseconds(rt::wall_ns()), frame);
    }
  }

  ethercat::PacketLink& link_;
  std::unique_ptr<ethercat::PacketLink> last_link_;  // of a ring
  std::unique_ptr<PcapFile> pcap_;
  ethercat::SimulatedBus bus_;
  ethercat::Link* last_end_ = nullptr;
  std::optional<rt::MonoTime> began_;
  int input_ = -1;  // with lines of faults
  std::string lines_;
};

int fail(const std::string& text) {
  base::print(stderr, "indurop-ecsim: error: {}\n", text);
  return kFailed;
}

std::optional<std::vector<ethercat::Fault>> faults_of(const Setup& setup) {
  const auto text = base::read_file(setup.script);
  if (!text) {
    fail(base::cannot_read(setup.script, text.error()));
    return std::nullopt;
  }
  Script script = read_script(*text, setup.script, setup.slaves.size());
  base::print(stderr, "{}", base::to_text(script.diagnostics));
  return base::has_error(script.diagnostics) ? std::nullopt : std::optional(std::move(script.faults));
}

int run(const Setup& setup) {
  base::StopSignal stop;
  rt::request_exact_timers();  // else waits for a frame's way on the cable take 50 us longer
  auto link = ethercat::PacketLink::open(setup.interface);
  if (!link) {
    return fail(link.error());
  }
  Simulation simulation(**link, setup.pcap.empty() ? nullptr : std::make_unique<PcapFile>(setup.pcap));
  if (!setup.ring.empty()) {
    auto last = ethercat::PacketLink::open(setup.ring);
    if (!last) {
      return fail(last.error());
    }
    simulation.make_ring(std::move(*last));
  }
  for (const std::string& word : setup.slaves) {
    auto model = read_slave_word(word);
    if (!model) {
      return fail(model.error());
    }
    if (const std::string wrong = simulation.add(std::move(*model)); !wrong.empty()) {
      return fail(wrong);
    }
  }
  if (setup.script == "-") {
    simulation.read_faults_from(STDIN_FILENO);
  } else if (!setup.script.empty()) {
    const auto faults = faults_of(setup);
    if (!faults) {
      return kFailed;
    }
    simulation.add_faults(*faults);
  }
  base::print(stdout, "{} slaves at {}\n", setup.slaves.size(), setup.interface);
  std::fflush(stdout);
  return simulation.run(stop) ? kOk : fail(fmt::format("{} cannot be written", setup.pcap.string()));
}

}  // namespace
}  // namespace indurop::io::ecsim

int main(int argc, char** argv) {
  using namespace indurop;
  io::ecsim::Setup setup;
  base::Options app("indurop-ecsim", "Simulate EtherCAT slaves at a network interface");
  app.version(INDUROP_VERSION);
  app.add("interface", "INTERFACE", setup.interface, "Interface on which frames of the master arrive").required();
  app.add("slaves", "SLAVE", setup.slaves, "The slaves, in the order of the cable")
      .required()
      .completes(base::Completion::File);
  app.add("--ring", "INTERFACE", setup.ring, "Interface at the other end of the cable, for a ring");
  app.add("--script", "FILE", setup.script, "Faults that happen at their time").completes(base::Completion::File);
  app.add("--pcap", "FILE", setup.pcap, "Write all frames, for Wireshark").completes(base::Completion::File);
  app.details(io::ecsim::kDetails + io::slaves::script_help());
  app.exit_codes({kOk, kFailed, kUsage});
  if (const auto code = app.parse_program(argc, argv)) {
    return *code;
  }
  return io::ecsim::run(setup);
}
