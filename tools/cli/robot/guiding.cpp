// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/robot/guiding.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <vector>

#include "tools/cli/robot/hand.h"
#include "tools/cli/values/forcing.h"
#include "tools/client/node/node_choice.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

constexpr std::size_t kMostPlaces = 200'000;  // about an hour

// Returns whether a line was typed at the terminal since the last call.
bool line_typed() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (::isatty(STDIN_FILENO) == 0 || ::poll(&input, 1, 0) <= 0 || (input.revents & POLLIN) == 0) {
    return false;
  }
  std::array<char, 256> text{};
  return ::read(STDIN_FILENO, text.data(), text.size()) > 0;
}

// What is recorded while a hand guides the robot.
class GuideLog {
 public:
  GuideLog(Context& context, const vars::Store& store, const RobotChoice& choice)
      : context_(context), store_(store), choice_(choice) {}

  // Finds the variables. Returns the exit code.
  int begin() {
    return select_items(context_, store_,
                        {choice_.space + "::ROBOT_ARM.bGuided", choice_.space + "::ROBOT_GUIDE.nMark",
                         choice_.space + "::ROBOT_JOB.cMessage"},
                        items_);
  }
  // Takes the present place. Returns the exit code.
  int take() {
    const auto guided = operate::read(store_, items_[0]);
    const auto mark = operate::read(store_, items_[1]);
    if (!guided || !mark) {
      context_.out.error((guided ? mark : guided).error().text);
      return kFailed;
    }
    std::uint32_t number = 0;
    std::memcpy(&number, mark->data(), std::min(sizeof number, mark->size()));
    const bool pressed = last_mark_ && number != *last_mark_;
    last_mark_ = number;
    const bool now = std::any_of(guided->begin(), guided->end(), [](std::uint8_t byte) { return byte != 0; });
    if (now && !guided_) {
      context_.out.note("push the arm; Enter marks a point");
    }
    guided_ = now;
    if (!now || places_.size() >= kMostPlaces) {
      return kOk;
    }
    const auto place = read_place(store_, choice_.space);
    if (!place) {
      context_.out.error(place.error().text);
      return kFailed;
    }
    tool_ = place->tool;
    places_.push_back({place->stand.joints, pressed || line_typed()});
    marks_ += places_.back().marked ? 1 : 0;
    if (places_.back().marked) {
      context_.out.note(fmt::format("point {} is marked", marks_));
    }
    return kOk;
  }
  // Why the robot was not guided, as it says.
  [[nodiscard]] std::string reason() const {
    const auto text = operate::read(store_, items_[2]);
    const auto* const begin = text ? reinterpret_cast<const char*>(text->data()) : "";
    return {begin, text ? ::strnlen(begin, text->size()) : 0};
  }
  [[nodiscard]] const std::vector<robot::GuidedPlace>& places() const { return places_; }
  [[nodiscard]] const std::string& tool() const { return tool_; }

 private:
  Context& context_;
  const vars::Store& store_;
  const RobotChoice& choice_;
  std::vector<Item> items_;
  std::vector<robot::GuidedPlace> places_;
  std::string tool_;
  std::optional<std::uint32_t> last_mark_;
  bool guided_ = false;
  int marks_ = 0;
};

int write_taught(Context& context, const robot::FileNames& names, const robot::PathOrder& order, const GuideLog& log) {
  const robot::TaughtPath taught = robot::teach_path(names, order, log.places());
  if (!taught.errors.empty() || !taught.problem.empty()) {
    print_diagnostics(context, taught.errors, false);
    if (!taught.problem.empty()) {
      context.out.error(taught.problem);
    }
    return taught.errors.empty() ? kFailed : kCheckFailed;
  }
  context.out.note(fmt::format("{}: {:.0f} mm in {} points, within {:.2f} mm and {:.2f} deg of the path", taught.file,
                               taught.length, taught.points, taught.deviation, taught.turn_deviation));
  context.out.note(taught.is_read ? "the robot knows it after it has read its files again: indurop robot reload"
                                  : "name it in the property jobs of the robot module, then restart the node");
  return kOk;
}

}  // namespace

int guide(Context& context, const RobotChoice& choice, const GuideOrder& order) {
  const bool records = !order.path.job.empty();
  RobotFiles files;
  if (records) {
    auto found = files_of_node(context.node, choice, true);
    if (!found) {
      return report(context.out, found.error());
    }
    files = std::move(*found);
  }
  auto store = open_store(context, vars::Mode::ReadWrite, {choice.space + "::ROBOT_JOG"});
  if (!store) {
    return report(context.out, store.error());
  }
  GuideLog log(context, *store, choice);
  if (const int code = log.begin(); code != kOk) {
    return code;
  }
  constexpr int kByHand = 4;  // ROBOT_JOG.eFrame
  HeldJog held;
  held.verb = "robot guide";
  held.fields = fmt::format("eFrame: {}", kByHand);
  held.note = "release the arm until it can be guided; Ctrl-C ends";
  held.for_ns = order.for_ns;
  held.each = [&log] { return log.take(); };
  if (const int code = hold_jog(context, *store, choice, held); code != kOk) {
    return code;
  }
  if (log.places().empty()) {
    context.out.error(fmt::format("the robot was not guided: {}", log.reason()));
    return kFailed;
  }
  robot::PathOrder path = order.path;
  path.tool = log.tool();
  return records ? write_taught(context, files.names, path, log) : kOk;
}

}  // namespace indurop::tools
