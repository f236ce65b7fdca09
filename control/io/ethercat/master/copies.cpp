// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/copies.h"

#include "control/io/ethercat/master/master.h"

namespace indurop::io::ethercat {

Copies::Copies(const std::vector<Copy>& copies, Master& master) {
  for (const Copy& copy : copies) {
    std::vector<std::uint8_t> fail_safe((copy.bits + 7) / 8);
    copy_bits(master.outputs(copy.to), copy.to_bit, fail_safe, 0, copy.bits);
    copies_.push_back({copy, std::move(fail_safe), std::nullopt});
  }
}

void Copies::report(const Copy& copy, Problem problem, Clock now) noexcept {
  events_.push({now, static_cast<std::uint16_t>(copy.to), problem, static_cast<std::uint32_t>(copy.from)});
}

void Copies::run(Master& master, Clock now) noexcept {
  for (Running& running : copies_) {
    const Copy& copy = running.copy;
    const auto to = master.outputs(copy.to);
    if (master.is_fresh(copy.from)) {
      if (!running.valid_at) {
        report(copy, Problem::CopyBegun, now);
      }
      copy_bits(master.inputs(copy.from), copy.from_bit, to, copy.to_bit, copy.bits);
      running.valid_at = now;
    } else if (running.valid_at && now - *running.valid_at > copy.hold) {
      report(copy, Problem::CopyLost, now);
      copy_bits(running.fail_safe, 0, to, copy.to_bit, copy.bits);
      running.valid_at.reset();
    }
  }
}

}  // namespace indurop::io::ethercat
