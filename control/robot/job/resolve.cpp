// SPDX-License-Identifier: Apache-2.0
// Resolves names after all job files have been read: the point, job or label that a name refers to.

#include <algorithm>
#include <charconv>
#include <iterator>

#include "control/robot/job/near_name.h"
#include "control/robot/job/parser.h"

namespace indurop::robot {

namespace {

template <class List>
int index_of(const List& list, std::string_view name) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.name == name; });
  return found == list.end() ? -1 : static_cast<int>(found - list.begin());
}

std::string count_of(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

void JobParser::resolve() {
  resolve_frames();
  resolve_tools();
  resolve_bodies();
  const auto fail = [&](const JobReference& reference, const char* what, const std::vector<std::string>& known) {
    error_in(book_.jobs[reference.job].file, reference.line, reference.column,
             std::string("there is no ") + what + " '" + reference.name + "'" + meant(reference.name, known));
  };
  for (const JobReference& reference : references_) {
    Step& step = book_.jobs[reference.job].steps[reference.step];
    if (reference.to == JobReference::To::Label) {
      const auto& labels = labels_[reference.job];
      const auto found = labels.find(reference.name);
      std::vector<std::string> known;
      for (const auto& [name, label] : labels) {
        known.push_back(name);
      }
      found == labels.end() ? fail(reference, "label", known) : void(step.index = static_cast<int>(found->second.step));
    } else if (reference.to == JobReference::To::Tool) {
      step.index = tool_called(reference.name);
      step.index < 0 ? fail(reference, "tool", names_of(book_.tools)) : void();
    } else if (reference.to == JobReference::To::Job) {
      step.index = index_of(book_.jobs, reference.name);
      if (step.index < 0) {
        fail(reference, "job", names_of(book_.jobs));
        continue;
      }
      const Job& called = book_.jobs[static_cast<std::size_t>(step.index)];
      if (step.op == Op::Arm) {
        book_.interrupts[static_cast<std::size_t>(step.slot)].job = step.index;
      }
      if (step.op != Op::Disarm && called.parameters != static_cast<std::size_t>(step.mid)) {
        error_in(book_.jobs[reference.job].file, reference.line, reference.column,
                 "job '" + reference.name + "' takes " + count_of(called.parameters, "value") + ", here " +
                     (step.mid == 1 ? "is 1" : "are " + std::to_string(step.mid)));
      }
    } else {
      const int point = index_of(book_.points, reference.name);
      const bool back = point < 0 && reference.to == JobReference::To::Target && reference.name == "BACK";
      (reference.to == JobReference::To::Mid ? step.mid : step.index) = back ? kBack : point;
      point < 0 && !back ? fail(reference, "point", names_of(book_.points)) : void();
      if (point >= 0 && reference.to == JobReference::To::Target && step.formula >= 0 &&
          !book_.points[static_cast<std::size_t>(point)].target.is_pose) {
        error_in(book_.jobs[reference.job].file, reference.line, reference.column,
                 "an OFFSET goes from a point given as POSE; '" + reference.name +
                     "' has joint angles; say it as POSE (indurop robot teach " + reference.name + " --pose)");
      }
    }
  }
}

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
  constexpr unsigned kHighest = 9999;
  for (std::size_t i = 0; i < book.points.size(); ++i) {
    const std::string& name = book.points[i].name;
    unsigned number = 0;
    const auto [end, error] = std::from_chars(name.data() + 1, name.data() + name.size(), number);
    if (name[0] != 'P' || error != std::errc{} || end != name.data() + name.size() || number > kHighest) {
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
