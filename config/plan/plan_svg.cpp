// SPDX-License-Identifier: Apache-2.0
// The schedule as a timing diagram like the chapter's Figure 2: one lane per module, basic periods from left to right.
// Releases and order are exact; execution times are not known, so all boxes of a diagram have the same length.

#include <algorithm>
#include <array>
#include <map>

#include "config/plan/plan_parts.h"
#include "core/base/svg.h"
#include "core/base/text.h"
#include "scheduler/words.h"

namespace indurop::config {
namespace {

using scheduler::ModuleType;

constexpr int kMargin = 24;
constexpr int kLaneHeight = 36;
constexpr int kBoxHeight = 22;
constexpr int kGroupGap = 14;
constexpr int kShortestSlot = 100;
constexpr int kMaxWidth = 1600;          // of all slots together; further basic periods are left out
constexpr std::size_t kWantedSlots = 5;  // minimum number of visible slots, whatever the number of modules
constexpr std::size_t kMaxShownSlots = 60;
constexpr std::size_t kLongestLabel = 28;
constexpr std::array<const char*, 7> kColours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                              "#E69F00", "#56B4E9", "#7F7F7F"};
constexpr const char* kInk = "#1F2933";
constexpr const char* kFaint = "#66727F";
constexpr const char* kGrid = "#B8C2CC";
constexpr const char* kEvent = "#8A6D00";
constexpr const char* kEventFill = "#FFF1B8";

struct Lane {
  int y = 0;  // of its box
};

class Diagram {
 public:
  Diagram(const Config& config, const CheckResult& check, std::string title)
      : config_(config), check_(check), title_(std::move(title)) {
    for (const std::uint32_t item : check_.table.order) {
      const base::Nanos period = config_.modules[check_.periodic[item]].period;
      if (std::find(periods_.begin(), periods_.end(), period) == periods_.end()) {
        periods_.push_back(period);
      }
    }
    std::sort(periods_.begin(), periods_.end());
    measure();
  }

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  void draw(base::Svg& svg) const {
    draw_title(svg);
    draw_grid(svg);
    draw_labels(svg);
    for (std::size_t slot = 0; slot < shown_; ++slot) {
      draw_slot(svg, slot);
    }
    draw_legend(svg);
  }

 private:
  [[nodiscard]] const Module& periodic(std::uint32_t item) const { return config_.modules[check_.periodic[item]]; }
  [[nodiscard]] const char* colour(base::Nanos period) const {
    const auto found = std::find(periods_.begin(), periods_.end(), period);
    return kColours.at(static_cast<std::size_t>(found - periods_.begin()) % kColours.size());
  }
  [[nodiscard]] int slot_x(std::size_t slot) const { return left_ + static_cast<int>(slot) * slot_width_; }

  void measure() {
    int label = 96;
    for (const Module& module : config_.modules) {
      const int name = static_cast<int>(std::min(base::characters(module.name), kLongestLabel)) * 9;
      label = std::max({label, name, static_cast<int>(base::characters(rule_of(module))) * 7});
    }
    left_ = kMargin + label + 16;

    std::size_t busiest = 0;
    for (const scheduler::Slot& slot : check_.table.slots) {
      busiest = std::max(busiest, slot.items.size());
    }
    const int boxes = static_cast<int>(busiest + check_.sporadic.size()) + (check_.sporadic.empty() ? 0 : 1);
    const int rest = check_.non_real.empty() ? 1 : 2;  // rest of a basic period, in boxes
    const int slots = static_cast<int>(std::clamp<std::size_t>(check_.table.slots.size(), 1, kWantedSlots));
    box_width_ = std::clamp(kMaxWidth / (slots * (boxes + rest)), 4, 26);
    slot_width_ = std::max(kShortestSlot, box_width_ * (boxes + rest) + 8);
    const auto fit = static_cast<std::size_t>(std::max(kMaxWidth / slot_width_, 1));
    shown_ = std::min({check_.table.slots.size(), fit, kMaxShownSlots});
    complete_ = shown_ == check_.table.slot_count;

    int y = kMargin + 120;
    lanes_.resize(config_.modules.size());
    const auto place = [&](std::size_t module) {
      lanes_[module].y = y + (kLaneHeight - kBoxHeight) / 2;
      y += kLaneHeight;
    };
    top_ = y;
    for (const std::uint32_t item : check_.table.order) {
      place(check_.periodic[item]);
    }
    if (!check_.sporadic.empty()) {
      y += kGroupGap;
      handler_y_ = y + (kLaneHeight - kBoxHeight) / 2;
      y += kLaneHeight;
      std::for_each(check_.sporadic.begin(), check_.sporadic.end(), place);
    }
    if (!check_.non_real.empty()) {
      y += kGroupGap;
      std::for_each(check_.non_real.begin(), check_.non_real.end(), place);
    }
    bottom_ = y;
    right_ = left_ + std::max(static_cast<int>(shown_), 1) * slot_width_;
    width_ = std::max(right_ + kMargin + (complete_ ? 0 : 40), left_ + 560);
    height_ = bottom_ + 56 + legend_height();
  }

