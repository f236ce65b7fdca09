// SPDX-License-Identifier: Apache-2.0
// What the master does with one slave, worked out before the bus starts: registers to write, objects to set, where its
// process data is. Not real-time safe.

#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "control/io/ethercat/sii.h"

namespace indurop::io::ethercat {

struct StartObject {  // set in PREOP, each time the slave comes up
  std::uint16_t index = 0;
  std::uint8_t subindex = 0;
  bool complete = false;
  std::vector<std::uint8_t> value;
};

// Pulses of the slave's clock, at which it takes outputs and reads inputs.
struct SyncPlan {
  std::uint16_t activation = 0;  // what starts them, as the device's description says (AssignActivate); 0: none
  std::chrono::nanoseconds cycle{0};
  std::chrono::nanoseconds shift{0};  // of the pulse after the frame passes the reference clock
  std::chrono::nanoseconds sync1{0};  // cycle of SYNC1
};

struct SlavePlan {
  std::string name;
  Identity identity;          // revision and serial 0: any
  std::uint16_t alias = 0;    // 0: any
  std::uint32_t logical = 0;  // address of its process data
  MailboxArea mailbox;
  std::vector<std::uint8_t> mailbox_managers;  // register bytes; empty without a mailbox
  std::uint16_t process_managers_at = 0;
  std::vector<std::uint8_t> process_managers;
  std::vector<std::uint8_t> fmmus;  // logical addresses from 0 on: outputs, then inputs
  std::size_t output_bytes = 0;
  std::size_t input_bytes = 0;
  std::vector<std::uint8_t> safe_outputs;  // sent while the application gives none
  bool uses_lrw = true;                    // no: its process data goes in a LWR and a LRD, in the same frame
  std::vector<StartObject> start_objects;
  unsigned every = 1;  // its process data is exchanged once in so many cycles
  SyncPlan sync;
};

// The plan for a slave whose assigned PDOs are exchanged, at this logical address. Its safe outputs are zeros, its
// start objects those of the mapping, as far as the slave lets its master write them.
SlavePlan plan_of(const Sii& sii, std::uint32_t logical);

}  // namespace indurop::io::ethercat
