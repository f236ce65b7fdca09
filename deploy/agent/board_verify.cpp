// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/board_verify.h"

#include "core/base/json.h"
#include "core/keys/digest.h"

namespace indurop::deploy {
namespace {

constexpr std::size_t kMaxAnswers = 16;
constexpr const char* kNotYet = R"({"done":false})";

}  // namespace

std::string BoardVerify::answer(const std::string& question) {
  if (const auto known = answers_.find(question); known != answers_.end()) {
    return known->second;
  }
  if (!check_) {
    question_ = question;
    check_.emplace(state_.folder());
  }
  return kNotYet;
}

std::optional<std::string> BoardVerify::step() {
  if (!check_ || !check_->step()) {
    return std::nullopt;
  }
  const StateReport report = check_->report();
  check_.reset();
  std::optional<std::string> problem;
  if (!report.damaged.empty()) {
    problem = mend(report);
  }
  if (answers_.size() >= kMaxAnswers) {
    answers_.clear();
  }
  answers_[question_] = text_of(report);
  return problem;
}

std::string BoardVerify::mend(const StateReport& report) {
  for (const Damage& damage : report.damaged) {
    if (damage.file == state_.folder() / kCommittedFile) {
      (void)state_.commit(Committed(state_.committed()));
    } else if (damage.file == state_.file(damage.expected)) {
      (void)state_.has_sound(damage.expected, damage.name);
    }
  }
  if (state_.committed().current.empty()) {
    return {};
  }
  const auto repaired = state_.repair(state_.committed().current);
  return repaired ? std::string{} : repaired.error().text;
}

std::string BoardVerify::text_of(const StateReport& report) const {
  base::Json whole = json_of(report);
  base::Json damaged = base::Json::array();
  for (std::size_t i = 0; i < report.damaged.size(); ++i) {
    const Damage& one = report.damaged[i];
    const auto now = keys::digest_of_file(one.file);
    base::Json entry = whole["damaged"].values()[i];
    entry["repaired"] = one.expected.empty() || (now && now->digest == one.expected);
    damaged.push_back(std::move(entry));
  }
  whole["damaged"] = std::move(damaged);
  whole["done"] = true;
  return whole.dump();
}

}  // namespace indurop::deploy
