// SPDX-License-Identifier: Apache-2.0
// Jobs that never end because they call themselves: of random call graphs the same ones are found as by the closure of
// the graph, and each of them fails when it is run.
#include "control/robot/files/check_calls.h"

#include <gmock/gmock.h>

#include <random>
#include <set>

#include "control/robot/job/runner.h"

namespace indurop::robot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Nothing final : public Signals, public MotionPort {
 public:
  double read(std::size_t /*index*/) noexcept override { return 0; }
  void write(std::size_t /*index*/, double /*value*/) noexcept override {}
  [[nodiscard]] bool ready() const noexcept override { return true; }
  [[nodiscard]] bool settled() const noexcept override { return true; }
  Fault move(const MoveCommand& /*command*/) noexcept override { return {}; }
};

std::vector<std::string> said(const std::vector<JobFile>& files) {
  const ReadJobs read = parse_jobs(files);
  EXPECT_THAT(read.diagnostics, IsEmpty());
  std::vector<std::string> texts;
  for (const base::Diagnostic& one : check_calls(read.book)) {
    texts.push_back(base::to_string(one));
  }
  return texts;
}

TEST(Check_calls, Those_without_condition_are_reported_with_their_line) {
  EXPECT_THAT(said({{"a.job", "WAIT 1s\nCALL a\n"}}),
              ElementsAre(HasSubstr("a.job:2:1: warning: job 'a' calls itself")));
  EXPECT_THAT(said({{"a.job", "CALL b\n"}, {"b.job", "LOOP 2\nCALL a\nEND\n"}}),
              ElementsAre(HasSubstr("a.job:1:1: warning: job 'a' comes back here"), HasSubstr("b.job:2:1: warning")));
  EXPECT_THAT(said({{"a.job", "IF I1 ON\nCALL a\nEND\n"}}), IsEmpty());
  EXPECT_THAT(said({{"a.job", "CALL b\nCALL b\n"}, {"b.job", "WAIT 1s\n"}}), IsEmpty());
}

TEST(Check_calls, Random_jobs_that_never_end_are_found) {
  constexpr int kJobs = 6;
  std::mt19937 random(8);
  int endless = 0;
  for (int run = 0; run < 300; ++run) {
    std::vector<JobFile> files;
    bool calls[kJobs][kJobs] = {};
    for (int i = 0; i < kJobs; ++i) {
      std::string text;
      for (int k = 0; k < kJobs; ++k) {
        const std::string call = "CALL j" + std::to_string(k) + "\n";
        if (random() % 6 == 0) {
          calls[i][k] = true;
          text += call;
        }
      }
      text += "IF I1 ON\nCALL j0\nEND\n";
      files.push_back({"j" + std::to_string(i) + ".job", text});
    }
    for (int via = 0; via < kJobs; ++via) {
      for (auto& called : calls) {
        for (int k = 0; k < kJobs; ++k) {
          called[k] = called[k] || (called[via] && calls[via][k]);
        }
      }
    }
    const ReadJobs read = parse_jobs(files);
    ASSERT_THAT(read.diagnostics, IsEmpty());
    std::set<std::string> found;
    for (const base::Diagnostic& one : check_calls(read.book)) {
      found.insert(one.file);
    }
    for (int i = 0; i < kJobs; ++i) {
      ASSERT_EQ(found.contains(files[static_cast<std::size_t>(i)].path), calls[i][i]) << "job " << i;
      if (calls[i][i]) {
        Nothing world;
        JobRunner runner(read.book);
        ASSERT_TRUE(runner.start(i));
        for (int k = 0; k < 1000 && runner.running(); ++k) {
          runner.step(0.01, world, world);
        }
        ASSERT_THAT(runner.report().message, HasSubstr("call each other too deep"));
        ++endless;
      }
    }
  }
  EXPECT_GT(endless, 100);
}

}  // namespace
}  // namespace indurop::robot
