// SPDX-License-Identifier: Apache-2.0
// Tasks that robot programmers have, written as jobs (topics/*.job): each of them is read without a finding,
// runs to its end with every set point within the limits, and gives what it has to give.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>

#include "group_cell.h"
#include "limit_judge.h"

namespace indurop::robot {
namespace {

std::string text_of(const std::string& name) {
  std::ifstream file(std::string(ROBOT_TOPICS) + "/" + name + ".job");
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_FALSE(text.str().empty()) << name;
  return text.str();
}

struct Topic {
  const char* name;
  std::vector<std::string> others;
  double wanted;  // in OUT
  double within;
  const char* arm = "";
};

// The operator of the dialogue, who leaves two questions unanswered.
void answer(Cell& cell) {
  static const std::map<std::string, double> kAnswers{{"Is the door closed?", 1},
                                                      {"Which tray has the parts?", 2},
                                                      {"How many parts are in it?", 12},
                                                      {"How high are they, in mm?", 22.5}};
  const QuestionReport& question = cell.out.job.question;
  if (const auto known = kAnswers.find(question.text); known != kAnswers.end()) {
    cell.in.answer = {question.acknowledged + 1, question.number, known->second};
  }
}

// What the cell around the robot does in each period; signals by name.
using Values = std::map<std::string, double*>;
void react(const std::string& topic, Cell& cell, const Values& values, int period) {
  const auto set = [&](const char* name, double value) {
    if (const auto found = values.find(name); found != values.end()) {
      *found->second = value;
    }
  };
  const auto get = [&](const char* name) {
    const auto found = values.find(name);
    return found == values.end() ? 0.0 : *found->second;
  };
  if (topic == "interrupts") {
    set("I3", cell.out.position[1] > 0 ? 1 : 0);
  } else if (topic == "search") {
    set("I4", cell.out.position[2] < 317 ? 1 : 0);
  } else if (topic == "seam") {
    set("DY", std::min(12.0, 0.02 * period));
    set("COUNT", period);
  } else if (topic == "timeouts") {
    set("I5", period > 60 ? 1 : 0);
  } else if (topic == "dialogue") {
    set("I6", std::string(cell.out.job.message) == "load 4 parts, then press I6" && period % 100 == 0 ? 1 : 0);
    answer(cell);
  } else if (topic == "machine_tending") {
    set("I1", get("O1"));
  }
}

class Job_topics : public testing::TestWithParam<Topic> {};

TEST_P(Job_topics, Run_to_their_end) {
  const Topic& topic = GetParam();
  JobTexts others;
  for (const std::string& other : topic.others) {
    others.emplace_back(other, text_of(other));
  }
  const std::string urdf = *topic.arm == '\0' ? cell_urdf() : urdf_of(topic.arm);
  Settings settings;
  settings.period = std::chrono::milliseconds(10);
  Cell cell;
  cell.sut = controller_of(urdf, text_of(topic.name), settings, others);
  cell.in.service = {};
  cell.step();
  Judge judge(0.01, urdf);
  Values values;
  for (std::size_t i = 0; i < cell.sut->signals().size(); ++i) {
    values[cell.sut->signals()[i]] = &cell.values[i];
  }
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  int period = 0;
  ASSERT_TRUE(cell.until(
      [&] {
        EXPECT_EQ(judge.look(cell, 1), "") << topic.name << " in line " << cell.out.job.line;
        react(topic.name, cell, values, ++period);
        return cell.out.done == cell.in.service.number || HasFailure();
      },
      20'000))
      << "it is in line " << cell.out.job.line;
  EXPECT_EQ(cell.out.error, ErrorCode::Ok) << cell.out.job.message;
  EXPECT_EQ(cell.out.job.state, JobState::Ended) << cell.out.job.message;
  EXPECT_NEAR(*values.at("OUT"), topic.wanted, topic.within);
}

INSTANTIATE_TEST_SUITE_P(Common, Job_topics,
                         testing::Values(Topic{"palletising", {}, 12, 0}, Topic{"tools", {}, -90, 1e-3},
                                         Topic{"interrupts", {"eject"}, 250, 1e-3}, Topic{"glue", {}, 0, 0},
                                         Topic{"spline", {}, -150, 1e-3}, Topic{"search", {}, 317, 0.3},
                                         Topic{"seam", {}, 12, 0.01}, Topic{"timeouts", {}, 2, 1},
                                         Topic{"subprograms", {"height"}, 180, 0},
                                         Topic{"dialogue", {}, -200e3 + 22.5 + 12 * 10 + 1, 0.1},
                                         Topic{"external_axis", {}, 1000, 1e-3, "rail"},
                                         Topic{"machine_tending", {}, 211, 0}, Topic{"recovery", {}, 1072, 0}),
                         [](const auto& topic) { return std::string(topic.param.name); });

}  // namespace
}  // namespace indurop::robot
