// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/planner.h"

#include "control/robot/plan/path_geometry.h"

namespace indurop::robot {

Planner::Planner(const Places& places, const JointLimits& joints, const ToolLimits& tool)
    : places_(places),
      all_(joints),
      joints_(joints),
      tool_(tool),
      draft_{{}, joints, tool, {}},
      elbow_(places, draft_),
      survey_(places, draft_),
      wave_(places, draft_, survey_),
      clearance_(places, joints_, draft_, survey_),
      search_(places, clearance_.bodies()),
      timing_(places, draft_, survey_.findings()),
      effort_(places, joints_),
      blending_(places, joints_, tool_, clearance_) {}

void Planner::spare(double part) noexcept {
  joints_ = gentler(all_, 1 - part);
  joints_.velocity *= 1 - part;
}

void Planner::begin(const Joints& from, double acceleration) noexcept {
  draft_.segment = {};
  draft_.wave = {};
  draft_.elbow_given = false;
  draft_.exact = false;
  elbow_.reset();
  draft_.segment.acceleration = acceleration;
  draft_.segment.from = from;
  draft_.segment.start = places_.arm().forward(from);
  draft_.joints = gentler(joints_, acceleration);
  draft_.tool = gentler(tool_, acceleration);
  draft_.work.begin(places_.inverse().closed_form());
  stage_ = Stage::Done;
}

Fault Planner::begin(const MoveCommand& command, const Joints& from) noexcept {
  begin(from, command.acceleration);
  if (const Fault fault = make_path(places_, command, draft_); !fault.ok()) {
    return fault;
  }
  if (command.move == Move::Joint) {
    const Fault fault = check_workspace();
    return fault.ok() ? begin_clearance() : fault;
  }
  draft_.exact = command.exact;
  draft_.end = command.target.joints;
  if (draft_.segment.length > 0) {
    draft_.wave = draft_.segment.way > 0 ? command.wave : Wave{};
    begin_elbow();
  } else if (draft_.misses_end()) {
    return {ErrorCode::Unreachable};
  }
  return {};
}

Fault Planner::begin(const ToolPath& chain, const Joints& from, double acceleration, const Wave& wave) noexcept {
  begin(from, acceleration);
  if (const Fault fault = make_path(chain, draft_); !fault.ok()) {
    return fault;
  }
  draft_.wave = draft_.segment.way > 0 ? wave : Wave{};
  begin_elbow();
  return {};
}

Fault Planner::begin(const MoveCommand& command, JointPath& path, const Joints& from) noexcept {
  begin(from, command.acceleration);
  draft_.work.begin(true);  // its places are known without inverse kinematics
  Solutions goals;
  Fault fault = find_goals(places_, command, draft_, goals);
  if (fault.ok()) {
    fault = search_.begin(from, goals, joints_.velocity, command.seed, path);
  }
  if (fault.ok()) {
    free_ = {command, &path};
    stage_ = Stage::Search;
  }
  return fault;
}

Fault Planner::search(int& places) noexcept {
  const Fault fault = search_.work(places);
  if (!fault.ok() || !search_.done()) {
    return fault;
  }
  make_path(places_, free_.command, *free_.path, draft_);
  stage_ = Stage::Done;
  if (draft_.segment.length > 0) {
    begin_elbow();
  }
  return {};
}

// A joint motion in the workspace: axes that arrive together follow another path at another pace, so several paces are
// checked.
Fault Planner::check_workspace() const noexcept {
  constexpr int kPlaces = 64;
  if (!places_.box().known()) {
    return {};
  }
  for (const double pace : {1.0, 0.7, 0.4, 0.1}) {
    Segment way = draft_.segment;
    if (way.together) {
      way.take_joint_timing({way.from, Joints::Zero(), Joints::Zero()}, joints_, pace);
    }
    if (!places_.inside(way, kPlaces)) {
      return {ErrorCode::Workspace};
    }
  }
  return {};
}

void Planner::begin_elbow() noexcept {
  elbow_.begin();
  stage_ = Stage::Elbow;
  if (elbow_.done()) {
    begin_survey();
  }
}

void Planner::begin_survey() noexcept {
  survey_.begin();
  stage_ = Stage::Survey;
}

Fault Planner::begin_wave() noexcept {
  stage_ = Stage::Wave;
  wave_.begin();
  return wave_.done() ? begin_clearance() : Fault{};
}

Fault Planner::begin_clearance() noexcept {
  stage_ = Stage::Clearance;
  clearance_.begin();
  return clearance_.done() ? end_clearance() : Fault{};
}

Fault Planner::end_clearance() noexcept {
  if (draft_.segment.move != Move::Joint) {
    return begin_timing();
  }
  begin_effort();
  return {};
}

// What the arm cannot hold is rejected before it is rehearsed, which may take long.
Fault Planner::begin_timing() noexcept {
  if (places_.dynamics() != nullptr) {
    draft_.work.add(survey_.count());
    int place = 0;
    const Fault fault = check_holding(*places_.dynamics(), survey_.samples(), survey_.count(), place);
    if (!fault.ok()) {
      draft_.blame(draft_.segment.length / survey_.count() * place);
      return fault;
    }
  }
  survey_.findings().leave_for_changes();
  stage_ = Stage::Timing;
  timing_.begin(survey_.wanted());
  return timing_.done() ? end_timing() : Fault{};
}

Fault Planner::end_timing() noexcept {
  if (const Fault fault = timing_.fault(); !fault.ok()) {
    return fault;
  }
  begin_effort();
  return {};
}

void Planner::begin_effort() noexcept {
  effort_.begin(draft_.segment);
  stage_ = effort_.done() ? Stage::Done : Stage::Effort;
}

Fault Planner::step(int& places) noexcept {
  Fault fault;
  switch (stage_) {
    case Stage::Search:
      return search(places);
    case Stage::Elbow:
      elbow_.check(places);
      if (elbow_.done()) {
        begin_survey();
      }
      return fault;
    case Stage::Survey:
      fault = survey_.check(places);
      return fault.ok() && survey_.done() ? begin_wave() : fault;
    case Stage::Wave:
      fault = wave_.check(places);
      return fault.ok() && wave_.done() ? begin_clearance() : fault;
    case Stage::Clearance:
      fault = clearance_.check(places);
      return fault.ok() && clearance_.done() ? end_clearance() : fault;
    case Stage::Timing:
      timing_.work(places);
      return timing_.done() ? end_timing() : fault;
    case Stage::Effort:
      --places;
      draft_.work.add(1);
      if (draft_.segment.move != Move::Joint) {
        draft_.work.add_on_path(1);
      }
      fault = effort_.look(draft_.segment, draft_.work.may_refuse());
      stage_ = effort_.done() ? Stage::Done : stage_;
      return fault;
    case Stage::Done:
      break;
  }
  return fault;
}

Fault Planner::check(int places) noexcept {
  while (places > 0 && stage_ != Stage::Done) {
    const Fault fault = step(places);
    if (!fault.ok() && elbow_.give_up()) {
      begin_survey();
    } else if (!fault.ok()) {
      stage_ = Stage::Done;
      return fault;
    }
  }
  return {};
}

}  // namespace indurop::robot