  [[nodiscard]] std::string rule_of(const Module& m) const {
    switch (m.operation) {
      case scheduler::Operation::Periodic:
        return (uses_several_cores(config_) && core_of(config_, m) >= 0
                    ? "core " + std::to_string(core_of(config_, m)) + ", "
                    : "") +
               "every " + base::format_duration(m.period) +
               (m.offset > base::Nanos::zero() ? " + " + base::format_duration(m.offset) : "") + ", priority " +
               std::to_string(m.priority);
      case scheduler::Operation::Sporadic:
        return "within " + base::format_duration(m.deadline) + ", priority " + std::to_string(m.priority);
      case scheduler::Operation::NonReal:
        return "non-real-time " + std::string(to_text(m.type));
    }
    return {};
  }

  void draw_title(base::Svg& svg) const {
    svg.text(kMargin, kMargin + 14, title_, 18, kInk, "start", true);
    if (check_.periodic.empty()) {
      svg.text(kMargin, kMargin + 38, "no periodic modules", 13, kFaint);
      return;
    }
    const int y = kMargin + 58;
    const std::string macro = "macro period " + base::format_duration(check_.table.macro_period) + " = " +
                              std::to_string(check_.table.slot_count) + " x basic period " +
                              base::format_duration(check_.table.basic_period);
    const std::string text = complete_ ? macro : macro + ", the first " + std::to_string(shown_) + " shown";
    svg.line(left_, y, right_, y, kInk, 1.5);
    svg.line(left_, y - 6, left_, y + 6, kInk, 1.5);
    if (complete_) {
      svg.line(right_, y - 6, right_, y + 6, kInk, 1.5);
    } else {
      svg.line(right_, y, right_ + 24, y, kInk, 1.5, "2 4");
    }
    svg.text(left_, y - 12, text, 13, kInk);
  }

  void draw_grid(base::Svg& svg) const {
    const int axis = top_ - 14;
    if (!check_.periodic.empty()) {
      svg.text(left_ - 12, axis - 8, "ms", 12, kFaint, "end");
    }
    for (std::size_t slot = 0; slot <= shown_ && shown_ > 0; ++slot) {
      const int x = slot_x(slot);
      if (slot < shown_ && slot % 2 == 1) {
        svg.rect(x, axis, slot_width_, bottom_ - axis, "#F7F9FA");
      }
    }
    for (std::size_t slot = 0; slot <= shown_ && shown_ > 0; ++slot) {
      const int x = slot_x(slot);
      svg.line(x, axis - 4, x, bottom_ + 6, kGrid, 1);
      const base::Nanos time = check_.table.basic_period * static_cast<std::int64_t>(slot);
      svg.text(x, axis - 8, milliseconds(time), 12, kFaint, "middle");
      svg.raw("<path d=\"M" + std::to_string(x - 4) + " " + std::to_string(axis - 4) + " h8 l-4 8 z\" fill=\"" +
              std::string(kInk) + "\"/>\n");
    }
    if (complete_ && shown_ > 0) {
      svg.text(right_, bottom_ + 22, "repeats", 12, kFaint, "end");
    }
  }

  void draw_label(base::Svg& svg, int box_y, const std::string& name, const std::string& rule) const {
    svg.text(left_ - 14, box_y + 9, base::shortened(name, kLongestLabel), 13, kInk, "end", true);
    svg.text(left_ - 14, box_y + 23, rule, 11, kFaint, "end");
    svg.line(kMargin, box_y + kBoxHeight + 7, right_, box_y + kBoxHeight + 7, "#E4E8EC", 1);
  }

