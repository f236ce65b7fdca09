// SPDX-License-Identifier: Apache-2.0
// The command line of our programs: options are declared once, and parsing, --help, man pages and shell completion are
// derived from that. Hides CLI11, which costs seconds of compile time in every file that includes it. Used by one
// thread.

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

// The words a shell offers to complete a value.
enum class Completion { None, File, Folder, Node, Variable, Module };

// An option as help, man pages and completion show it.
struct OptionText {
  std::string short_name;  // "-o", or empty
  std::string long_name;   // "--output"; for an argument without dashes its name, "file"
  std::string value;       // "FORM"; empty: a flag
  std::string help;
  std::vector<std::string> choices;  // all allowed values; empty: any
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
  std::vector<int> exit_codes;  // codes that it returns; empty: any of core/base/exit_code.h
  std::vector<OptionText> options;
  std::vector<CommandText> commands;
};

// Stores the text of a value, or only checks it; returns what is wrong with it, else an empty string.
using Take = std::function<std::string(const std::string& text)>;

// Further properties of a declared option; valid as long as its Options.
class Option {
 public:
  Option& required();
  Option& range(double least, double most);
  Option& choices(std::vector<std::string> all);
  Option& check(Take rule);
  Option& needs(const Option& other);
  Option& implies(bool& flag);  // set to true if the option is given
  Option& one_at_a_time();      // for a list: each value has its option before it, --peer A --peer B
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

  // `names` is "-o,--output", "--domain", or "file" for an argument without dashes. `value` is the name of the value in
  // help. Variables must outlive parse(); those of options that are not given are unchanged.
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

  // Declares a verb, one of which must be given; `chosen` is called after it was parsed.
  Options& command(const std::string& name, const std::string& purpose, std::function<void()> chosen);
  // Sets which command is meant if none is named; without this call it is `list`.
  void usual_command(const std::string& name);
  // Declares an option of earlier versions: no help shows it, and its error names `now`, the words to use.
  void moved(const std::string& name, const std::string& now);
  void details(std::string text);
  void exit_codes(std::vector<int> codes);
  void version(const std::string& text);  // adds --version

  // Returns the description for man pages and completion.
  [[nodiscard]] CommandText text() const;

  enum class Outcome { Parsed, Info, Wrong };
  struct Result {
    Outcome outcome = Outcome::Parsed;
    std::string text;  // Info: help or version to print; Wrong: the error
  };
  // Parses the words after the program's name.
  [[nodiscard]] Result parse(std::vector<std::string> words);

  // For a whole program: prints help, versions, errors and, for --help-format, pages. Returns the exit code if the
  // program must end.
  [[nodiscard]] std::optional<int> parse_program(int argc, char** argv);

 private:
  Options(CLI::App& app, std::string name, std::string purpose);
  void show_details();
  Option make(const std::string& names, const std::string& value, Take take, const std::string& help);

  std::unique_ptr<CLI::App> owned_;  // of the program; owns the verbs
  CLI::App* app_;
  CommandText text_;
  std::vector<std::unique_ptr<Option::State>> options_;
  std::vector<std::unique_ptr<Options>> commands_;
  std::string usual_ = "list";
};

}  // namespace indurop::base
