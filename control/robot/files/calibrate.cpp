// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/calibrate.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <span>
#include <system_error>
#include <tuple>
#include <utility>

#include "control/robot/files/calibration_file.h"
#include "control/robot/files/change_files.h"
#include "control/robot/files/read_files.h"
#include "control/robot/job/near_name.h"
#include "control/robot/job/point_lines.h"
#include "control/robot/job/text.h"
#include "core/base/read_file.h"
#include "core/base/replace_file.h"

namespace indurop::robot {
namespace {

constexpr std::array<std::pair<CalibrationKind, std::string_view>, 4> kKinds{
    {{CalibrationKind::Tool, "tool"},
     {CalibrationKind::Frame, "frame"},
     {CalibrationKind::Camera, "camera"},
     {CalibrationKind::HandCamera, "hand-camera"}}};

bool is_tool(CalibrationKind kind) {
  return kind == CalibrationKind::Tool || kind == CalibrationKind::HandCamera;
}

// A calibration that is being worked on: the robot's files, and the points.
struct Work {
  const FileNames& names;
  const CalibrationOrder& order;
  ReadFiles read;
  std::string text;  // of the points
  CalibrationFile file;
  Calibrated fit;
  Calibration shown;

  [[nodiscard]] bool usable() const { return shown.errors.empty() && shown.problem.empty(); }
  [[nodiscard]] const Arm& arm() const { return read.model->arm; }
};

std::string points_file_of(const FileNames& names, const CalibrationOrder& order) {
  if (!order.points.empty()) {
    return order.points;
  }
  const std::filesystem::path near = names.jobs.empty() ? names.urdf : names.jobs.front();
  return (near.parent_path() / (order.name + "." + std::string(word_of(order.kind)) + ".points")).string();
}

// A name in a file name, too.
bool is_name(const std::string& name) {
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](char c) {
    return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  });
}

// `created`: a file of the user's choice need not exist.
void read_points(Work& work, bool created = false) {
  std::error_code none;
  if (std::filesystem::exists(work.shown.points_file, none)) {
    auto text = base::read_file(work.shown.points_file, kMostFileBytes);
    if (!text) {
      work.shown.problem = work.shown.points_file + ": " + text.error().text;
      return;
    }
    work.text = std::move(*text);
  } else if (!work.order.points.empty() && !created) {
    work.shown.problem = work.order.points + ": there is no such file";
  }
}

Work begin(const FileNames& names, const CalibrationOrder& order) {
  Work work{names, order, read_files(names), {}, {}, {}, {}};
  work.shown.errors = std::move(work.read.errors);
  work.shown.points_file = points_file_of(names, order);
  if (!is_name(order.name)) {
    work.shown.problem = "'" + order.name + "' is no name: letters, digits and _, 64 at most";
  } else if (work.shown.errors.empty() && !work.read.model) {
    work.shown.problem = "the arm cannot be read from " + names.urdf;
  }
  return work;
}

// What a statement says behind its pose: "MASS 1.2 kg CENTRE 0 0 60".
std::string mass_in(std::string_view statement) {
  for (const JobToken& token : split_job_line(statement)) {
    if (same_word(token.text, "MASS")) {
      return ' ' + std::string(statement.substr(token.column - 1));
    }
  }
  return {};
}

template <class T>
void find_declaration(Work& work, const T* before) {
  work.shown.file = before != nullptr ? before->file : file_for(work.order.file, work.read.book, work.names.jobs);
  work.shown.line = before != nullptr ? before->place.line : 0;
  if (before == nullptr) {
    return;
  }
  if (const auto text = base::read_file(work.shown.file, kMostFileBytes)) {
    work.shown.before = statement_in(*text, work.shown.line);
  }
}

void declare(Work& work) {
  const std::string& name = work.order.name;
  const Tool* const tool = named(work.read.book.tools, name);
  if (is_tool(work.order.kind)) {
    find_declaration(work, tool);
  } else {
    find_declaration(work, named(work.read.book.frames, name));
  }
  if (!work.shown.wrong.empty()) {
    return;
  }
  Pose result = work.fit.result;
  if (!work.fit.turned && tool != nullptr) {
    result.orientation = tool->tip.orientation;
  }
  work.shown.declaration =
      (is_tool(work.order.kind) ? "TOOL " : "FRAME ") + name + " = " + pose_text(result) + mass_in(work.shown.before);
}

