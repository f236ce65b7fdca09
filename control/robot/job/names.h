// SPDX-License-Identifier: Apache-2.0
// Names that statements use, of points, frames, tools, jobs and labels. They are recorded with their places and
// resolved when all files have been read, so that they may be declared later and in other files.

#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "control/robot/job/draft.h"
#include "control/robot/job/line.h"

namespace indurop::robot {

class JobNames {
 public:
  // What the name stands for in a step.
  enum class To { Target, Mid, Job, Label, Tool, Computed, Frame, Tracked, Origin };
  // What the name stands for in a declaration.
  enum class In { PointFrame, FramePoint, FrameMatch, FrameTool, ToolPoint, ZoneFrame, PlaceName };

  JobNames(JobLine& line, JobDraft& draft) : line_(line), draft_(draft) {}

  void begin_job() { labels_.emplace_back(); }
  // Returns whether this is a place that no file declares: HERE, BACK, FOUND.
  static bool is_special(std::string_view point) noexcept;
  // Reads a name that the last step refers to.
  void refer(To to, const char* what);
  void refer(To to, const JobToken& name);
  // Records a name in the declaration of the `owner`-th thing of its kind. The three points of a frame come in order.
  void declare(In in, std::size_t owner, const JobToken& name);
  // Drops the last names of this kind.
  void drop(In in, std::size_t count);
  // Drops the frame of a point that does not exist.
  void drop_frame_of(std::size_t point);
  // Declares a label at the step that is added next.
  void label(const JobToken& name);

  void resolve();

 private:
  struct Mention {
    std::size_t job = 0;
    std::string name;
    std::size_t line = 0;
    std::size_t column = 0;
  };
  struct Reference {
    To to = To::Target;
    std::size_t step = 0;
    Mention at;
  };
  struct Declared {
    std::size_t owner = 0;
    Mention at;
  };
  struct Label {
    std::size_t step = 0;
    std::size_t line = 0;
  };

  // Names to their places in the book; the first of equals.
  using Index = std::unordered_map<std::string_view, int>;
  struct Known {
    Index points;
    Index frames;
    Index tools;
    Index jobs;
  };

  [[nodiscard]] Mention mention(const JobToken& name) const;
  void error(const Mention& at, const std::string& text);
  void no_such(const Mention& at, const char* what, const std::vector<std::string>& known);
  void resolve_point_frames();
  void resolve_frame_points();
  void resolve_matched_points();
  int base_point(const Mention& at);
  void resolve_tool_points();
  void resolve_frame_tools();
  void resolve_zones();
  void resolve_bodies();
  void resolve_places();
  void resolve(const Reference& reference);
  int frame_called(const Mention& at);
  void resolve_label(const Reference& reference, Step& step);
  void resolve_job(const Reference& reference, Step& step);
  void resolve_point(const Reference& reference, Step& step);
  void resolve_computed(const Reference& reference, Step& step);
  void keep_zones_in_place();
  [[nodiscard]] std::vector<Declared>& of(In in) { return declared_[static_cast<std::size_t>(in)]; }

  template <class List>
  [[nodiscard]] std::vector<std::string> suggested(const List& list) const;

  JobLine& line_;
  JobDraft& draft_;
  Known known_;  // all names, while they are resolved
  std::vector<Reference> references_;
  std::array<std::vector<Declared>, 7> declared_;                  // by In
  std::vector<std::map<std::string, Label, std::less<>>> labels_;  // per job
};

}  // namespace indurop::robot
