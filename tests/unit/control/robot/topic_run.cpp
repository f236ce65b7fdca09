// SPDX-License-Identifier: Apache-2.0
#include "topic_run.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace indurop::robot {

const std::vector<Topic>& topics() {
  static const std::vector<Topic> kTopics{{"palletising", {}, 12, 0},
                                          {"tools", {}, -90, 1e-3},
                                          {"interrupts", {"eject"}, 250, 1e-3},
                                          {"glue", {}, 0, 0},
                                          {"bead", {}, 0, 0},
                                          {"spline", {}, -150, 1e-3},
                                          {"search", {}, 317, 0.3},
                                          {"seam", {}, 12, 0.01},
                                          {"polish", {}, 15, 1.5},
                                          {"timeouts", {}, 2, 0},
                                          {"subprograms", {"height"}, 180, 0},
                                          {"dialogue", {}, -200e3 + 22.5 + 12 * 10 + 1, 0.1},
                                          {"external_axis", {}, 1000, 1e-3, "rail"},
                                          {"machine_tending", {}, 211, 0},
                                          {"recovery", {}, 1072, 0}};
  return kTopics;
}

std::string topic_text(const std::string& name) {
  std::ifstream file(std::string(ROBOT_TOPICS) + "/" + name + ".job");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string topic_urdf(const Topic& topic) {
  return *topic.arm == '\0' ? cell_urdf() : urdf_of(topic.arm);
}

TopicRun::TopicRun(const Topic& topic) : topic_(topic.name) {
  JobTexts others;
  for (const std::string& other : topic.others) {
    others.emplace_back(other, topic_text(other));
  }
  Settings settings;
  settings.period = std::chrono::milliseconds(10);
  cell_.sut = controller_of(topic_urdf(topic), topic_text(topic.name), settings, others);
  cell_.in.service = {};
  cell_.step();
  for (std::size_t i = 0; i < cell_.sut->signals().size(); ++i) {
    values_[cell_.sut->signals()[i]] = &cell_.values[i];
  }
}

bool TopicRun::run(const std::function<bool()>& each) {
  if (!cell_.serve(Service::GroupEnable)) {
    return false;
  }
  cell_.in.service.job = 1;
  cell_.ask(Service::JobStart);
  for (period_ = 1; period_ <= 20'000; ++period_) {
    react();
    if (!each()) {
      return false;
    }
    if (cell_.out.done == cell_.in.service.number) {
      return true;
    }
    cell_.step();
  }
  return false;
}

void TopicRun::step() {
  ++period_;
  react();
  cell_.step();
}

double TopicRun::value(const std::string& name) const {
  const auto found = values_.find(name);
  return found == values_.end() ? 0.0 : *found->second;
}

void TopicRun::set(const char* name, double value) {
  if (const auto found = values_.find(name); found != values_.end()) {
    *found->second = value;
  }
}

// The operator of the dialogue, who thinks for half a second and leaves two questions unanswered.
void TopicRun::answer() {
  static const std::map<std::string, double> kAnswers{{"Is the door closed?", 1},
                                                      {"Which tray has the parts?", 2},
                                                      {"How many parts are in it?", 12},
                                                      {"How high are they, in mm?", 22.5}};
  const QuestionReport& question = cell_.out.job.question;
  if (question.number != question_) {
    question_ = question.number;
    asked_ = period_;
  }
  if (const auto known = kAnswers.find(question.text); known != kAnswers.end() && period_ == asked_ + 50) {
    cell_.in.answer = {question.acknowledged + 1, question.number, known->second};
  }
}

// What the cell around the robot does in each period.
void TopicRun::react() {
  if (topic_ == "interrupts") {
    set("I3", cell_.out.position[1] > 0 ? 1 : 0);
  } else if (topic_ == "search") {
    set("I4", cell_.out.position[2] < 317 ? 1 : 0);
  } else if (topic_ == "seam") {
    set("DY", std::min(12.0, 0.02 * period_));
    set("COUNT", period_);
  } else if (topic_ == "polish") {
    const double along = std::hypot(cell_.out.position[0] - 450, cell_.out.position[1] + 150);
    set("FORCE", std::max(0.0, 10 * (250 + 2 * std::sin(along / 30) - cell_.out.position[2])));
    set("COUNT", period_);
  } else if (topic_ == "timeouts") {
    set("I5", period_ > 45 ? 1 : 0);
  } else if (topic_ == "dialogue") {
    const bool is_loaded =
        std::string(cell_.out.job.message) == "load 4 parts, then press I6" && (question_ == 0 || value("I6") != 0);
    set("I6", is_loaded && period_ % 150 < 20 ? 1 : 0);
    answer();
  } else if (topic_ == "machine_tending") {
    door_ = std::clamp(door_ + (value("O1") != 0 ? 1 : -1), 0, 40);  // it takes 0.4 s
    set("I1", door_ == 40 || (door_ > 0 && value("I1") != 0) ? 1 : 0);
  }
}

}  // namespace indurop::robot
