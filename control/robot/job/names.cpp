// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/names.h"

#include <algorithm>
#include <array>
#include <utility>

#include "control/robot/job/near_name.h"

namespace indurop::robot {

namespace {

constexpr const char* kFrame = "POSE 500 0 100 RPY 0 0 45";
constexpr const char* kTool = "POSE 0 0 120 RPY 0 0 0";

template <class List>
std::unordered_map<std::string_view, int> index(const List& list) {
  std::unordered_map<std::string_view, int> out;
  for (std::size_t i = 0; i < list.size(); ++i) {
    out.try_emplace(list[i].name, static_cast<int>(i));
  }
  return out;
}

int find(const std::unordered_map<std::string_view, int>& names, std::string_view name) {
  const auto found = names.find(name);
  return found == names.end() ? -1 : found->second;
}

std::string count_of(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

// A place that is no point; -1: there is none of this name.
int special_place(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, int>, 3> kSpecial{
      {{"BACK", kBack}, {"HERE", kHere}, {"FOUND", kFound}}};
  const auto* const found =
      std::find_if(kSpecial.begin(), kSpecial.end(), [&](const auto& each) { return same_word(each.first, name); });
  return found == kSpecial.end() ? -1 : found->second;
}

}  // namespace

bool JobNames::is_special(std::string_view point) noexcept {
  return special_place(point) != -1;
}

JobNames::Mention JobNames::mention(const JobToken& name) const {
  return {draft_.index(), std::string(name.text), line_.number(), name.column};
}

void JobNames::refer(To to, const char* what) {
  const JobToken name = line_.take();
  if (name.kind != JobToken::Kind::Word) {
    line_.error(name, std::string("expected the name of a ") + what + ", found " + JobLine::shown(name));
    return;
  }
  refer(to, name);
}

void JobNames::refer(To to, const JobToken& name) {
  references_.push_back({to, draft_.next() - 1, mention(name)});
}

void JobNames::declare(In in, std::size_t owner, const JobToken& name) {
  of(in).push_back({owner, mention(name)});
}

void JobNames::drop(In in, std::size_t count) {
  of(in).resize(of(in).size() - count);
}

void JobNames::drop_frame_of(std::size_t point) {
  if (!of(In::PointFrame).empty() && of(In::PointFrame).back().owner == point) {
    of(In::PointFrame).pop_back();
  }
}

void JobNames::label(const JobToken& name) {
  const auto [found, fresh] = labels_.back().try_emplace(std::string(name.text), Label{draft_.next(), line_.number()});
  if (!fresh) {
    line_.error(name,
                "there is already a label " + in_quotes(name.text) + " in line " + std::to_string(found->second.line));
  }
}

void JobNames::error(const Mention& at, const std::string& text) {
  line_.error_in(draft_.book().jobs[at.job].file, at.line, at.column, text);
}

template <class List>
std::vector<std::string> JobNames::suggested(const List& list) const {
  return line_.full() ? std::vector<std::string>{} : names_of(list);
}

void JobNames::no_such(const Mention& at, const char* what, const std::vector<std::string>& known) {
  error(at, std::string("there is no ") + what + " '" + at.name + "'" + meant(at.name, known));
}

void JobNames::resolve() {
  const JobBook& book = draft_.book();
  known_ = {index(book.points), index(book.frames), index(book.tools), index(book.jobs)};
  resolve_point_frames();
  resolve_frame_points();
  resolve_matched_points();
  resolve_tool_points();
  resolve_frame_tools();
  resolve_zones();
  resolve_bodies();
  resolve_places();
  for (const Reference& reference : references_) {
    resolve(reference);
  }
  keep_zones_in_place();
}

void JobNames::resolve_point_frames() {
  JobBook& book = draft_.book();
  for (const auto& [owner, at] : of(In::PointFrame)) {
    book.points[owner].frame = frame_called(at);
  }
}

void JobNames::resolve_frame_points() {
  JobBook& book = draft_.book();
  std::size_t i = 0;
  for (const auto& [owner, at] : of(In::FramePoint)) {
    const std::size_t corner = i++ % 3;
    const int point = base_point(at);
    if (point >= 0 && owner < book.frames.size()) {
      book.frames[owner].points[corner] = point;
    }
  }
}

void JobNames::resolve_matched_points() {
  JobBook& book = draft_.book();
  for (const auto& [owner, at] : of(In::FrameMatch)) {
    const int point = base_point(at);
    if (point >= 0 && owner < book.frames.size()) {
      book.frames[owner].matched.push_back(point);
    }
  }
}

// Returns a point that a frame can be found from; -1 with an error.
int JobNames::base_point(const Mention& at) {
  const JobBook& book = draft_.book();
  const int point = find(known_.points, at.name);
  if (point < 0) {
    no_such(at, "point", suggested(book.points));
  } else if (book.points[static_cast<std::size_t>(point)].frame >= 0) {
    error(at, "point '" + at.name + "' is given in a frame itself; a frame is taught by points of the base");
    return -1;
  }
  return point;
}

void JobNames::resolve_tool_points() {
  JobBook& book = draft_.book();
  for (const auto& [owner, at] : of(In::ToolPoint)) {
    const int point = find(known_.points, at.name);
    if (point < 0) {
      no_such(at, "point", suggested(book.points));
    } else if (book.points[static_cast<std::size_t>(point)].target.is_pose) {
      error(at, "point '" + at.name + "' is given as POSE; a tool is taught by points given as JOINT");
    } else if (owner < book.tools.size()) {
      book.tools[owner].points.push_back(point);
    }
  }
}

void JobNames::resolve_frame_tools() {
  JobBook& book = draft_.book();
  for (const auto& [owner, at] : of(In::FrameTool)) {
    const int tool = find(known_.tools, at.name);
    if (tool < 0) {
      error(at, robot::no_such("tool", at.name, suggested(book.tools), "TOOL", kTool));
    } else if (owner < book.frames.size()) {
      book.frames[owner].tool = tool;
    }
  }
}

void JobNames::resolve_zones() {
  JobBook& book = draft_.book();
  for (const auto& [owner, at] : of(In::ZoneFrame)) {
    const int frame = frame_called(at);
    if (frame >= 0 && owner < book.keepouts.size()) {
      book.keepouts[owner].frame = frame;
    }
  }
}

void JobNames::resolve_bodies() {
  JobBook& book = draft_.book();
  for (BodyLine& body : book.bodies) {
    body.tool = find(known_.tools, body.name);
    if (body.tool < 1) {
      line_.error_in(body.file, static_cast<std::size_t>(body.place.line), static_cast<std::size_t>(body.place.column),
                     robot::no_such("tool", body.name, suggested(book.tools), "TOOL", kTool));
    }
  }
}

void JobNames::resolve_places() {
  JobBook& book = draft_.book();
  for (const auto& [owner, at] : of(In::PlaceName)) {
    PlacePart& part = book.place_parts[owner];
    part.index = find(known_.frames, at.name);
    part.is_frame = part.index >= 0;
    part.index = part.is_frame ? part.index : find(known_.points, at.name);
    if (part.index < 0 && same_word(at.name, kWorld)) {
      part.op = PlaceOp::World;
    } else if (part.index < 0) {
      std::vector<std::string> known = suggested(book.points);
      const std::vector<std::string> frames = suggested(book.frames);
      known.insert(known.end(), frames.begin(), frames.end());
      no_such(at, "point or frame", known);
    }
  }
}

void JobNames::resolve(const Reference& reference) {
  Step& step = draft_.book().jobs[reference.at.job].steps[reference.step];
  switch (reference.to) {
    case To::Label:
      resolve_label(reference, step);
      break;
    case To::Tool:
      step.index = find(known_.tools, reference.at.name);
      if (step.index < 0) {
        no_such(reference.at, "tool", suggested(draft_.book().tools));
      }
      break;
    case To::Job:
      resolve_job(reference, step);
      break;
    case To::Frame:
      step.index = frame_called(reference.at);
      break;
    case To::Origin:
      step.mid = frame_called(reference.at);
      break;
    case To::Tracked:
      if (frame_called(reference.at) >= 0) {
        resolve_computed(reference, step);
      }
      break;
    case To::Computed:
      resolve_computed(reference, step);
      break;
    case To::Target:
    case To::Mid:
      resolve_point(reference, step);
  }
}

// Returns the index of a frame; -1 with an error.
int JobNames::frame_called(const Mention& at) {
  const int frame = find(known_.frames, at.name);
  if (frame < 0) {
    error(at, same_word(at.name, kWorld)
                  ? "places in the world are computed while the job runs: P = WORLD : POSE x, y, z RPY r, p, y"
                  : robot::no_such("frame", at.name, suggested(draft_.book().frames), "FRAME", kFrame));
  }
  return frame;
}

void JobNames::resolve_label(const Reference& reference, Step& step) {
  const auto& labels = labels_[reference.at.job];
  if (const auto found = labels.find(reference.at.name); found != labels.end()) {
    step.index = static_cast<int>(found->second.step);
    return;
  }
  std::vector<std::string> known;
  for (auto label = labels.begin(); label != labels.end() && !line_.full(); ++label) {
    known.push_back(label->first);
  }
  no_such(reference.at, "label", known);
}

void JobNames::resolve_job(const Reference& reference, Step& step) {
  JobBook& book = draft_.book();
  step.index = find(known_.jobs, reference.at.name);
  if (step.index < 0) {
    no_such(reference.at, "job", suggested(book.jobs));
    return;
  }
  const Job& called = book.jobs[static_cast<std::size_t>(step.index)];
  if (step.op == Op::Arm) {
    book.interrupts[static_cast<std::size_t>(step.slot)].job = step.index;
  }
  if (step.op == Op::Call && step.slot >= 0 && !called.returns_value) {
    error(reference.at, "job '" + reference.at.name + "' gives no value; end it with RETURN and the value");
  }
  if (step.op != Op::Disarm && called.parameters != static_cast<std::size_t>(step.mid)) {
    error(reference.at, "job '" + reference.at.name + "' takes " + count_of(called.parameters, "value") + ", here " +
                            (step.mid == 1 ? "is 1" : "are " + std::to_string(step.mid)));
  }
}

void JobNames::resolve_point(const Reference& reference, Step& step) {
  const JobBook& book = draft_.book();
  const bool target = reference.to == To::Target;
  const int point = find(known_.points, reference.at.name);
  const int special = point < 0 && target ? special_place(reference.at.name) : -1;
  int& place = target ? step.index : step.mid;
  place = special < -1 ? special : point;
  if (point < 0 && special == -1) {
    no_such(reference.at, "point", suggested(book.points));
  }
  if (point >= 0 && target && step.formula >= 0 && !book.points[static_cast<std::size_t>(point)].target.is_pose) {
    error(reference.at, "an OFFSET goes from a point given as POSE; '" + reference.at.name +
                            "' has joint angles; say it as POSE (indurop robot teach " + reference.at.name +
                            " --pose)");
  }
}

void JobNames::resolve_computed(const Reference& reference, Step& step) {
  JobBook& book = draft_.book();
  const std::string& name = reference.at.name;
  const int frame = find(known_.frames, name);
  const int point = frame >= 0 ? -1 : find(known_.points, name);
  if (frame < 0 && point < 0) {
    error(reference.at, "there is no point and no frame '" + name + "' to compute; declare it, POINT " + name +
                            " = POSE 500 0 300 RPY 180 0 0, or VAR " + name + " for a number");
    return;
  }
  if (point >= 0 && !book.points[static_cast<std::size_t>(point)].target.is_pose) {
    error(reference.at, "'" + name + "' has joint angles; declare it as POSE to compute it");
    return;
  }
  int& computed = frame >= 0 ? book.frames[static_cast<std::size_t>(frame)].computed
                             : book.points[static_cast<std::size_t>(point)].computed;
  if (computed < 0 && book.computed.size() >= kMaxComputed) {
    error(reference.at, "more than " + std::to_string(kMaxComputed) + " points and frames are computed");
    return;
  }
  if (computed < 0) {
    computed = static_cast<int>(book.computed.size());
    book.computed.push_back({frame >= 0, frame >= 0 ? frame : point});
  }
  step.index = computed;
}

// A zone is checked where the files say it is, so it cannot be in a frame that moves.
void JobNames::keep_zones_in_place() {
  const JobBook& book = draft_.book();
  for (const BodyLine& zone : book.keepouts) {
    if (zone.frame >= 0 && static_cast<std::size_t>(zone.frame) < book.frames.size() &&
        book.frames[static_cast<std::size_t>(zone.frame)].computed >= 0) {
      line_.error_in(zone.file, static_cast<std::size_t>(zone.place.line), static_cast<std::size_t>(zone.place.column),
                     "zone '" + zone.name + "' is in frame '" + book.frames[static_cast<std::size_t>(zone.frame)].name +
                         "', which jobs compute, and cannot move with it; give it in another frame");
    }
  }
}

}  // namespace indurop::robot
