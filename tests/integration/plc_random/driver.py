# SPDX-License-Identifier: Apache-2.0
"""Compiles random programs as users do, and runs them: what became of every variable after every scan."""

import difflib
import os
import re
import struct
import subprocess

from program import TIMES, outputs_of
from units import LibraryBlock

# The functions of the C library stay calls: g++ would compute those of constants with other roundings.
FLAGS = ["-std=c++20", "-g0", "-w"] + [f"-fno-builtin-{name}{end}" for end in ("", "f") for name in (
    "sqrt", "log", "log10", "exp", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "pow")]

HEAD = """#include "{module}.cpp"
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <span>
#include <string>
#include <vector>

#include "node/modules/module_memory.h"

static std::int64_t time_of_test = 0;
std::int64_t irp::release_ns() noexcept {{ return time_of_test; }}

namespace {{
std::string show(bool v) {{ return v ? "1" : "0"; }}
template <class T> requires std::integral<T> || std::is_enum_v<T> std::string show(T v) {{
  if constexpr (std::unsigned_integral<T>) return std::to_string(static_cast<unsigned long long>(v));
  else return std::to_string(static_cast<long long>(v));
}}
template <std::floating_point T> std::string show(T v) {{
  if (v != v) return "nan";
  std::conditional_t<sizeof(T) == 4, unsigned, unsigned long long> bits;
  std::memcpy(&bits, &v, sizeof v);
  char text[32];
  std::snprintf(text, sizeof text, "%llx", static_cast<unsigned long long>(bits));
  return text;
}}
template <class T> requires requires(T v) {{ v.ns; }} std::string show(T v) {{ return std::to_string(v.ns); }}
template <class T> requires requires(T v) {{ v.view(); }} std::string show(const T& v) {{
  std::string out = "\\"";
  for (const unsigned char c : v.view()) {{ char t[4]; std::snprintf(t, 4, "%02x", c); out += t; }}
  return out;
}}
template <class T, std::size_t N> std::string show(const std::array<T, N>& v);
{structs}
template <class T, std::size_t N> std::string show(const std::array<T, N>& v) {{
  std::string out = "[";
  for (const T& one : v) out += show(one) + " ";
  return out + "]";
}}
// Scans before this one are not run, and those from the other one on.
std::size_t first_scan = 0;
std::size_t end_scan = SIZE_MAX;
// Names of programs that are not run: a fault has left them in the middle of a scan, where loops may have no end.
std::vector<std::string> faulted;
template <class Program, class Show> void run_scans(const char* name, Program& program, Show shown) {{
  if (std::find(faulted.begin(), faulted.end(), name) != faulted.end()) return;
  const std::int64_t times[] = {{{times}}};
  for (std::size_t i = first_scan; i < std::size(times) && i < end_scan; ++i) {{
    const std::int64_t at = times[i];
    std::string fault;
    time_of_test = at;
    try {{ program(iec::Scan{{at}}); }} catch (const std::exception& e) {{ fault = e.what(); }}
    std::printf("%s\\t%s", name, fault.c_str());
    shown();
    std::printf("\\n");
    if (!fault.empty()) return;
  }}
}}
void put(const std::string& value) {{ std::printf("\\t%s", value.c_str()); }}
// What the module keeps: to a file and back, in another process, as a node takes it and a replay puts it back. So are
// globals, which a node keeps in its store.
void keep(const char* path, bool back) {{
  indurop::StateDescriptor kept;
  indurop_module_state(&kept);
  const indurop::node::ModuleMemory memory(kept);
  if (!memory.missing().empty()) std::printf("missing\\t%s\\n", memory.missing().c_str());
  std::FILE* const file = std::fopen(path, back ? "r" : "w");
  std::uint64_t sizes[2] = {{memory.form().size(), memory.most()}};
  const auto move = [&](void* what, std::size_t size) {{
    if (size > 0 && (back ? std::fread(what, size, 1, file) : std::fwrite(what, size, 1, file)) != 1) std::abort();
  }};
  std::string form = memory.form();
  std::vector<std::uint8_t> bytes(memory.most());
  if (!back) {{
    const std::size_t saved = memory.save(std::as_writable_bytes(std::span(bytes)));
    if (saved != bytes.size()) std::printf("astray\\t%s\\n", memory.astray().c_str());
  }}
  move(sizes, sizeof sizes);
  form.resize(sizes[0]);
  bytes.resize(sizes[1]);
  move(form.data(), form.size());
  move(bytes.data(), bytes.size());
  if (back) {{
    for (const std::string& name : memory.restore(form, bytes)) std::printf("astray\\t%s\\n", name.c_str());
  }}
{image}  std::fclose(file);
}}
}}  // namespace

// Nothing: all scans. SCAN FILE: those before, and what is kept then goes into the file. FILE SCAN NAME...: the others, with
// that, of all programs but these.
int main(int argc, char** argv) {{
  const bool back = argc > 2 && std::atoi(argv[1]) == 0;
  if (argc > 2) (back ? first_scan : end_scan) = static_cast<std::size_t>(std::atoi(argv[back ? 2 : 1]));
  if (back) faulted.assign(argv + 3, argv + argc);
  if (back) keep(argv[1], true);
{runs}  if (argc > 2 && !back) keep(argv[2], false);
}}
"""