  void draw_labels(base::Svg& svg) const {
    if (!check_.sporadic.empty()) {
      draw_label(svg, handler_y_, "event handler", "each basic period");
    }
    for (std::size_t i = 0; i < config_.modules.size(); ++i) {
      if (lanes_[i].y != 0) {
        draw_label(svg, lanes_[i].y, config_.modules[i].name, rule_of(config_.modules[i]));
      }
    }
  }

  static void module_box(base::Svg& svg, int x, int y, int width, const char* with, ModuleType type) {
    if (type == ModuleType::Thread) {
      svg.box(x, y, width, kBoxHeight, with, with);
    } else {
      svg.box(x, y, width, kBoxHeight, "#FFFFFF", with, "", 2);
    }
  }
  static void event_box(base::Svg& svg, int x, int y, int width) {
    svg.box(x, y, width, kBoxHeight, kEventFill, kEvent, "4 3", 1.5);
  }

  // Draws a light line from one box down or up to the next: the order of execution on a core.
  static void step(base::Svg& svg, int x, int& from_y, int to_y) {
    if (from_y != 0) {
      svg.line(x, std::min(from_y, to_y) + kBoxHeight / 2, x, std::max(from_y, to_y) + kBoxHeight / 2, "#9AA5B1", 1,
               "2 2");
    }
    from_y = to_y;
  }

  void draw_slot(base::Svg& svg, std::size_t number) const {
    const scheduler::Slot& slot = check_.table.slots[number];
    // The drawing position of each core: its next box, and the lane of its last one.
    struct Way {
      int x;
      int y = 0;
    };
    std::map<int, Way> ways;
    std::vector<int> ends(config_.modules.size());  // of the boxes of this slot
    const auto way_of = [&](int core) -> Way& { return ways.try_emplace(core, Way{slot_x(number) + 4}).first->second; };
    bool base_done = false;
    const auto sporadic = [&](bool after_base) {
      auto& [x, y] = way_of(config_.core);
      for (const std::size_t module : check_.sporadic) {
        if (config_.modules[module].after_base == after_base) {
          step(svg, x, y, lanes_[module].y);
          event_box(svg, x, lanes_[module].y, box_width_ - 2);
          x += box_width_;
        }
      }
    };
    for (const std::uint32_t item : slot.items) {
      const Module& module = periodic(item);
      if (!base_done && (module.period != check_.table.basic_period || module.type != ModuleType::Thread)) {
        base_done = true;
        sporadic(true);
      }
      const std::size_t index = check_.periodic[item];
      const int lane = lanes_[index].y;
      auto& [x, y] = way_of(core_of(config_, module));
      for (const std::size_t earlier : waited_for(config_, check_, index)) {
        x = std::max(x, ends[earlier]);
      }
      step(svg, x, y, lane);
      module_box(svg, x, lane, box_width_ - 2, colour(module.period), module.type);
      x += box_width_;
      ends[index] = x;
    }
    if (!base_done) {
      sporadic(true);
    }
    auto& [x, y] = way_of(config_.core);
    for (const int end : ends) {
      x = std::max(x, end);
    }
    if (!check_.sporadic.empty()) {
      step(svg, x, y, handler_y_);
      svg.box(x, handler_y_, box_width_ - 2, kBoxHeight, kInk, kInk);
      x += box_width_;
      sporadic(false);
    }
    const int end = slot_x(number + 1) - 4;
    for (const std::size_t module : check_.non_real) {
      step(svg, x, y, lanes_[module].y);
      svg.box(x, lanes_[module].y, std::max(end - x, 2), kBoxHeight, "url(#rest)", "#8995A1");
    }
  }

  enum class Sample { Period, Process, Handler, Event, Rest };
  struct Entry {
    Sample sample;
    base::Nanos period;
    std::string text;
  };

