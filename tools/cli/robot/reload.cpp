// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/robot/reload.h"

#include <fmt/format.h>
#include <indurop/robot/words.h>

#include <cstring>

#include "core/rt/clock.h"
#include "tools/cli/values/forcing.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/process/interrupt.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

// The robot's answer: the last acknowledged and completed command, and the result of the last service.
struct ReloadAnswer {
  std::uint32_t acknowledged = 0, done = 0, error = 0;
  std::string message;
};

class Robot {
 public:
  Robot(Context& context, vars::Store& store, const RobotChoice& choice)
      : context_(context), store_(store), space_(choice.space) {}

  // Returns the exit code.
  int read_answer(ReloadAnswer& to) {
    const std::string state = space_ + "::ROBOT_MODULE_STATE.";
    std::vector<Item> items;
    if (const int code = select_items(
            context_, store_,
            {state + "nAcknowledge", state + "nDone", state + "nError", space_ + "::ROBOT_JOB.cMessage"}, items);
        code != kOk) {
      return code;
    }
    std::uint32_t* const numbers[] = {&to.acknowledged, &to.done, &to.error};
    for (std::size_t i = 0; i < items.size(); ++i) {
      const auto bytes = operate::read(store_, items[i]);
      if (!bytes) {
        context_.out.error(bytes.error().text);
        return kFailed;
      }
      if (i < std::size(numbers)) {
        std::memcpy(numbers[i], bytes->data(), sizeof(std::uint32_t));
      } else {
        const auto* text = reinterpret_cast<const char*>(bytes->data());
        to.message.assign(text, ::strnlen(text, bytes->size()));
      }
    }
    return kOk;
  }

  int ask(std::uint32_t number) {
    const auto wanted = read_assignments(context_, store_, "robot reload",
                                         {fmt::format("{}::ROBOT_MODULE_SERVICE={{eOpCode: {}, nRequest: {}}}", space_,
                                                      static_cast<std::int32_t>(robot::Service::JobReload), number)});
    if (!wanted || any_forced(context_, store_, *wanted)) {
      return kFailed;
    }
    return set_values(context_, store_, *wanted);
  }

 private:
  Context& context_;
  vars::Store& store_;
  std::string space_;
};

}  // namespace

int reload_jobs(Context& context, const RobotChoice& choice) {
  auto store = open_store(context, vars::Mode::ReadWrite, {choice.space + "::ROBOT_MODULE_SERVICE"});
  if (!store) {
    return report(context.out, store.error());
  }
  Robot sut(context, *store, choice);
  ReloadAnswer answer;
  if (const int code = sut.read_answer(answer); code != kOk) {
    return code;
  }
  const std::uint32_t number = answer.acknowledged + 1;
  if (const int code = sut.ask(number); code != kOk) {
    return code;
  }
  constexpr std::int64_t kMaxReadNs = 30 * kSecond;
  constexpr std::int64_t kPollNs = kSecond / 50;
  const std::int64_t began = rt::now_ns();
  while (answer.done != number) {
    const std::int64_t now = rt::now_ns();
    const bool acknowledged = answer.acknowledged == number;
    if (now - began > (acknowledged ? kMaxReadNs : 2 * kSecond)) {
      context.out.error(acknowledged
                            ? "the robot has not read its jobs within 30 s"
                            : fmt::format("the robot does not take the request; does it run, or does another program "
                                          "write {}::ROBOT_MODULE_SERVICE?",
                                          choice.space));
      return kFailed;
    }
    if (wait_until(now + kPollNs) == Woken::Signal) {
      return interrupt_code();
    }
    if (const int code = sut.read_answer(answer); code != kOk) {
      return code;
    }
  }
  if (answer.error != 0) {
    const bool files = answer.error == static_cast<std::uint32_t>(robot::ErrorCode::Line) ||
                       answer.error == static_cast<std::uint32_t>(robot::ErrorCode::Tool);
    context.out.error(files ? answer.message
                            : "the robot reads jobs only at standstill and while no other request is pending");
    return files ? kCheckFailed : kFailed;
  }
  context.out.note("the robot has read its jobs again");
  return kOk;
}

}  // namespace indurop::tools