IMAGE = "  move(&shared, sizeof shared);\n"
ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "../../.."))


def shown(type_, value):
    """As the driver prints it."""
    if type_.kind == "array":
        return nested(type_, value, 0)
    if type_.kind == "struct":
        return "{" + "".join(shown(of, value[name]) + " " for name, of in type_.fields) + "}"
    if type_.kind == "real":
        if value != value:
            return "nan"
        pack, unpack = ("<f", "<I") if type_.bits == 32 else ("<d", "<Q")
        return f"{struct.unpack(unpack, struct.pack(pack, value))[0]:x}"
    if type_.kind == "string":
        return '"' + "".join(f"{ord(c):02x}" for c in value)
    return str(int(value))


def nested(type_, value, level):
    last = level + 1 == len(type_.bounds)
    return "[" + "".join((shown(type_.element, one) if last else nested(type_, one, level + 1)) + " " for one in value) + "]"


def observed(program):
    """(name in the oracle, member in C++, type) of everything that is compared."""
    out = [(one.name, one.name, one.type) for one in program.variables]
    for one in program.blocks_used:
        for name, type_ in outputs_of(one.type):
            member = name.lower() if isinstance(one.type, LibraryBlock) else name
            out.append((f"{one.name}.{name}", f"{one.name}.{member}", type_))
    return out


def driver_text(module, programs, starts, image):
    structs = []
    runs = [f"  time_of_test = {TIMES[0]};\n  start();\n"] if starts else []
    for program in programs:
        for type_ in program.types:
            if type_.kind == "struct":
                fields = " + ".join(f'show(v.{name}) + " "' for name, _ in type_.fields)
                structs.append(f'[[maybe_unused]] std::string show(const plc::{type_.name}& v) {{ return "{{" + {fields} + "}}"; }}')
        puts = " ".join(f"put(show(instance_{program.prefix}.{member}));" for _, member, _ in observed(program))
        runs.append(f'  run_scans("{program.prefix}", instance_{program.prefix}, [] {{ {puts} }});\n')
    return HEAD.format(module=module, structs="\n".join(structs), times=", ".join(map(str, TIMES)), image=IMAGE if image else "", runs="".join(runs))


class Failed(Exception):
    pass


def checked_call(arguments, folder):
    done = subprocess.run(arguments, cwd=folder, capture_output=True, text=True, errors="replace")
    if done.returncode != 0:
        raise Failed(f"{' '.join(arguments[:3])} ...\n{(done.stderr + done.stdout)[:6000]}")
    return done.stdout


def code_of(folder, name):
    """What was generated, without the places of its text."""
    with open(os.path.join(folder, f"{name}.glb"), encoding="utf-8") as glb, open(os.path.join(folder, f"{name}.cpp"), encoding="utf-8") as cpp:
        text = re.sub(r'"[^"\n]*\.(st|xml)[^"\n]*"', "place", glb.read() + cpp.read())
    return re.sub(r"(// Written by|#line) [^\n]*", "", text)


