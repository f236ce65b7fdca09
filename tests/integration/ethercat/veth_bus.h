// SPDX-License-Identifier: Apache-2.0
// The master at the beginning of the cable of a veth_fixture.h, and lines of tshark.

#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "veth_fixture.h"

namespace indurop::io::ethercat {

inline constexpr Clock kCycle = std::chrono::milliseconds(1);

// The clock of the master counts cycles, so that its time-outs do not depend on how busy the machine is.
class Bus {
 public:
  explicit Bus(std::size_t drives) : Bus(plans_of_drives(drives)) {}
  explicit Bus(std::vector<SlavePlan> plans) {
    auto opened = PacketLink::open("ec0");
    if (!opened) {
      ADD_FAILURE() << opened.error();
      return;
    }
    packets_ = std::move(*opened);
    link_ = std::make_unique<PatientLink>(*packets_);
    master_ = std::make_unique<Master>(*link_, std::move(plans), std::chrono::milliseconds(1));
  }
  void cycle() {
    now_ += kCycle;
    master_->cycle(now_);
    Event event;
    while (master_->next_event(event)) {
      story_ += describe(event, "drive") + "\n";
    }
  }
  template <class Condition>
  bool run_until(Condition condition) {
    for (unsigned i = 0; i < 100'000 && !condition(); ++i) {
      cycle();
    }
    return condition();
  }
  bool run_until_all_operate() {
    return run_until([this] { return all_operate(); });
  }
  [[nodiscard]] bool all_operate() const {
    for (std::size_t i = 0; i < master_->size(); ++i) {
      if (!master_->slave(i).operates()) {
        return false;
      }
    }
    return true;
  }
  [[nodiscard]] bool all_fresh() const {
    for (std::size_t i = 0; i < master_->size(); ++i) {
      if (!master_->is_fresh(i)) {
        return false;
      }
    }
    return true;
  }
  Master& master() { return *master_; }
  PatientLink& link() { return *link_; }
  std::string& story() { return story_; }

 private:
  std::unique_ptr<PacketLink> packets_;
  std::unique_ptr<PatientLink> link_;
  std::unique_ptr<Master> master_;
  Clock now_{0};
  std::string story_;
};

inline std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == '\t') {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

}  // namespace indurop::io::ethercat
