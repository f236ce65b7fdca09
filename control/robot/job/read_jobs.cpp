// SPDX-License-Identifier: Apache-2.0
// Reads all files of a program as one book of jobs.

#include <algorithm>
#include <charconv>
#include <iterator>

#include "control/robot/job/parser.h"

namespace indurop::robot {

ReadJobs parse_jobs(const std::vector<JobFile>& files, const ArmShape& shape) {
  ReadJobs read;
  JobBook& book = read.book;
  book.tools.push_back({"FLANGE", "", {}, {}, {}, false, {}});
  book.loads.emplace_back();
  constexpr std::size_t kMostErrors = 100;
  base::Diagnostics errors("", read.diagnostics, kMostErrors);
  JobParser parser(book, errors, shape);
  for (const JobFile& file : files) {
    parser.read(file);
  }
  parser.resolve();
  constexpr unsigned kHighestNumber = 9999;
  for (std::size_t i = 0; i < book.points.size(); ++i) {
    const std::string& name = book.points[i].name;
    unsigned number = 0;
    const auto [end, error] = std::from_chars(name.data() + 1, name.data() + name.size(), number);
    if (name[0] != 'P' || error != std::errc{} || end != name.data() + name.size() || number > kHighestNumber) {
      continue;
    }
    if (book.numbered.size() <= number) {
      book.numbered.resize(number + 1, -1);
    }
    book.numbered[number] = static_cast<int>(i);
  }
  return read;
}

Target JobBook::target(int point, int tool) const noexcept {
  const Point& from = points[static_cast<std::size_t>(point)];
  Target target = from.target;
  target.known = from.known.empty() ? nullptr : from.known[static_cast<std::size_t>(tool)];
  return target;
}

std::vector<Pose> JobBook::tips() const {
  std::vector<Pose> all;
  std::transform(tools.begin(), tools.end(), std::back_inserter(all), [](const Tool& tool) { return tool.tip; });
  return all;
}

int JobBook::numbered_point(std::uint32_t number) const noexcept {
  return number < numbered.size() ? numbered[number] : -1;
}

}  // namespace indurop::robot