Calibrated fit(CalibrationKind kind, std::span<const Measured> points) {
  switch (kind) {
    case CalibrationKind::Tool:
      return calibrate_tool(points);
    case CalibrationKind::Frame:
      return calibrate_frame(points);
    case CalibrationKind::Camera:
      return calibrate_camera(points);
    case CalibrationKind::HandCamera:
      break;
  }
  return calibrate_hand_camera(points);
}

void copy_figures(const Calibrated& fit, Calibration& to) {
  to.rms = 1000 * fit.rms;
  to.most = 1000 * fit.most;
  to.sigma = 1000 * fit.sigma;
  to.worst = fit.off.empty() ? 0 : fit.worst + 1;
  to.spare = fit.spare;
  to.turned = fit.turned;
  to.scale = fit.scale;
  const Vec3 place = 1000 * fit.place_deviation();
  const Vec3 turn = fit.turn_deviation();
  for (std::size_t i = 0; i < 3; ++i) {
    to.place_deviation[i] = place[static_cast<Eigen::Index>(i)];
    to.turn_deviation[i] = degrees(turn[static_cast<Eigen::Index>(i)]);
  }
}

void parse(Work& work) {
  work.file = parse_calibration(work.shown.points_file, work.text, work.order.kind, work.arm(), work.read.book);
  work.shown.errors = work.file.errors;
}

// Everything that follows from the text of the points.
void compute(Work& work) {
  parse(work);
  if (!work.usable()) {
    return;
  }
  std::vector<Measured> measured;
  for (const MarkedPoint& one : work.file.points) {
    measured.push_back(one.measured);
  }
  work.fit = fit(work.order.kind, measured);
  work.shown.wrong = work.fit.wrong;
  std::tie(work.shown.next_mark, work.shown.next) = next_point(work.order.kind, work.file.points);
  copy_figures(work.fit, work.shown);
  for (std::size_t i = 0; i < work.file.points.size(); ++i) {
    const MarkedPoint& one = work.file.points[i];
    const bool has = i < work.fit.off.size();
    work.shown.points.push_back(
        {std::string(one.mark.word), one.place, one.seen, has ? std::optional(1000 * work.fit.off[i]) : std::nullopt});
  }
  declare(work);
}

void write_points(Work& work) {
  if (const auto done = base::replace_file(work.shown.points_file, work.text, base::Durable::Yes); !done) {
    work.shown.problem = work.shown.points_file + ": " + done.error().text;
  }
}

// Returns the mark to write; empty, with a problem, if there is no such mark.
std::string mark_for(Work& work, const std::string& asked) {
  const std::vector<MarkWord> marks = marks_of(work.order.kind);
  if (asked.empty()) {
    const std::string next = next_point(work.order.kind, work.file.points).first;
    return next.empty() ? std::string(marks.front().word) : next;
  }
  std::string known;
  for (const MarkWord& one : marks) {
    if (same_word(one.word, asked)) {
      return std::string(one.word);
    }
    known += (known.empty() ? "" : ", ") + std::string(one.word);
  }
  work.shown.problem =
      "a calibration of a " + std::string(word_of(work.order.kind)) + " has no points '" + asked + "', but " + known;
  return {};
}

// What a camera saw, as 3 or 6 numbers; sets a problem if there are others.
std::vector<double> seen_of(Work& work, std::vector<double> seen) {
  const bool hand = work.order.kind == CalibrationKind::HandCamera;
  const bool camera = hand || work.order.kind == CalibrationKind::Camera;
  if (camera && !hand && seen.size() == 2) {
    seen.push_back(0);
  }
  const bool right = camera ? seen.size() == 6 || (!hand && seen.size() == 3) : seen.empty();
  const bool finite = std::all_of(seen.begin(), seen.end(), [](double one) { return std::abs(one) < 1e9; });
  if (!right || !finite) {
    work.shown.problem = hand     ? "state where the camera saw the mark: x y z roll pitch yaw, in mm and degrees"
                         : camera ? "state where the camera saw the mark: x y or x y z, in mm"
                                  : "only cameras see points";
  }
  return seen;
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  std::array<char, 32> text{};
  if (::gmtime_r(&now, &utc) == nullptr || std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M UTC", &utc) == 0) {
    return "now";
  }
  return text.data();
}

