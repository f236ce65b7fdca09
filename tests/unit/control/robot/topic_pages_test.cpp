// SPDX-License-Identifier: Apache-2.0
// The pages of docs/robot show the jobs that are tested, and what the robot does in them. INDUROP_UPDATE_GOLDEN=1
// writes the pictures, and the jobs into the pages.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <ostream>

#include "tests/golden/golden.h"
#include "topic_picture.h"

namespace indurop::robot {

// The name of a test, instead of the bytes of its parameter.
void PrintTo(const PictureScript& script, std::ostream* out) {
  *out << script.topic;
}

namespace {

std::filesystem::path page(const std::string& name) {
  return std::filesystem::path(ROBOT_PAGES) / name;
}

// Where the code block is that begins with the comment "# NAME.job": after that line, and at its end.
std::pair<std::size_t, std::size_t> block_of(const std::string& text, const std::string& name) {
  const std::string head = "```\n# " + name + ".job\n";
  const std::size_t found = text.find(head);
  if (found == std::string::npos) {
    return {0, 0};
  }
  const std::size_t begin = found + head.size();
  return {begin, text.find("```\n", begin)};
}

class Topic_pages : public testing::TestWithParam<PictureScript> {};

TEST_P(Topic_pages, Show_what_the_robot_does) {
  const std::string picture = picture_of(GetParam());
  EXPECT_EQ(picture, picture_of(GetParam()));
  golden::expect_file(page(GetParam().topic + ".svg"), picture);
  EXPECT_THAT(golden::slurp(page(GetParam().page + ".md")), testing::HasSubstr("](" + GetParam().topic + ".svg)"));
}

TEST_P(Topic_pages, Have_the_jobs_that_are_tested) {
  const auto topic =
      std::find_if(topics().begin(), topics().end(), [](const Topic& known) { return known.name == GetParam().topic; });
  ASSERT_NE(topic, topics().end());
  std::vector<std::string> jobs = topic->others;
  jobs.insert(jobs.begin(), topic->name);
  const std::filesystem::path file = page(GetParam().page + ".md");
  std::string text = golden::slurp(file);
  for (const std::string& job : jobs) {
    const auto [begin, end] = block_of(text, job);
    ASSERT_GT(begin, 0U) << file << " has no block that begins with # " << job << ".job";
    ASSERT_NE(end, std::string::npos) << file;
    if (golden::updating()) {
      text.replace(begin, end - begin, topic_text(job));
    } else {
      EXPECT_EQ(text.substr(begin, end - begin), topic_text(job)) << file;
    }
  }
  if (golden::updating()) {
    golden::expect_file(file, text);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Topic_pages, testing::ValuesIn(picture_scripts()),
                         [](const auto& script) { return script.param.topic; });

TEST(Topics, Have_a_page_each) {
  std::vector<std::string> with_page;
  for (const PictureScript& script : picture_scripts()) {
    with_page.push_back(script.topic);
  }
  std::vector<std::string> tested;
  for (const Topic& topic : topics()) {
    tested.emplace_back(topic.name);
  }
  EXPECT_THAT(with_page, testing::UnorderedElementsAreArray(tested));
}

}  // namespace
}  // namespace indurop::robot
