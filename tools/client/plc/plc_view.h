// SPDX-License-Identifier: Apache-2.0
// The code of a running PLC program with its values: power in networks, active steps, values of variables.

#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "control/plc/draw/text_picture.h"
#include "control/plc/front/watch_plan.h"
#include "control/plc/print/live.h"
#include "tools/client/values/watch_source.h"

namespace indurop::tools {

// Selects a part of the program.
struct ViewChoice {
  std::string pou;       // empty: all programs
  std::string instance;  // "main.motor"; empty: the first of the POU
  int rung = 0;          // 0: all
};

// Returns true if the code is text, not a drawing.
bool is_text(const plc::LiveBody& body);
// Returns the indentation of its first statement.
std::string first_indent(const plc::LiveBody& body);

class PlcView {
 public:
  // The code of one instance.
  struct Shown {
    const plc::LiveBody* body = nullptr;
    std::string title;        // "main.motor"
    std::string inside;       // POU in the program: "MOTOR", "" for the program itself
    std::size_t program = 0;  // index in the plan
  };
  PlcView(Access& access, const plc::WatchPlan& plan, std::vector<plc::LiveBody> bodies, ViewChoice choice);

  // Finds the selected part and attaches to the node.
  Result<void, Failure> open();
  // Reads the values. Fails if another program runs now, whose values would be shown at the wrong places.
  Result<void, Failure> sample();

  [[nodiscard]] const WatchSource& source() const noexcept { return *source_; }
  [[nodiscard]] const std::vector<Shown>& shown() const noexcept { return shown_; }
  [[nodiscard]] int rung() const noexcept { return choice_.rung; }  // the selected one; 0: all
  // Names of instances of the POU that are not shown, separated by commas.
  [[nodiscard]] const std::string& others() const noexcept { return others_; }
  [[nodiscard]] bool flag(const Shown& shown, const std::string& path, std::size_t index) const;
  // Returns the value of a variable of the instance, else of a shared one; "" if there is none.
  [[nodiscard]] std::string value(const Shown& shown, const std::string& path) const;
  [[nodiscard]] plc::draw::Live live_of(const Shown& shown) const;

  // For other programs: the drawings, which are constant, and the values that change in them, in the same order.
  [[nodiscard]] JsonValue pictures() const;
  [[nodiscard]] JsonValue live() const;
  // For programs that show instances as objects: tasks, programs, types, and where values are in the watched data.
  [[nodiscard]] JsonValue model() const;

 private:
  Result<void, Failure> choose();
  [[nodiscard]] std::string title_of(std::size_t program, const std::string& name) const;
  void show(std::size_t program, const plc::WatchedInstance& instance);
  [[nodiscard]] std::vector<std::string> names();
  void add_shared(const std::string& path, std::vector<std::string>& names);
  Result<void, Failure> check_marks() const;

  [[nodiscard]] std::string path_of(const Shown& shown, const std::string& path) const;
  [[nodiscard]] std::span<const std::uint8_t> bytes_of(const Shown& shown) const;
  [[nodiscard]] const plc::WatchedVariable* find(const Shown& shown, const std::string& path) const;
  [[nodiscard]] std::string shared_value(const std::string& name) const;
  [[nodiscard]] std::string output_value(const Shown& shown, const plc::network::Source& source) const;

  [[nodiscard]] JsonValue networks_of(const Shown& shown) const;
  void add_networks(const Shown& shown, JsonValue& one) const;
  void add_steps(const Shown& shown, JsonValue& one) const;

  Access& access_;
  const plc::WatchPlan& plan_;
  std::vector<plc::LiveBody> bodies_;
  ViewChoice choice_;
  std::vector<Shown> shown_;
  std::string others_;                             // instances of the POU that are not shown
  std::vector<std::size_t> values_of_;             // by program of the plan: the value with its watched data
  std::map<std::string, std::size_t> shared_;      // by name in capitals
  std::map<std::string, const plc::Type*> types_;  // of shared variables
  std::vector<std::map<std::string, const plc::WatchedVariable*>> paths_;  // by program
  std::optional<WatchSource> source_;
};

}  // namespace indurop::tools
