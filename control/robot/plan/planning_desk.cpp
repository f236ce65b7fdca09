// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/planning_desk.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "control/robot/plan/ordinary_thread.h"

namespace indurop::robot {

namespace {

constexpr std::chrono::milliseconds kSoon{1}, kLater{10};
constexpr std::size_t kStack = std::size_t{256} * 1024;
constexpr double kPerSecond = 1;     // additional planning time per second of a path, as part of the time for all of it
constexpr double kMostSeconds = 60;  // s

}  // namespace

PlanningDesk::PlanningDesk(const Places& places, const JointLimits& joints, const ToolLimits& tool,
                           const Settings& settings, const CellGrid* grid)
    : places_(places),
      tool_(tool),
      period_(std::chrono::duration<double>(settings.period).count()),
      due_(settings.plan_time / period_),
      in_tick_(settings.plan_in_tick),
      learned_(settings.learned),
      guarded_(settings.guarded),
      planning_(places, joints, tool, grid) {
  in_tick_ = in_tick_ || !begin_ordinary_thread(thread_, "robot-plan", kStack, enter, this);  // else the tick plans
}

PlanningDesk::~PlanningDesk() {
  if (!in_tick_) {
    ending_.store(true, std::memory_order_relaxed);
    dropped_.store(true, std::memory_order_relaxed);
    ::pthread_join(thread_, nullptr);
  }
}

void* PlanningDesk::enter(void* desk) noexcept {
  static_cast<PlanningDesk*>(desk)->run();
  return nullptr;
}

// After a crash it continues, to report the crash for each request.
void PlanningDesk::run() noexcept {
  const auto loop = [](void* desk) noexcept { static_cast<PlanningDesk*>(desk)->look_for_work(); };
  if (guarded_ == nullptr) {
    look_for_work();
    return;
  }
  while (!guarded_(loop, this, crash_, sizeof crash_)) {
    crashed_ = true;
    if (state_.load(std::memory_order_relaxed) == State::Working) {
      work();
      state_.store(State::Made, std::memory_order_release);
    }
  }
}

// The thread polls: waking it would be a system call of the tick.
void PlanningDesk::look_for_work() noexcept {
  while (!ending_.load(std::memory_order_relaxed)) {
    State asked = State::Asked;
    if (state_.compare_exchange_strong(asked, State::Working, std::memory_order_acq_rel)) {
      work();
      state_.store(State::Made, std::memory_order_release);
    } else {
      std::this_thread::sleep_for(soon_.load(std::memory_order_relaxed) ? kSoon : kLater);
    }
  }
}

void PlanningDesk::work() noexcept {
  if (crashed_) {
    plan_ = {};
    plan_.fault = {ErrorCode::Planner};
    return;
  }
  planning_.plan(request_, dropped_, plan_);
}

// The approximate minimum duration of the motion: lines and circles are checked in time steps, so it determines the
// work.
double PlanningDesk::seconds_of(const PlanRequest& request) const noexcept {
  const MoveCommand& command = request.command;
  if (request.chain != nullptr) {
    return std::min(request.chain->at_speed(), kMostSeconds);
  }
  if (is_of_joints(command.move) || !(command.speed > 0)) {
    return 0;
  }
  const Arm& arm = places_.arm();
  const Pose start = arm.forward(request.from);
  const auto pose_of = [&](const Target& target) { return target.is_pose ? target.pose : arm.forward(target.joints); };
  const Pose end = pose_of(command.target);
  double way = (end.position - start.position).norm();
  if (command.move == Move::Circle) {
    const Vec3 mid = pose_of(command.mid).position;
    way = kPi / 2 * ((mid - start.position).norm() + (end.position - mid).norm());
  }
  const double turn = rotation_between(start.orientation, end.orientation).norm();
  const double speed = command.tool_speed > 0 ? command.tool_speed : command.speed * tool_.velocity;
  const double seconds = std::max(way / speed, turn / (command.speed * tool_.turn_velocity));
  return seconds < kMostSeconds ? seconds : kMostSeconds;  // also if it is not a number
}

void PlanningDesk::ask(const PlanRequest& request) noexcept {
  asked_ = waits_ = true;
  waiting_ = request;
  periods_left_ = static_cast<int>(std::ceil(due_ * (1 + kPerSecond * seconds_of(request)) - 1e-6));
  patience_ = request.command.within > 0 ? std::ceil(request.command.within / period_ - 1e-6) : HUGE_VAL;
  post();
}

void PlanningDesk::post() noexcept {
  const State state = state_.load(std::memory_order_acquire);
  if (!waits_ || (state != State::Free && state != State::Made)) {
    return;
  }
  waits_ = false;
  request_ = waiting_;
  dropped_.store(false, std::memory_order_relaxed);
  if (in_tick_) {
    work();
    state_.store(State::Made, std::memory_order_relaxed);
  } else {
    state_.store(State::Asked, std::memory_order_release);
  }
}

void PlanningDesk::forget() noexcept {
  forgot_ = forgot_ || asked_;
  asked_ = waits_ = false;
  dropped_.store(true, std::memory_order_relaxed);
  State asked = State::Asked;
  state_.compare_exchange_strong(asked, State::Free, std::memory_order_acq_rel);
}

const Plan* PlanningDesk::take() noexcept {
  if (!asked_) {
    return nullptr;
  }
  post();
  --patience_;
  if (periods_left_ > 0) {
    --periods_left_;
    return nullptr;
  }
  const auto made = [this] { return !waits_ && state_.load(std::memory_order_acquire) == State::Made; };
  if (!learned(made())) {
    return patience_ > 0 ? nullptr : give_up();
  }
  // In a replay the recorded answer may not be true yet; there is time to wait for it.
  while (!made()) {
    std::this_thread::sleep_for(kSoon);
    post();
  }
  asked_ = false;
  return &plan_;
}

const Plan* PlanningDesk::give_up() noexcept {
  given_up_.fault = {ErrorCode::NoWay};
  given_up_.segment.source = waiting_.command.source;
  given_up_.segment.ticket = waiting_.command.ticket;
  forget();
  return &given_up_;
}

bool PlanningDesk::holds_forgotten() noexcept {
  if (asked_ || !forgot_) {
    return false;
  }
  forgot_ = learned(state_.load(std::memory_order_acquire) == State::Working);
  return forgot_;
}

}  // namespace indurop::robot
