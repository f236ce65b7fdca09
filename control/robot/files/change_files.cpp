// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/change_files.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "control/robot/files/read_files.h"
#include "core/base/read_file.h"
#include "core/base/replace_file.h"

namespace indurop::robot {

std::vector<base::Diagnostic> problems_with(const FileNames& names, const std::string& file, const std::string& text,
                                            const Arm& arm) {
  std::vector<JobFile> all;
  for (const std::string& path : names.jobs) {
    const auto read = base::read_file(path, kMostFileBytes);
    all.push_back({path, path == file ? text : read ? *read : std::string()});
  }
  return parse_jobs(all, shape_of(arm)).diagnostics;
}

std::string wrong_axes(const Arm& arm, const Stand& stand) {
  if (stand.joints.size() >= static_cast<std::size_t>(arm.count())) {
    return {};
  }
  return "the arm of the files has " + std::to_string(arm.count()) + " axes, the robot " +
         std::to_string(stand.joints.size());
}

std::string file_for(const std::string& named, const JobBook& book, const std::vector<std::string>& files) {
  if (!named.empty()) {
    const auto same = std::find_if(files.begin(), files.end(), [&](const std::string& one) {
      std::error_code error;
      return std::filesystem::equivalent(one, named, error);
    });
    return same == files.end() ? std::string() : *same;
  }
  const auto points_in = [&](const std::string& file) {
    return std::count_if(book.points.begin(), book.points.end(), [&](const Point& one) { return one.file == file; });
  };
  const auto most = std::max_element(files.begin(), files.end(), [&](const std::string& a, const std::string& b) {
    return points_in(a) < points_in(b);
  });
  return most == files.end() ? std::string() : *most;
}

std::string no_file(const std::string& named) {
  return named.empty() ? "the robot reads no files of jobs or points: name one in the property jobs"
                       : "the robot does not read " + named + ": name it in the property jobs";
}

FileChange change_file(const FileNames& names, const Arm& arm, const std::string& file,
                       const std::function<std::string(std::string_view)>& edit) {
  FileChange out;
  const auto text = base::read_file(file, kMostFileBytes);
  if (!text) {
    out.problem = file + ": " + text.error().text;
    return out;
  }
  const std::string changed = edit(*text);
  out.errors = problems_with(names, file, changed, arm);
  if (!out.errors.empty()) {
    return out;
  }
  if (const auto done = base::replace_file(file, changed, base::Durable::Yes); !done) {
    out.problem = file + ": " + done.error().text;
  }
  return out;
}

}  // namespace indurop::robot
