// SPDX-License-Identifier: Apache-2.0
// The turning table of examples/two_boards as a plant of this test's own.

#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "network/mirror/frames/mirror_block.h"
#include "scheduler/run_block.h"
#include "store/vars/run_file.h"
#include "store/vars/store.h"
#include "tests/support/plant_fixture.h"

namespace indurop::test {

class TurningTable : public PlantTest {
 protected:
  static std::string element(const std::string& name, const std::string& module, const std::string& more = "") {
    const std::string text = module.empty() ? ""
                                            : "<module><filename>" TWO_BOARDS "/" + module +
                                                  ".so</filename><moduletype>thread</moduletype><operationtype>periodic"
                                                  "</operationtype><period>1ms</period><priority>1</priority>" +
                                                  more + "</module>";
    return "<board name=\"" + board(name) + "\">" + text + "</board>";
  }
  std::string write(const std::string& boards) {
    const std::string file = path("plant.xml");
    std::ofstream(file) << "<plant name=\"pt\"><domain>" << domain()
                        << "</domain><external>off</external><lease>200ms</lease>" << boards << "</plant>";
    return file;
  }
  std::string two_boards() { return write(element("sensor", "table") + element("control", "controller")); }

  Program& indurop(std::vector<std::string> words) {
    words.insert(words.begin(), INDUROP_PROGRAM);
    return start(std::move(words));
  }

  // A number of a variable as one board has it; 0 while the board does not run.
  template <class Number = std::uint64_t>
  static Number number(const std::string& name, const std::string& variable, std::uint32_t offset = 0) {
    const auto store = vars::Store::attach(board(name), vars::Mode::ReadOnly);
    const auto* entry = store ? store.value().find(abi::fnv1a64(variable.data(), variable.size())) : nullptr;
    std::uint8_t bytes[8] = {};
    if (entry == nullptr || !store.value().read(*entry, offset, bytes)) {
      return 0;
    }
    Number result = 0;
    std::memcpy(&result, bytes, sizeof result);
    return result;
  }
  double speed(const std::string& name) { return number<double>(name, "cell::encoder", 8); }
  double torque(const std::string& name) { return number<double>(name, "cell::torque"); }
  // The controller keeps the table at 2 rad/s, for which it needs 0.04 Nm.
  bool controlled() {
    return std::abs(speed("sensor") - 2) < 0.01 && std::abs(speed("control") - 2) < 0.01 && torque("sensor") > 0.03;
  }

  [[nodiscard]] static pid_t pid_of(const std::string& name) {
    const auto file =
        vars::RunFile::open(board(name), vars::Mode::ReadOnly, scheduler::kRunMagic, sizeof(scheduler::RunBlock));
    return file ? static_cast<const scheduler::RunBlock*>(file.value().data())->node_pid.load() : 0;
  }
};

}  // namespace indurop::test
