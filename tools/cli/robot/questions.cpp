// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/robot/questions.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/rt/clock.h"
#include "tools/cli/values/forcing.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/robot/open_questions.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kPollNs = 20'000'000;

// Reads the robot's question. Returns the exit code, after an error message.
int fetch_question(Context& context, const vars::Store& store, const RobotChoice& choice, RobotQuestion& to) {
  std::vector<Item> items;
  if (const int code = select_items(context, store, {choice.space + "::ROBOT_QUESTION"}, items); code != kOk) {
    return code;
  }
  auto question = read_question(store, items.front());
  if (!question) {
    context.out.error(question.error().text);
    return kFailed;
  }
  to = std::move(*question);
  return kOk;
}

// Reads it until `done(question)`. Returns the exit code; kOk too if that does not come within `wait_ns`.
template <class Done>
int poll_question(Context& context, const vars::Store& store, const RobotChoice& choice, std::int64_t wait_ns,
                  RobotQuestion& to, const Done& done) {
  const std::int64_t end = rt::now_ns() + wait_ns;
  for (;;) {
    if (const int code = fetch_question(context, store, choice, to); code != kOk) {
      return code;
    }
    const std::int64_t now = rt::now_ns();
    if (done(to) || now >= end) {
      return kOk;
    }
    if (wait_until(std::min(now + kPollNs, end)) == Woken::Signal) {
      return interrupt_code();
    }
  }
}

std::optional<double> number_of(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

// A choice that reads like a number counts as its text.
std::optional<double> value_of(const RobotQuestion& question, const std::string& text) {
  const auto choice = std::find(question.choices.begin(), question.choices.end(), text);
  return choice == question.choices.end() ? number_of(text)
                                          : static_cast<double>(choice - question.choices.begin()) + 1;
}

// Another one than that of any client that answers at the same time: so each knows whether its own was received.
std::uint32_t new_number(std::uint64_t acknowledged) {
  std::random_device random;
  std::uint32_t number = 0;
  while (number == 0 || number == acknowledged) {
    number = random();
  }
  return number;
}

}  // namespace

int show_question(Context& context, const RobotChoice& choice, std::int64_t wait_ns) {
  const auto store = open_store(context, vars::Mode::ReadOnly, {choice.space + "::ROBOT_QUESTION"});
  if (!store) {
    return report(context.out, store.error());
  }
  RobotQuestion question;
  const auto is_open = [](const RobotQuestion& one) { return one.number != 0; };
  if (const int code = poll_question(context, *store, choice, wait_ns, question, is_open); code != kOk) {
    return code;
  }
  Table table(
      {{"NUMBER", "number", Align::Right}, {"QUESTION", "question"}, {"ANSWERS", "answers"}, {"LEFT", "left_s"}});
  if (is_open(question)) {
    const JsonValue answers =
        question.choices.empty()
            ? JsonValue({{"lower", question.lower}, {"upper", question.upper}, {"step", question.step}})
            : JsonValue(question.choices);
    table.add({Cell(fmt::format("{}", question.number), JsonValue(question.number)), Cell(question.text),
               Cell(answers_text(question), answers),
               question.left > 0 ? Cell(fmt::format("{:.1f} s", question.left), JsonValue(question.left))
                                 : Cell("-", JsonValue())});
  } else if (context.format == Format::Table) {
    context.out.note("no question is open");
  }
  print_table(context, table, {{"space", choice.space}}, "questions");
  return is_open(question) || wait_ns == 0 ? kOk : kFailed;
}

int answer_question(Context& context, const RobotChoice& choice, const RobotAnswer& answer) {
  auto store = open_store(context, vars::Mode::ReadWrite, {choice.space + "::ROBOT_ANSWER"});
  if (!store) {
    return report(context.out, store.error());
  }
  RobotQuestion question;
  if (const int code = fetch_question(context, *store, choice, question); code != kOk) {
    return code;
  }
  if (question.number == 0) {
    context.out.error("no question is open");
    return kFailed;
  }
  const auto value = value_of(question, answer.text);
  if (!value) {
    context.out.error(fmt::format("'{}' does not answer question {}, '{}': {}", answer.text, question.number,
                                  question.text, answers_text(question)));
    return kFailed;
  }
  const std::uint64_t before = question.acknowledged;
  const std::uint32_t number = new_number(before);
  const std::uint64_t asked = answer.question != 0 ? answer.question : question.number;
  const auto wanted = read_assignments(context, *store, "robot answer",
                                       {fmt::format("{}::ROBOT_ANSWER={{nRequest: {}, nQuestion: {}, dAnswer: {}}}",
                                                    choice.space, number, asked, *value)});
  if (!wanted || any_forced(context, *store, *wanted)) {
    return kFailed;
  }
  if (const int code = set_values(context, *store, *wanted); code != kOk) {
    return code;
  }
  constexpr std::int64_t kMaxWaitNs = 2'000'000'000;
  const auto is_received = [&](const RobotQuestion& one) { return one.acknowledged != before; };
  const std::string text = question.text;
  if (const int code = poll_question(context, *store, choice, kMaxWaitNs, question, is_received); code != kOk) {
    return code;
  }
  if (question.acknowledged != number || !question.reason.empty()) {
    context.out.error(question.acknowledged == number ? question.reason
                      : is_received(question)
                          ? "another client answers, too: which of the answers counts is not known"
                          : fmt::format("the robot does not receive the answer; does it run, or does "
                                        "another program write {}::ROBOT_ANSWER?",
                                        choice.space));
    return kFailed;
  }
  context.out.note(fmt::format("question {}, '{}', is answered: {}", asked, text, answer.text));
  return kOk;
}

}  // namespace indurop::tools
