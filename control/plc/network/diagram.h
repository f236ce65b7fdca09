// SPDX-License-Identifier: Apache-2.0
// A drawn body as data: elements with ids, places on the sheet and connections, as in the file and not yet checked.
// Ladder, function block diagram and sequential function chart have one form, because charts contain pieces of the
// others.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "control/plc/model/ast.h"
#include "control/plc/model/source_place.h"

namespace indurop::plc::network {

enum class Storage : std::uint8_t { None, Set, Reset };

// A point on the sheet, or relative to the corner of an element.
struct Point {
  int x = 0;
  int y = 0;
};

// A connection from the output `pin` of element `from`; "" is its only output.
struct Connection {
  Place at;
  std::uint64_t from = 0;
  std::string pin;
  std::vector<Point> corners;  // corners of its line, starting at this end; empty: not in the file
};

struct Pin {
  Place at;
  std::string name;  // of blocks: the formal parameter
  bool negated = false;
  ast::Edge edge = ast::Edge::None;
  Storage storage = Storage::None;
  std::vector<Connection> connections;  // of inputs
  std::optional<Point> spot;            // position at its element
  std::string expression;               // instead of a connection: an operand, or the target
};

struct Body;

// The qualifier of what CODESYS runs in each scan in which a step is active; unlike N not again after it.
inline constexpr const char* kWhileActive = "active";

// One line of an action block.
struct ActionLine {
  Place at;
  std::string qualifier = "N";
  std::string duration;
  std::string indicator;     // has no effect on execution
  std::string name;          // an action or a variable; empty: the body below
  bool only_action = false;  // never a variable
  std::shared_ptr<Body> inlined;
};

struct Element {
  enum class Kind : std::uint8_t {
    LeftRail,
    RightRail,
    Contact,
    Coil,
    Block,
    InVariable,
    OutVariable,
    InOutVariable,
    Label,
    Jump,
    Return,
    Connector,
    Continuation,
    Comment,
    Title,  // of a network, in some editors
    Step,
    Transition,
    JumpStep,
    SelectionDivergence,
    SelectionConvergence,
    SimultaneousDivergence,
    SimultaneousConvergence,
    ActionBlock,
  };
  Kind kind = Kind::Contact;
  std::uint64_t id = 0;
  Place at;
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  std::string text;      // variable, expression, label, name of step or connector, comment, name of a condition
  std::string type;      // Block
  std::string instance;  // Block; empty: a function
  int order = 0;         // execution order; 0: not given
  bool negated = false;
  ast::Edge edge = ast::Edge::None;
  Storage storage = Storage::None;
  bool initial = false;             // Step
  int priority = 0;                 // Transition
  std::shared_ptr<Body> inlined;    // Transition: its condition as code; Block: the code in the box
  std::optional<Pin> condition;     // Transition: its condition as a connection
  std::vector<Pin> inputs;          // of elements other than blocks at most one
  std::vector<Point> ends;          // other elements than blocks: where lines leave them
  std::vector<Pin> in_outs;         // Block
  std::vector<Pin> outputs;         // Block
  std::vector<ActionLine> actions;  // ActionBlock, Step
};

// Returns the word for the element in messages: "contact", "step".
[[nodiscard]] const char* word_of(Element::Kind kind) noexcept;
// Returns "contact Start", "block TON0", "connector 3".
[[nodiscard]] std::string title_of(const Element& element);

struct Diagram {
  std::vector<Element> elements;  // in file order

  // Returns the element with this id, null if there is none.
  [[nodiscard]] const Element* find(std::uint64_t id) const noexcept;
};

// The code of a POU, an action or a transition, in any language.
struct Body {
  enum class Language : std::uint8_t { None, St, Il, Ld, Fbd, Sfc };
  Language language = Language::None;
  Place at;
  std::string text;  // ST, IL
  Place text_at;
  Diagram diagram;  // LD, FBD, SFC
};

// An action or a transition.
struct NamedBody {
  Place at;
  std::string name;
  Body body;
};

// All code of a POU.
struct PouCode {
  Body body;
  std::vector<NamedBody> actions;
  std::vector<NamedBody> transitions;
};

}  // namespace indurop::plc::network
