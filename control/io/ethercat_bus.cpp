// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat_bus.h"

#include <fmt/format.h>
#include <indurop/irp.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "config/check/io_mapping.h"
#include "control/io/driver.h"
#include "control/io/ethercat_copies.h"
#include "store/runtime/host.h"

namespace indurop::io {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kRetry{500};
constexpr milliseconds kPoll{20};
constexpr std::uint32_t kFirstAddress = 0x10000;  // of the process data on the bus

std::string name_of_object(config::IoObject object) {
  return fmt::format("{:04x}:{:02x}", object.index, object.subindex);
}

// What the PDOs of a slave have, each once.
std::string objects_of(const std::vector<ethercat::Pdo>& pdos) {
  std::vector<std::string> names;
  for (const ethercat::Pdo& pdo : pdos) {
    for (const ethercat::PdoEntry& entry : pdo.entries) {
      const std::string name = name_of_object({entry.index, entry.subindex});
      if (entry.index != 0 && std::find(names.begin(), names.end(), name) == names.end()) {
        names.push_back(name);
      }
    }
  }
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

// What the EEPROM does not say of its PDOs.
void add_excludes(const Excludes& excludes, ethercat::Sii& sii) {
  for (auto* const pdos : {&sii.outputs, &sii.inputs}) {
    for (ethercat::Pdo& pdo : *pdos) {
      const auto found = excludes.find(pdo.index);
      pdo.excludes = found == excludes.end() ? pdo.excludes : found->second;
    }
  }
}

// Which point, or end of a copy, cannot be exchanged, and why.
std::string refusal_of(const EthercatMember& member, const config::IoBlock& block,
                       const config::Unexchangeable& problem, const ethercat::Sii& sii) {
  const std::string object =
      block.kind == config::IoBlock::Kind::Object ? fmt::format(" ({})", name_of_object(block.first)) : "";
  return fmt::format("{} ({}), device {}: {} {}{} cannot be exchanged: {}; its {} are {}",
                     config::describe(member.slave), sii.name, member.device, problem.output ? "output" : "input",
                     block.at, object, problem.reason, problem.output ? "outputs" : "inputs",
                     objects_of(problem.output ? sii.outputs : sii.inputs));
}

}  // namespace

void EthercatBus::EventQueue::push(const ethercat::Event& event) noexcept {
  const std::size_t at = written_.load(std::memory_order_relaxed);
  if (at - read_.load(std::memory_order_acquire) < events_.size()) {
    events_[at % events_.size()] = event;
    written_.store(at + 1, std::memory_order_release);
  }
}

bool EthercatBus::EventQueue::pop(ethercat::Event& event) noexcept {
  const std::size_t at = read_.load(std::memory_order_relaxed);
  if (at == written_.load(std::memory_order_acquire)) {
    return false;
  }
  event = events_[at % events_.size()];
  read_.store(at + 1, std::memory_order_release);
  return true;
}

EthercatBus::~EthercatBus() {
  stop();
}

std::size_t EthercatBus::add(EthercatMember member) {
  members_.push_back(std::move(member));
  return members_.size() - 1;
}

bool EthercatBus::start() {
  if (thread_.joinable() || owned_ != nullptr || tried_) {
    return true;
  }
  period_ = irp::period();
  if (wires_.is_simulated) {
    tried_ = true;
    report(prepare());
    ready_.store(owned_.get(), std::memory_order_release);
    return true;
  }
  auto thread =
      rt::Thread::start({"irp-ethercat", 0, -1, kThreadStackBytes}, [this, module = runtime::current_module()] {
        runtime::set_current_module(module);
        work();
      });
  if (!thread) {
    return false;
  }
  thread_ = std::move(thread).value();
  return true;
}

void EthercatBus::stop() {
  if (thread_.joinable()) {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }
  if (owned_ != nullptr) {
    ethercat::FrameBuilder builder(ethercat::kMasterMac);
    const std::array<std::uint8_t, 2> init = {static_cast<std::uint8_t>(ethercat::AlState::Init) | ethercat::kAlError,
                                              0};
    builder.add(ethercat::Command::Bwr, 0, ethercat::address_of(0, ethercat::reg::kAlControl), init);
    wire_->link().send(builder.finish());
    irp::printf("EtherCAT %s: %s\n", interface_, losses_.total());
  }
  ready_ = nullptr;
  running_ = nullptr;
  owned_.reset();
  wire_.reset();
}

ethercat::Master* EthercatBus::begin_turn() noexcept {
  if (turn_ == 0) {
    running_ = ready_.load(std::memory_order_acquire);
    if (running_ != nullptr) {
      running_->master.receive(wire_->now());
      const auto cut = wire_->cut();
      cut_.store(cut ? std::uint64_t{cut->before} << 32U | cut->behind : kWhole, std::memory_order_relaxed);
    }
  }
  return running_ == nullptr ? nullptr : &running_->master;
}

void EthercatBus::end_turn() noexcept {
  turn_ = (turn_ + 1) % members_.size();
  if (turn_ != 0 || running_ == nullptr) {
    return;
  }
  const ethercat::Clock now = wire_->now();
  running_->copies.run(running_->master, now);
  running_->master.send(now);
  losses_.set(running_->master.counters());
  if (running_->master.clocks().reference()) {
    irp::shift_ticks(std::chrono::nanoseconds(running_->master.clocks().tick_correction()));
    report_pulse(running_->master);
  }
  ethercat::Event event;
  while (running_->master.next_event(event) || running_->copies.next_event(event)) {
    events_.push(event);
  }
  if (wires_.is_simulated) {
    report_all();
  }
}

std::uint32_t EthercatBus::cut() const noexcept {
  const std::uint64_t cut = cut_.load(std::memory_order_relaxed);
  return cut == kWhole ? 0 : static_cast<std::uint32_t>(cut >> 32U) + 1;
}

// That of the slave which is farthest from where it shall be.
void EthercatBus::report_pulse(const ethercat::Master& master) noexcept {
  ethercat::Clock after{0};
  ethercat::Clock wanted{0};
  for (std::size_t i = 0; i < master.size(); ++i) {
    const auto found = master.slave(i).pulse_after();
    const ethercat::Clock shift = master.plan(i).sync.shift;
    if (found && (wanted.count() == 0 || std::abs((*found - shift).count()) > std::abs((after - wanted).count()))) {
      after = *found;
      wanted = shift;
    }
  }
  irp::report_pulse(after, wanted);
}

// --- the thread ---

bool EthercatBus::wait(milliseconds time) {
  std::unique_lock lock(mutex_);
  return !wake_.wait_for(lock, time, [this] { return stop_; });
}

void EthercatBus::work() {
  do {
    report(prepare());
  } while (owned_ == nullptr && wait(kRetry));
  ready_.store(owned_.get(), std::memory_order_release);
  while (wait(kPoll)) {
    report_all();
  }
}

void EthercatBus::report(const std::string& problem) {
  if (!problem.empty() && std::exchange(reported_, problem) != problem) {
    irp::printf("EtherCAT %s: %s%s\n", interface_, problem, wires_.is_simulated ? "" : "; trying again");
  }
}

void EthercatBus::report_all() {
  report_carrier();
  report_cut();
  report_losses();
  report_events();
}

void EthercatBus::report_carrier() {
  const bool has_carrier = wire_->has_carrier();
  if (std::exchange(had_carrier_, has_carrier) != has_carrier) {
    irp::printf(has_carrier ? "EtherCAT %s: the link is back\n"
                            : "EtherCAT %s: no link; check the cable, and the power of the first slave\n",
                interface_);
  }
}

void EthercatBus::report_cut() {
  const std::uint64_t cut = cut_.load(std::memory_order_relaxed);
  if (std::exchange(reported_cut_, cut) == cut) {
    return;
  }
  if (cut == kWhole) {
    irp::printf("EtherCAT %s: the cable is whole again\n", interface_);
    return;
  }
  const std::size_t before = cut >> 32U;
  const std::size_t behind = cut & 0xFFFFFFFFU;
  const std::string left = before == 0 ? "the first interface" : fmt::format("slave {}", before - 1);
  const std::string right = behind == owned_->master.size() ? "the second interface" : fmt::format("slave {}", behind);
  irp::printf("EtherCAT %s: the cable is cut between %s and %s%s\n", interface_, left, right,
              before == behind ? "; all slaves are reached" : "; those between them are not reached");
}

void EthercatBus::report_losses() {
  if (const std::string news = losses_.news(wire_->now()); !news.empty()) {
    irp::printf("EtherCAT %s: %s\n", interface_, news);
  }
}

void EthercatBus::report_events() {
  ethercat::Event event;
  while (events_.pop(event)) {
    irp::printf("EtherCAT %s: %s\n", interface_, describe(event, owned_->master.plan(event.slave).name));
  }
}

// Returns what is wrong; nothing if the bus is ready for the tick.
std::string EthercatBus::prepare() {
  auto wire = wires_.open(interface_);
  if (!wire) {
    return wire.error();
  }
  if (!(*wire)->has_carrier()) {
    return "no link; check the cable, and the power of the first slave";
  }
  auto found = ethercat::Scan((*wire)->link(), [&wire] {
                 (*wire)->wait(milliseconds(1));
                 return (*wire)->now();
               }).run();
  if (!found) {
    return found.error();
  }
  if (std::string wrong = check(*found); !wrong.empty()) {
    return wrong;
  }
  auto places = find_members(members_, *found, interface_);
  if (!places) {
    return places.error();
  }
  if (std::string wrong = map(*found, *places); !wrong.empty()) {
    return wrong;
  }
  auto copies = find_copies(members_, *found, *places);
  if (!copies) {
    return copies.error();
  }
  std::vector<ethercat::SlavePlan> plans;
  std::uint32_t logical = kFirstAddress;
  for (const ethercat::FoundSlave& slave : *found) {
    plans.push_back(ethercat::plan_of(slave.sii, logical));
    plans.back().uses_lrw &= (slave.features & ethercat::kNoLrw) == 0;
    logical += static_cast<std::uint32_t>(plans.back().output_bytes + plans.back().input_bytes);
  }
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const EthercatMember& member = members_[i];
    ethercat::SlavePlan& plan = plans[(*places)[i]];
    plan.alias = member.slave.alias.value_or(0);
    plan.every = period_.count() > 0 ? std::max(1U, static_cast<unsigned>(member.slave.cycle / period_)) : 1U;
    // The mapping comes after what the file sets, so that nothing in the file changes it.
    std::vector<ethercat::StartObject> objects;
    for (const config::IoObjectValue& value : member.slave.values) {
      objects.push_back({value.object.index, value.object.subindex, false, value.bytes});
    }
    plan.start_objects.insert(plan.start_objects.begin(), objects.begin(), objects.end());
    const config::IoSync& sync = member.slave.sync;
    plan.sync = {sync.activate, sync.cycle, sync.shift, sync.sync1};
  }
  wire_ = std::move(*wire);
  owned_ = std::make_unique<Running>(wire_->link(), std::move(plans), period_, std::move(*places));
  make_fields(*found, *owned_);
  owned_->copies = ethercat::Copies(*copies, owned_->master);
  return {};
}