  [[nodiscard]] std::vector<Entry> legend() const {
    std::vector<Entry> entries;
    for (const base::Nanos period : periods_) {
      entries.push_back({Sample::Period, period, "every " + base::format_duration(period)});
    }
    const auto process = std::find_if(check_.periodic.begin(), check_.periodic.end(),
                                      [this](std::size_t i) { return config_.modules[i].type == ModuleType::Process; });
    if (process != check_.periodic.end()) {
      entries.push_back({Sample::Process, config_.modules[*process].period, "frame only: a process"});
    }
    if (!check_.sporadic.empty()) {
      entries.push_back({Sample::Handler, {}, "event handler"});
      entries.push_back({Sample::Event, {}, "sporadic, if its event occurred"});
    }
    if (!check_.non_real.empty()) {
      entries.push_back({Sample::Rest, {}, "non-real-time, in the time left"});
    }
    return entries;
  }
  [[nodiscard]] int columns() const { return std::max((width_ - 2 * kMargin) / 240, 1); }
  [[nodiscard]] int legend_height() const {
    const int entries = static_cast<int>(legend().size());
    return (entries + columns() - 1) / columns() * 26 + 40;
  }

  void draw_legend(base::Svg& svg) const {
    int index = 0;
    const int top = bottom_ + 44;
    for (const Entry& entry : legend()) {
      const int x = kMargin + index % columns() * 240;
      const int y = top + index / columns() * 26;
      switch (entry.sample) {
        case Sample::Period:
          module_box(svg, x, y - 5, 24, colour(entry.period), ModuleType::Thread);
          break;
        case Sample::Process:
          module_box(svg, x, y - 5, 24, colour(entry.period), ModuleType::Process);
          break;
        case Sample::Handler:
          svg.box(x, y - 5, 24, kBoxHeight, kInk, kInk);
          break;
        case Sample::Event:
          event_box(svg, x, y - 5, 24);
          break;
        case Sample::Rest:
          svg.box(x, y - 5, 24, kBoxHeight, "url(#rest)", "#8995A1");
          break;
      }
      svg.text(x + 32, y + 10, entry.text, 12, kInk);
      ++index;
    }
    svg.text(kMargin, height_ - 14,
             "Releases and order are exact. Execution times are not known before the run: the boxes of all modules are "
             "equally long.",
             11, kFaint);
  }

  const Config& config_;
  const CheckResult& check_;
  std::string title_;
  std::vector<base::Nanos> periods_;  // distinct, ascending
  std::vector<Lane> lanes_;           // by module
  int handler_y_ = 0;
  int left_ = 0;  // of the first basic period
  int right_ = 0;
  int top_ = 0;
  int bottom_ = 0;
  int width_ = 0;
  int height_ = 0;
  int box_width_ = 0;
  int slot_width_ = 0;
  std::size_t shown_ = 0;  // basic periods
  bool complete_ = false;
};

void define_patterns(base::Svg& svg) {
  svg.raw(
      "<defs><pattern id=\"rest\" width=\"7\" height=\"7\" patternUnits=\"userSpaceOnUse\" "
      "patternTransform=\"rotate(45)\"><rect width=\"7\" height=\"7\" fill=\"#F2F4F6\"/>"
      "<line x1=\"0\" y1=\"0\" x2=\"0\" y2=\"7\" stroke=\"#C3CCD5\" stroke-width=\"3\"/></pattern></defs>\n");
}

}  // namespace

std::string plan_svg(const Config& config, const CheckResult& check) {
  const std::string file = config.file.filename().string();
  const Diagram diagram(config, check, "Schedule" + (file.empty() ? "" : " of " + file));
  base::Svg svg(diagram.width(), diagram.height());
  define_patterns(svg);
  diagram.draw(svg);
  return svg.finish();
}

std::string plan_svg(const Plant& plant, const PlantCheck& check) {
  std::vector<Diagram> diagrams;
  int width = 0;
  int height = 0;
  for (std::size_t i = 0; i < plant.boards.size(); ++i) {
    diagrams.emplace_back(plant.boards[i].config, check.boards[i], "Schedule of board " + plant.boards[i].name);
    width = std::max(width, diagrams.back().width());
    height += diagrams.back().height();
  }
  base::Svg svg(width, height);
  define_patterns(svg);
  int y = 0;
  for (const Diagram& diagram : diagrams) {
    svg.raw("<g transform=\"translate(0 " + std::to_string(y) + ")\">\n");
    diagram.draw(svg);
    svg.raw("</g>\n");
    y += diagram.height();
  }
  return svg.finish();
}

}  // namespace indurop::config