def check_export(build, folder):
    """Exported as PLCopen XML and read again, the programs become the same code."""
    tool = [os.path.join(build, "bin/indurop"), "plc"]
    os.makedirs(os.path.join(folder, "again"), exist_ok=True)
    checked_call([*tool, "export", "batch.st", "-o", "again/batch.xml", "--quiet"], folder)
    checked_call([*tool, "build", "again/batch.xml", "--only-sources", "--quiet", "-o", "again"], folder)
    before, after = code_of(folder, "batch").splitlines(), code_of(os.path.join(folder, "again"), "batch").splitlines()
    if before != after:
        raise Failed("exported and read again it is other code:\n" + "\n".join(list(difflib.unified_diff(before, after, n=0))[:20]))


def compile_batch(build, folder, programs, optimize, coverage=False):
    """The path of a program that runs all of them, and counts what of them if that is wanted."""
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "batch.st"), "w", encoding="latin-1") as file:
        for program in programs:
            file.write("\n".join(program.text()) + "\n")
    counting = ["--coverage"] if coverage else []
    checked_call([os.path.join(build, "bin/indurop"), "plc", "build", "batch.st", "--only-sources", "--quiet", *counting], folder)
    if not coverage and not any(program.starts for program in programs):
        check_export(build, folder)
    return compile_driver(build, folder, programs, optimize)


def compile_driver(build, folder, programs, optimize):
    """The path of a program that runs those of batch.cpp."""
    checked_call([os.path.join(build, "bin/glb2idl"), "--out-dir", ".", "batch.glb"], folder)
    with open(os.path.join(folder, "driver.cpp"), "w", encoding="utf-8") as file:
        with open(os.path.join(folder, "batch.cpp"), encoding="utf-8") as code:
            text = code.read()
        file.write(driver_text("batch", programs, "void start() {" in text, "Image shared;" in text))
    compiler = os.environ.get("CXX") or "g++"
    memory = [f"{ROOT}/{name}.cpp" for name in ("node/modules/module_memory", "node/modules/relocation", "store/tape/grown_array",
                                                "store/tape/state_copy", "store/tape/state_form")]
    checked_call([compiler, *FLAGS, optimize, f"-I{ROOT}", f"-isystem{build}/include", "-isystem.", "driver.cpp", *memory,
                  "-o", "driver", f"-L{build}/lib", "-lindurop", "-lindurop_rt", "-lindurop_rt_posix", "-lfmt",
                  f"-Wl,-rpath,{build}/lib"], folder)
    return os.path.join(folder, "driver")


def results(path, folder, *arguments):
    """By program: [(fault, [values])] of its scans."""
    environment = dict(os.environ, INDUROP_NODE="plcrandom-none", INDUROP_PLC_COVERAGE=folder)
    done = subprocess.run([path, *arguments], cwd=folder, capture_output=True, text=True, env=environment, timeout=300)
    if done.returncode != 0:
        raise Failed(f"the programs ended with {done.returncode}: {done.stderr[:2000]}")
    out = {}
    for line in done.stdout.splitlines():
        name, fault, *values = line.split("\t")
        out.setdefault(name, []).append((fault, values))
    return out


def resumed(path, folder, scan):
    """As results(), but what the programs keep goes to another process before this scan."""
    out = results(path, folder, str(scan), "kept")
    faulted = [name for name, scans in out.items() if scans[-1][0] != ""]
    after = results(path, folder, "kept", str(scan), *faulted)
    for word in ("missing", "astray"):
        if word in out or word in after:
            raise Failed(f"{word}: {out.get(word)} {after.get(word)}")
    for name, scans in after.items():
        out[name] += scans
    return out


def counted_lines(build, folder):
    """By line of the text: how often it ran, as `indurop plc coverage` says."""
    checked_call([os.path.join(build, "bin/indurop"), "plc", "coverage", ".", "--lcov", "batch.info", "--quiet"], folder)
    with open(os.path.join(folder, "batch.info"), encoding="utf-8") as file:
        lines = file.read().splitlines()
    return {int(line): int(count) for line, count in (one[3:].split(",") for one in lines if one.startswith("DA:"))}