std::string EthercatBus::check(const std::vector<ethercat::FoundSlave>& found) const {
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i].problem.empty()) {
      return fmt::format("slave {}: {}", i, found[i].problem);
    }
  }
  for (const EthercatMember& member : members_) {
    if (member.slave.sync.activate != 0 && interface_.find(',') != std::string::npos) {
      return fmt::format("{}, device {}: a ring has no clocks; leave out <sync>, or name one interface only",
                         config::describe(member.slave), member.device);
    }
    if (period_.count() > 0 && member.slave.cycle % period_ != std::chrono::nanoseconds(0)) {
      return fmt::format("{}, device {}: its cycle is {} us, which is no multiple of the module's period, {} us",
                         config::describe(member.slave), member.device,
                         member.slave.cycle / std::chrono::microseconds(1), period_ / std::chrono::microseconds(1));
    }
    if (period_.count() > 0 && member.slave.sync.cycle % period_ != std::chrono::nanoseconds(0)) {
      return fmt::format(
          "{}, device {}: the cycle of <sync> is {} us, which is no multiple of the module's period, {} us",
          config::describe(member.slave), member.device, member.slave.sync.cycle / std::chrono::microseconds(1),
          period_ / std::chrono::microseconds(1));
    }
  }
  return {};
}

// Chooses the process data of each slave by the points and copies of its device. Returns what is wrong.
std::string EthercatBus::map(std::vector<ethercat::FoundSlave>& found, const EthercatPlaces& places) const {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const EthercatMember& member = members_[i];
    ethercat::Sii& sii = found[places[i]].sii;
    add_excludes(member.excludes, sii);
    const auto outputs = config::wanted_outputs(member.outputs, member.slave);
    const auto inputs = config::wanted_inputs(member.inputs, member.slave);
    auto mapped = config::map_blocks(sii, outputs, inputs);
    if (!mapped) {
      const config::Unexchangeable& problem = mapped.error();
      return refusal_of(member, (problem.output ? outputs : inputs)[problem.block], problem, sii);
    }
    sii = std::move(*mapped);
  }
  return {};
}

