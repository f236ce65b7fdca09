// SPDX-License-Identifier: Apache-2.0
#include "tools/client/robot/open_questions.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "tools/client/values/variables.h"

namespace indurop::tools {
namespace {

constexpr std::string_view kName = "ROBOT_QUESTION";

bool is_question(std::string_view name) {
  return name == kName || name.ends_with(std::string("::").append(kName));
}

}  // namespace

Result<RobotQuestion, base::Problem> read_question(const vars::Store& store, const operate::Item& item) {
  const auto bytes = operate::read(store, item);
  if (!bytes) {
    return bytes.error();
  }
  const JsonValue value = raw_value(item.place.type, *bytes);
  RobotQuestion question;
  question.space = item.name.substr(0, item.name.size() - std::min(item.name.size(), kName.size() + 2));
  question.number = value["nNumber"].natural().value_or(0);
  question.text = value["cText"].text().value_or("");
  const auto all = value["choice"].values();
  const std::size_t count = std::min<std::size_t>(all.size(), value["nChoices"].natural().value_or(0));
  for (const JsonValue& choice : all.first(count)) {
    question.choices.push_back(choice["text"].text().value_or(""));
  }
  question.lower = value["dLower"].number().value_or(0);
  question.upper = value["dUpper"].number().value_or(0);
  question.step = value["dStep"].number().value_or(0);
  question.left = value["dLeft"].number().value_or(0);
  question.acknowledged = value["nAcknowledge"].natural().value_or(0);
  question.reason = value["cReason"].text().value_or("");
  return question;
}

std::vector<RobotQuestion> open_questions(const vars::Store& store) {
  std::vector<RobotQuestion> open;
  for (const schema::Variable& variable : store.schema().variables) {
    if (!is_question(variable.name)) {
      continue;
    }
    const auto item = operate::whole(store, variable);
    auto question = item ? read_question(store, *item) : Result<RobotQuestion, base::Problem>(item.error());
    if (question && question->number != 0) {
      open.push_back(std::move(*question));
    }
  }
  return open;
}

std::string answers_text(const RobotQuestion& question) {
  std::string text;
  for (std::size_t i = 0; i < question.choices.size(); ++i) {
    text += fmt::format("{}{} {}", i > 0 ? ", " : "", i + 1, question.choices[i]);
  }
  if (!question.choices.empty()) {
    return text;
  }
  text = fmt::format("{} to {}", question.lower, question.upper);
  return question.step == 1 ? text : text + fmt::format(" in steps of {}", question.step);
}

}  // namespace indurop::tools
