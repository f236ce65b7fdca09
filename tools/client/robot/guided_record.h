// SPDX-License-Identifier: Apache-2.0
// The path along which a hand guides a robot, recorded from its shared variables.

#pragma once

#include <indurop/result.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "control/robot/files/teach.h"
#include "core/base/problem.h"
#include "store/operate/item.h"
#include "store/vars/store.h"

namespace indurop::tools {

class GuidedRecord {
 public:
  static constexpr std::int64_t kEachNs = 20'000'000;  // how often take() is to be called
  static constexpr std::size_t kMostPlaces = 180'000;  // an hour
  static constexpr int kByHand = 4;                    // ROBOT_JOG.eFrame

  // What take() found.
  struct News {
    bool began = false;   // a hand may guide the robot from now on
    bool marked = false;  // the present place was marked
    bool filled = false;  // from now on nothing more is recorded
  };

  // For the robot whose variables are in the namespace `space`. Fails if it has no variables for guiding. The record
  // refers to the schema of `store`.
  static Result<GuidedRecord, base::Problem> open(const vars::Store& store, const std::string& space);

  // Adds the present place if the robot is guided. It is marked if `mark`, or if ROBOT_GUIDE.nMark has changed.
  Result<News, base::Problem> take(const vars::Store& store, bool mark);

  [[nodiscard]] bool guided() const noexcept { return guided_; }
  [[nodiscard]] const std::vector<robot::GuidedPlace>& places() const noexcept { return places_; }
  [[nodiscard]] std::size_t marks() const noexcept { return marks_; }
  // Returns the way of the tip, in mm; the noise of an arm at rest does not count.
  [[nodiscard]] double length() const noexcept { return length_; }
  // Returns the tool that is held; empty: none.
  [[nodiscard]] const std::string& tool() const noexcept { return tool_; }

 private:
  operate::Item guiding_, mark_;
  std::string space_;
  std::vector<robot::GuidedPlace> places_;
  std::array<double, 3> last_{};  // place of the tip up to which the way is measured
  std::string tool_;
  std::optional<std::uint32_t> number_;  // of the last mark
  std::size_t marks_ = 0;
  double length_ = 0;
  bool guided_ = false;
};

// Returns why the robot cannot be guided in its present mode and state, and what to do; nothing: it can, or soon will.
std::optional<std::string> why_not_guided(const vars::Store& store, const std::string& space);

}  // namespace indurop::tools
