// SPDX-License-Identifier: Apache-2.0
// The command line of our programs: options are declared once, and parsing, --help, man pages and shell completion
// come from that. The door to CLI11, which costs seconds in every file that includes it. Used by one thread.

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace indurop::base {

// What a shell offers for a value.
enum class Completion { None, File, Folder, Node, Variable, Module };

// An option as help, man pages and completion show it.
struct OptionText {
  std::string short_name;  // "-o", or empty
  std::string long_name;   // "--output"; of an argument without dashes its name, "file"
  std::string value;       // "FORM"; empty: a flag
  std::string help;
  std::vector<std::string> choices;  // all values there are; empty: any
  Completion completion = Completion::None;
  bool positional = false;
  bool required = false;
  bool repeated = false;
};

// A program or a verb of one.
struct CommandText {
  std::string name;
  std::string group;            // heading in a list of commands
  std::string purpose;          // one line
  std::string details;          // below the options
  std::vector<int> exit_codes;  // that it returns; empty: any of base/exit_code.h
  std::vector<OptionText> options;
  std::vector<CommandText> commands;
};

// Takes the text of a value, or only looks at it; returns what is wrong with it, else nothing.
using Take = std::function<std::string(const std::string& text)>;

// What more is to be said of an option; valid as long as its Options.
class Option {
 public:
  Option& required();
  Option& range(double least, double most);
  Option& choices(std::vector<std::string> all);
  Option& check(Take look);
  Option& needs(const Option& other);
  Option& implies(bool& flag);  // becomes true if the option is given
  Option& one_at_a_time();      // of a list: each value has its option in front, --peer A --peer B
  Option& completes(Completion what);

 private:
  friend class Options;
  struct State;
  Option(State& state, CLI::Option& option) : state_(&state), option_(&option) {}

  State* state_;
  CLI::Option* option_;
};

class Options {
 public:
  Options(const std::string& name, std::string purpose);
  Options(const Options&) = delete;
  Options& operator=(const Options&) = delete;
  ~Options();

  // `names` is "-o,--output", "--domain", or "file" for an argument without dashes. `value` is what help calls the
  // value. Variables must outlive parse(); those of options that are not given keep what they hold.
  Option flag(const std::string& names, bool& to, const std::string& help);
  Option add(const std::string& names, const std::string& value, std::string& to, const std::string& help);
  Option add(const std::string& names, const std::string& value, int& to, const std::string& help);
  Option add(const std::string& names, const std::string& value, std::uint64_t& to, const std::string& help);
  Option add(const std::string& names, const std::string& value, double& to, const std::string& help);
  Option add(const std::string& names, const std::string& value, std::optional<int>& to, const std::string& help);
  Option add(const std::string& names, const std::string& value, std::vector<std::string>& to, const std::string& help);
  Option add(const std::string& names, const std::string& value, Take take, const std::string& help);
  template <class Path>
  requires requires { Path::preferred_separator; }
  Option add(const std::string& names, const std::string& value, Path& to, const std::string& help) {
    const auto take = [&to](const std::string& text) {
      to = text;
      return std::string();
    };
    return add(names, value, Take(take), help);
  }

  // A verb of its own, one of which must be given; `chosen` is called once it was parsed.
  Options& command(const std::string& name, const std::string& purpose, std::function<void()> chosen);
  void details(std::string text);
  void exit_codes(std::vector<int> codes);
  void version(const std::string& text);  // adds --version

  // As man pages and completion have it.
  [[nodiscard]] CommandText text() const;

  enum class Outcome { Parsed, Told, Wrong };
  struct Result {
    Outcome outcome = Outcome::Parsed;
    std::string text;  // Told: help or version to be printed; Wrong: what is wrong
  };
  // Takes the words after the program's name.
  [[nodiscard]] Result parse(std::vector<std::string> words);

  // Of a whole program: prints help, versions, errors and, for --help-format, pages. Returns the exit code if the
  // program is to end.
  [[nodiscard]] std::optional<int> parse_program(int argc, char** argv);

 private:
  Options(CLI::App& app, std::string name, std::string purpose);
  void show_details();
  Option make(const std::string& names, const std::string& value, Take take, const std::string& help);

  std::unique_ptr<CLI::App> owned_;  // of the program; verbs belong to it
  CLI::App* app_;
  CommandText text_;
  std::vector<std::unique_ptr<Option::State>> options_;
  std::vector<std::unique_ptr<Options>> commands_;
};

}  // namespace indurop::base
