// SPDX-License-Identifier: Apache-2.0
// The path along which a robot is guided by hand, recorded by a thread of its own as long as a client holds the switch.

#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "control/robot/files/teach.h"
#include "store/vars/store.h"
#include "tools/client/robot/guided_record.h"

namespace indurop::serve {

// May be used by any thread.
class GuidedPath {
 public:
  // What is known of it.
  struct View {
    bool records = false;  // the switch is held
    bool guided = false;   // a hand may push the robot now
    std::size_t places = 0;
    std::size_t marks = 0;
    double length = 0;    // mm
    std::string tool;     // that is held; empty: none
    std::string problem;  // why recording ended, if it was not ended
  };

  // Begins to record.
  GuidedPath(vars::Store store, tools::GuidedRecord record);
  // Nothing is added any more. Does not wait.
  void stop();
  [[nodiscard]] View view() const;
  [[nodiscard]] std::vector<robot::GuidedPlace> places() const;

 private:
  void run(const std::stop_token& ended);
  // Returns whether to continue.
  bool take();

  mutable std::mutex mutex_;
  vars::Store store_;
  tools::GuidedRecord record_;
  std::string problem_;
  bool records_ = true;
  std::jthread thread_;  // the last member: it uses the others
};

}  // namespace indurop::serve
