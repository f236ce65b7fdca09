// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/robot/guiding.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "tools/cli/robot/hand.h"
#include "tools/cli/values/forcing.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/robot/guided_record.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

// Returns whether a line was typed at the terminal since the last call.
bool line_typed() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (::isatty(STDIN_FILENO) == 0 || ::poll(&input, 1, 0) <= 0 || (input.revents & POLLIN) == 0) {
    return false;
  }
  std::array<char, 256> text{};
  return ::read(STDIN_FILENO, text.data(), text.size()) > 0;
}

// Records while a hand guides the robot, and reports what happens.
class GuideLog {
 public:
  GuideLog(Context& context, const vars::Store& store, GuidedRecord record)
      : context_(context), store_(store), record_(std::move(record)) {}

  // Finds the variable with the robot's messages. Returns the exit code.
  int begin(const std::string& space) {
    const int code = select_items(context_, store_, {space + "::ROBOT_JOB.cMessage"}, items_);
    first_ = last_ = code == kOk ? reason() : "";
    return code;
  }
  // Takes the present place. Returns the exit code.
  int take() {
    const auto news = record_.take(store_, line_typed());
    if (!news) {
      context_.out.error(news.error().text);
      return kFailed;
    }
    if (news->began) {
      context_.out.note("push the arm; Enter marks a point");
    }
    if (news->marked) {
      context_.out.note(fmt::format("point {} is marked", record_.marks()));
    }
    if (news->filled) {
      context_.out.note("nothing more is recorded: the path is as long as it may be");
    }
    // Why it does not begin, as soon as the robot says so.
    if (std::string now = record_.guided() ? last_ : reason(); now != last_) {
      last_ = std::move(now);
      if (!last_.empty()) {
        context_.out.note(last_);
      }
    }
    return kOk;
  }
  // Returns why the robot was not guided, as it says; empty: it said nothing since the begin.
  [[nodiscard]] std::string new_reason() const { return reason() == first_ ? "" : reason(); }
  [[nodiscard]] const GuidedRecord& record() const { return record_; }

 private:
  [[nodiscard]] std::string reason() const {
    const auto text = operate::read(store_, items_[0]);
    const auto* const begin = text ? reinterpret_cast<const char*>(text->data()) : "";
    return {begin, text ? ::strnlen(begin, text->size()) : 0};
  }

  Context& context_;
  const vars::Store& store_;
  GuidedRecord record_;
  std::vector<Item> items_;
  std::string first_, last_;
};

int write_taught(Context& context, const robot::FileNames& names, const robot::PathOrder& order,
                 const GuidedRecord& record) {
  const robot::TaughtPath taught = robot::teach_path(names, order, record.places());
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
  auto record = GuidedRecord::open(*store, choice.space);
  const auto refused = record ? why_not_guided(*store, choice.space) : record.error().text;
  if (refused) {
    context.out.error(*refused);
    return kFailed;
  }
  GuideLog log(context, *store, std::move(record).value());
  if (const int code = log.begin(choice.space); code != kOk) {
    return code;
  }
  HeldJog held;
  held.verb = "robot guide";
  held.fields = fmt::format("eFrame: {}", GuidedRecord::kByHand);
  held.note = "release the arm until it can be guided; Ctrl-C ends";
  held.for_ns = order.for_ns;
  held.each = [&log] { return log.take(); };
  if (const int code = hold_jog(context, *store, choice, held); code != kOk) {
    return code;
  }
  if (log.record().places().empty()) {
    const std::string reason = log.new_reason();
    context.out.error(reason.empty() ? "the robot was not guided" : "the robot was not guided: " + reason);
    return kFailed;
  }
  robot::PathOrder path = order.path;
  path.tool = log.record().tool();
  return records ? write_taught(context, files.names, path, log.record()) : kOk;
}

}  // namespace indurop::tools