void EthercatBus::make_fields(const std::vector<ethercat::FoundSlave>& found, Running& running) const {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const EthercatMember& member = members_[i];
    const ethercat::Sii& sii = found[running.places[i]].sii;
    running.outputs.push_back(fields_of(member, member.outputs, sii.outputs));
    running.inputs.push_back(fields_of(member, member.inputs, sii.inputs));
    // What the file sets stays set although the object is exchanged, unless a point writes it.
    const auto outputs = running.master.outputs(running.places[i]);
    for (const config::IoObjectValue& value : member.slave.values) {
      const auto field = find_field(sii.outputs, value.object);
      if (field && field->bits == 8 * value.bytes.size()) {
        ethercat::copy_bits(value.bytes, 0, outputs, field->bit, field->bits);
      }
    }
  }
}

EthercatBus::Fields EthercatBus::fields_of(const EthercatMember& member, const std::vector<config::IoPoint>& points,
                                           const std::vector<ethercat::Pdo>& pdos) const {
  Fields fields;
  for (const config::IoPoint& point : points) {
    fields.push_back(find_field(pdos, point.object));
    if (!fields.back()) {
      irp::printf("I/O device %s: %s %s (%s) is no number of at most 64 bits\n", member.device,
                  point.output ? "output" : "input", point.at, name_of_object(point.object));
    }
  }
  return fields;
}

}  // namespace indurop::io
