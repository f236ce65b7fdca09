// SPDX-License-Identifier: Apache-2.0
// Writes a C++ file that calls every row of the table of standard functions and blocks with every type it accepts, and
// asserts the type of each result. What the table promises is thereby compiled and executed.

#include <fstream>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "control/plc/library/standard.h"

namespace indurop::plc {
namespace {

constexpr Elementary type_at(std::size_t number) noexcept {
  return static_cast<Elementary>(number);
}

// The type each generic one stands for in a call.
using Binding = std::map<Generic, Elementary>;

Elementary bound(LibraryType type, const Binding& binding) {
  const auto* fixed = std::get_if<Elementary>(&type);
  return fixed != nullptr ? *fixed : binding.at(std::get<Generic>(type));
}

// A value that no function has to refuse; `number` makes the texts of one call differ in length.
std::string value_of(Elementary type, std::size_t number) {
  if (type == Elementary::String) {
    return "iec::String<" + std::to_string(10 + number) + ">(\"1\")";
  }
  if (type == Elementary::Wstring) {
    return "iec::WString<" + std::to_string(10 + number) + ">(u\"1\")";
  }
  return std::string(cpp_type(type)) + "{1}";
}

std::string value_of_selector(const LibraryFunction& function, Elementary type) {
  return function.name == "MUX" ? std::string(cpp_type(type)) + "{0}" : value_of(type, 0);
}

std::string expected_type(Elementary type) {
  return is_text(type) ? "iec::Text" : "std::same_as<" + std::string(cpp_type(type)) + ">";
}

class Writer {
 public:
  explicit Writer(std::ostream& out) : out_(out) {}

  void write(const LibraryFunction& function) {
    std::vector<Generic> generics;
    for (const LibraryParameter& input : function.inputs) {
      if (const auto* generic = std::get_if<Generic>(&input.type)) {
        generics.push_back(*generic);
      }
    }
    // One generic type at a time goes through all it stands for, the others stay at their first.
    Binding first;
    for (const Generic generic : generics) {
      first[generic] = types_of(generic).front();
    }
    write_call(function, first);
    for (const auto& [generic, start] : first) {
      for (const Elementary type : types_of(generic)) {
        Binding binding = first;
        binding[generic] = type;
        write_call(function, binding);
      }
    }
  }

  void write(const LibraryBlock& block) {
    out_ << "  {\n    " << block.cpp << " block;\n";
    for (const LibraryParameter& input : block.inputs) {
      out_ << "    block." << input.cpp << " = " << value_of(std::get<Elementary>(input.type), 0) << ";\n";
    }
    out_ << "    block(iec::Scan{});\n";
    for (const LibraryParameter& output : block.outputs) {
      out_ << "    static_assert(std::same_as<decltype(block." << output.cpp << "), "
           << cpp_type(std::get<Elementary>(output.type)) << ">, \"" << block.name << "\");\n";
    }
    out_ << "  }\n";
  }

 private:
  static std::vector<Elementary> types_of(Generic generic) {
    std::vector<Elementary> types;
    for (std::size_t i = 0; i < kElementaryCount; ++i) {
      if (accepts(generic, type_at(i))) {
        types.push_back(type_at(i));
      }
    }
    return types;
  }

  void write_call(const LibraryFunction& function, const Binding& binding) {
    const std::size_t counts[] = {function.inputs.size(), function.inputs.size() + 3};
    for (const std::size_t count : counts) {
      if (count > function.inputs.size() && !function.extensible) {
        continue;
      }
      std::string arguments = function.faults ? "kHere" : "";
      for (std::size_t i = 0; i < count; ++i) {
        const Elementary type = bound(function.input(i).type, binding);
        arguments += (arguments.empty() ? "" : ", ");
        arguments += i == 0 ? value_of_selector(function, type) : value_of(type, i);
      }
      out_ << "  { [[maybe_unused]] " << expected_type(bound(function.result, binding))
           << " auto result = " << function.cpp << "(" << arguments << "); }\n";
    }
  }

  std::ostream& out_;
};

void write_all(std::ostream& out) {
  out << "#include <indurop/plc/library.h>\n#include <indurop/plc/program.h>\n\n#include <concepts>\n\nnamespace iec = "
         "indurop::iec;\n"
         "constexpr iec::Place kHere{\"table\", \"TEST\"};\n\n";
  Writer writer(out);
  int number = 0;
  for (const LibraryFunction& function : library_functions()) {
    out << "static void call_" << number++ << "() {  // " << function.name << "\n";
    writer.write(function);
    out << "}\n";
  }
  for (const LibraryBlock& block : library_blocks()) {
    out << "static void call_" << number++ << "() {  // " << block.name << "\n";
    writer.write(block);
    out << "}\n";
  }
  out << "void call_everything();\nvoid call_everything() {\n";
  for (int i = 0; i < number; ++i) {
    out << "  call_" << i << "();\n";
  }
  out << "}\n";
}

}  // namespace
}  // namespace indurop::plc

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: plc_library_calls FILE\n";
    return 2;
  }
  std::ofstream out(argv[1]);
  indurop::plc::write_all(out);
  return out.flush() ? 0 : 1;
}
