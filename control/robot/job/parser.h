// SPDX-License-Identifier: Apache-2.0
// The parser of one job file: points and motion in parser.cpp, the rest in flow.cpp. Names of points, jobs and
// labels are recorded with their places and resolved when all files have been read.

#pragma once

#include <map>

#include "control/robot/job/job.h"
#include "control/robot/job/text.h"
#include "core/base/diagnostics.h"

namespace indurop::robot {

// A name that is used before its declaration has been read.
struct JobReference {
  enum class To { Target, Mid, Job, Label, Tool };
  To to = To::Target;
  std::size_t job = 0;
  std::size_t step = 0;
  std::string name;
  std::size_t line = 0;
  std::size_t column = 0;
};

struct JobLabel {
  std::size_t step = 0;
  std::size_t line = 0;
};

class JobParser {
 public:
  JobParser(JobBook& book, base::Diagnostics& errors, const ArmShape& shape)
      : book_(book), errors_(errors), shape_(shape) {}

  // Reads one file as the next job of the book.
  void read(const JobFile& file);
  // Resolves names; called after all files have been read.
  void resolve();

 private:
  void statement();
  void point();
  void frame();
  void offset();
  void tool();
  void taught_tool(Tool& tool);
  void load();
  void mass(Body& body);
  void keepout();
  void body();
  bool begin_body(BodyLine& line, const char* example);
  bool solid(Solid& solid);
  double radius();
  void resolve_bodies();
  void resolve_frames();
  void resolve_tools();
  [[nodiscard]] int tool_called(std::string_view name) const noexcept;
  bool numbers(int count, double* to, const char* what);
  void joint_point(Target& target);
  // Parses "x y z RPY r p y", in mm and degrees.
  bool pose(Pose& pose);
  void pose_point(Target& target);
  void posture(Target& target);
  void held_axis(Target& target);
  [[nodiscard]] double axis_value(int axis, double written) const noexcept;
  void move(Move kind);
  void spline();
  void speed();
  void zone();
  void acceleration();
  void set();
  void pulse();
  void add_setting(Step step);
  void set_on_path(Step wanted);
  void assign();
  void variable();
  void parameters();
  void wait();
  void call();
  void arm();
  void disarm();
  void jump();
  void if_goto();
  void otherwise(bool condition);
  void try_block();
  void recover();
  void while_block();
  void for_block();
  void label();
  void loop();
  void end_block();
  bool duration(double& seconds);
  int signal(const char* what);
  static bool is_reserved(std::string_view word) noexcept;
  [[nodiscard]] int variable_called(std::string_view name) const noexcept;
  int new_variable(const JobToken& name);
  // Returns the index of the formula in the book.
  int expression(const char* what);
  int keep(Formula formula);
  Formula disjunction(const char* what, int depth);
  Formula conjunction(const char* what, int depth);
  Formula negation(const char* what, int depth);
  Formula comparison(const char* what, int depth);
  Formula sum(const char* what, int depth);
  Formula product(const char* what, int depth);
  Formula operand(const char* what, int depth);
  Formula named();
  void reference(JobReference::To to, const char* what);
  void expect_end();

  [[nodiscard]] const JobToken& peek() const { return tokens_[at_]; }
  JobToken take() { return tokens_[at_].kind == JobToken::Kind::End ? tokens_[at_] : tokens_[at_++]; }
  bool accept(std::string_view word);
  void error(const JobToken& at, const std::string& text);
  void error_in(const std::string& file, std::size_t line, std::size_t column, const std::string& text);
  Step& add(Op op);
  [[nodiscard]] Job& job() { return book_.jobs.back(); }
  [[nodiscard]] static std::string shown(const JobToken& token);

  JobBook& book_;
  base::Diagnostics& errors_;
  const ArmShape shape_;
  std::vector<JobToken> tokens_;
  std::size_t at_ = 0;
  std::size_t line_ = 0;
  bool failed_ = false;  // only one message per line
  // A block that END closes: LOOP, IF, WHILE or FOR.
  struct Block {
    const char* word = "";
    std::size_t line = 0;
    std::size_t start = 0;            // first step of the block
    std::size_t pending = kNone;      // step that jumps past this part of the block
    std::vector<std::size_t> ends{};  // steps that jump past the block
    int counter = -1;                 // variable of FOR
    double by = 1;
    bool has_else = false;
  };
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<Block> blocks_;
  std::vector<JobReference> references_;
  // A name in the declaration of a point (its frame) or of a frame (its points).
  struct Declared {
    std::size_t owner = 0;  // index of the point or frame
    std::size_t job = 0;
    std::string name;
    std::size_t line = 0;
    std::size_t column = 0;
  };
  std::vector<Declared> point_frames_;
  std::vector<Declared> frame_points_;  // three for each taught frame
  std::vector<Declared> frame_tools_, tool_points_;
  std::vector<Declared> body_names_;                                  // frames of zones
  std::vector<std::map<std::string, JobLabel, std::less<>>> labels_;  // per job
  std::map<std::string, std::string, std::less<>> point_places_;
};

}  // namespace indurop::robot