void write_declaration(Work& work) {
  FileChange change = change_file(work.names, work.arm(), work.shown.file, [&](std::string_view text) {
    std::string before;
    if (work.shown.line > 0) {
      before = "# until " + today() + ": " + work.shown.before + "\n";
    }
    WithPoint changed = put_statement(text, work.shown.line, before + work.shown.declaration);
    work.shown.line = changed.line + (before.empty() ? 0 : 1);
    return std::move(changed.text);
  });
  work.shown.errors = std::move(change.errors);
  work.shown.problem = std::move(change.problem);
}

}  // namespace

std::optional<CalibrationKind> calibration_kind(std::string_view word) {
  const auto* const found =
      std::find_if(kKinds.begin(), kKinds.end(), [word](const auto& one) { return one.second == word; });
  return found == kKinds.end() ? std::nullopt : std::optional(found->first);
}

std::string_view word_of(CalibrationKind kind) {
  return kKinds[static_cast<std::size_t>(kind)].second;
}

Calibration show_calibration(const FileNames& names, const CalibrationOrder& order) {
  Work work = begin(names, order);
  if (work.usable()) {
    read_points(work);
  }
  if (work.usable()) {
    compute(work);
  }
  return std::move(work.shown);
}

Calibration take_point(const FileNames& names, const CalibrationOrder& order, const TakenPoint& taken,
                       const Stand& stand) {
  Work work = begin(names, order);
  if (work.usable()) {
    read_points(work, true);
  }
  if (work.usable()) {
    parse(work);
    work.shown.problem = wrong_axes(work.arm(), stand);
  }
  if (!work.usable()) {
    return std::move(work.shown);
  }
  const std::vector<double> seen = seen_of(work, taken.seen);
  const std::string mark = work.usable() ? mark_for(work, taken.mark) : std::string();
  if (work.usable()) {
    work.text += work.text.empty() || work.text.back() == '\n' ? "" : "\n";
    work.text += calibration_line(work.arm(), mark, seen, joints_of_values(work.arm(), stand.joints),
                                  is_tool(order.kind) ? std::string() : taken.tool) +
                 '\n';
    compute(work);
  }
  if (work.usable()) {
    write_points(work);
  }
  return std::move(work.shown);
}

Calibration drop_point(const FileNames& names, const CalibrationOrder& order, std::size_t point) {
  Work work = begin(names, order);
  if (work.usable()) {
    read_points(work);
  }
  if (work.usable()) {
    parse(work);
  }
  if (const std::size_t count = work.file.points.size(); work.usable() && point > count) {
    work.shown.problem = "there is no point " + std::to_string(point) + ", but " + std::to_string(count);
  }
  if (work.usable()) {
    const int line = point == 0 ? 0 : work.file.points[point - 1].line;
    work.text = point == 0 ? std::string() : without_line(work.text, line);
    compute(work);
  }
  if (work.usable()) {
    write_points(work);
  }
  return std::move(work.shown);
}

Calibration accept_calibration(const FileNames& names, const CalibrationOrder& order) {
  Work work = begin(names, order);
  if (work.usable()) {
    read_points(work);
  }
  if (work.usable()) {
    compute(work);
  }
  if (work.usable() && !work.shown.wrong.empty()) {
    work.shown.problem = work.shown.wrong;
  } else if (work.usable() && work.shown.file.empty()) {
    work.shown.problem = no_file(order.file);
  }
  if (work.usable()) {
    write_declaration(work);
  }
  if (work.usable() && order.points.empty()) {
    std::error_code error;
    std::filesystem::rename(work.shown.points_file, work.shown.points_file + ".accepted", error);
  }
  return std::move(work.shown);
}

}  // namespace indurop::robot
