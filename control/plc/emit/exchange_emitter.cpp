// SPDX-License-Identifier: Apache-2.0
// Numbers are copied by loops over tables: with a line of C++ for each of thousands of variables g++ would take longer
// than for the whole program.
#include "control/plc/emit/exchange_emitter.h"

#include <fmt/format.h>
#include <indurop/detail/abi.h>

#include <algorithm>
#include <map>

#include "control/plc/emit/access_emitter.h"
#include "control/plc/emit/cpp_text.h"

namespace indurop::plc {
namespace {

// Returns the size of a number or a time: it has the same bytes in the program and in the store, which accesses it at
// once.
std::size_t word_bytes(const Type& type) {
  constexpr unsigned kBits = 8;
  return type.kind == Type::Kind::Elementary && !type.is_text() ? std::max(bits_of(type.elementary), kBits) / kBits : 0;
}

class Emitter {
 public:
  Emitter(const TaskUse& use, const std::vector<const Global*>& globals, TextWriter& out)
      : use_(use), globals_(globals), out_(out) {}

  void run() {
    sort();
    records();
    tables();
    declare_accesses(use_, out_);
    read();
    write();
    restore();
  }

 private:
  // A variable that is copied by a table.
  struct Word {
    std::string shared;  // "main::go"
    std::string now;
    bool written = false;
  };
  using Words = std::vector<Word>;

  [[nodiscard]] bool is_word(const Global& global) const {
    return global.kind == Global::Kind::Own && word_bytes(*global.type) > 0;
  }

  void sort() {
    for (const Global* global : globals_) {
      if (in_image(*global) && is_word(*global)) {
        const std::string name = cpp_name(*global);
        add(*global->type, {global->shared_name, "shared." + name, use_.globals.at(global).writes.contains("")});
      }
    }
    for (const SharedLocal& one : use_.locals) {
      if (word_bytes(*one.type) > 0) {
        add(*one.type, {one.shared_name, one.cpp, !one.input});
      }
    }
  }

  void add(const Type& type, Word word) { words_[word_bytes(type)].push_back(std::move(word)); }

  // Records the readers and writers of variables, for tools that inspect a module file; elsewhere each access leaves
  // its own record.
  void records() {
    if (words_.empty()) {
      return;
    }
    constexpr unsigned kHalf = 32;
    constexpr int kRead = 1;
    constexpr int kWrite = 2;
    out_.raw("asm(R\"(.pushsection .indurop.access,\"\",%progbits\n");
    for (const auto& [bytes, words] : words_) {
      for (const Word& one : words) {
        const std::uint64_t hash = abi::fnv1a64(one.shared.data(), one.shared.size());
        out_.raw(fmt::format(".long {},{},{}\n", static_cast<std::uint32_t>(hash),
                             static_cast<std::uint32_t>(hash >> kHalf), one.written ? kRead | kWrite : kRead));
      }
    }
    out_.raw(".popsection)\");\n");
  }

  void tables() {
    for (auto& [bytes, words] : words_) {
      const auto read_only =
          std::stable_partition(words.begin(), words.end(), [](const Word& one) { return one.written; });
      out_.open(fmt::format("constinit const std::array<iec::SharedWord, {}> table_{}", words.size(), bytes));
      for (const Word& one : words) {
        out_.line(fmt::format("iec::SharedWord{{&INDUROP_TYPEOF(::{})::tag_type::ref(), &{}}},", one.shared, one.now));
      }
      out_.close(";");
      out_.line(fmt::format("constinit iec::SharedWords<{}, {}, {}> words_{}{{table_{}}};", unsigned_of(bytes),
                            words.size(), read_only - words.begin(), bytes, bytes));
    }
    out_.line();
  }

  void read() {
    out_.open("void read_shared()");
    for (const auto& [bytes, words] : words_) {
      out_.line(fmt::format("words_{}.read();", bytes));
    }
    bool copied = false;
    for (const Global* global : globals_) {
      if (in_image(*global) && !is_word(*global)) {
        const std::string name = cpp_name(*global);
        out_.line(fmt::format("iec::read_image(shared.{}, {});", name, proxy_of(*global)));
        copied = true;
      }
    }
    for (const SharedLocal& one : use_.locals) {
      if (word_bytes(*one.type) > 0) {
        continue;
      }
      out_.line(fmt::format("iec::read_image({}, ::{});", one.cpp, one.shared_name));
      if (!one.input) {
        out_.line(fmt::format("before_{} = {};", one.name, one.cpp));
      }
    }
    if (copied) {
      out_.line("before = shared;");
    }
    read_accesses(use_, out_);
    out_.close();
    out_.line();
  }

  static std::string unsigned_of(std::size_t bytes) { return fmt::format("std::uint{}_t", bytes * 8); }

  void write() {
    out_.open("void write_shared()");
    write_accesses(use_, out_);
    for (const auto& [bytes, words] : words_) {
      out_.line(fmt::format("words_{}.write();", bytes));
    }
    for (const Global* global : globals_) {
      if (in_image(*global) && !is_word(*global)) {
        write_back(*global);
      }
    }
    for (const SharedLocal& one : use_.locals) {
      if (!one.input && word_bytes(*one.type) == 0) {
        out_.line(fmt::format("iec::write_changed(::{}, {}, before_{});", one.shared_name, one.cpp, one.name));
      }
    }
    out_.close();
  }

  // Writes only what the program can have changed: other fields may have other writers.
  void write_back(const Global& global) {
    const GlobalUse& use = use_.globals.at(&global);
    const bool whole = use.writes.contains("");
    for (const std::string& path : use.writes) {
      bool covered = false;  // an outer struct is written
      for (std::size_t dot = path.rfind('.'); dot != std::string::npos && dot > 0 && !covered;
           dot = path.rfind('.', dot - 1)) {
        covered = use.writes.contains(path.substr(0, dot));
      }
      if (covered || (whole && !path.empty())) {
        continue;
      }
      const std::string name = cpp_name(global);
      out_.line(fmt::format("iec::write_changed({0}{1}, shared.{2}{1}, before.{2}{1});", proxy_of(global), path, name));
    }
  }

  // Runs once, after retained values are restored: timers continue, and an input that was true is no edge.
  void restore() {
    if (use_.restored.empty()) {
      return;
    }
    out_.line();
    out_.line("bool restore_done = false;");
    out_.open("void restore([[maybe_unused]] const iec::Scan& scan)");
    out_.line("if (restore_done) { return; }");
    out_.line("restore_done = true;");
    for (const std::string& one : use_.restored) {
      out_.line(one);
    }
    out_.close();
  }

  const TaskUse& use_;
  const std::vector<const Global*>& globals_;
  TextWriter& out_;
  std::map<std::size_t, Words> words_;  // by size
};

}  // namespace

bool is_copied_by_table(const Type& type) noexcept {
  return word_bytes(type) > 0;
}

void emit_exchange(const TaskUse& use, const std::vector<const Global*>& globals, TextWriter& out) {
  Emitter(use, globals, out).run();
}

}  // namespace indurop::plc
