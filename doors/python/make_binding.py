#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the C source of the module indurop._binding from <indurop/c.h>: make_binding.py HEADER SOURCE. cffi makes the
calls; the module works with every Python 3 (limited API)."""

import pathlib
import re
import sys

import cffi


# One argument instead of four: cffi takes 100 ns to convert each.
READING = """
typedef struct { const irp_node* node; uint32_t id; void* to; size_t size; } reading;
"""
READ = "static int read_again(const reading* r) { return (int)irp_read(r->node, r->id, r->to, r->size); }"


def declarations(header):
    """The header without comments and preprocessor lines."""
    text = re.sub(r"/\*.*?\*/", "", header.replace("\\\n", ""), flags=re.DOTALL)
    text = re.sub(r'#ifdef __cplusplus.*?#endif', "", text, flags=re.DOTALL)
    text = "\n".join(line for line in text.splitlines() if not line.startswith("#"))
    return text.replace("IRP_API ", "")


def main():
    ffi = cffi.FFI()
    ffi.cdef(declarations(pathlib.Path(sys.argv[1]).read_text()) + READING + "int read_again(const reading*);")
    ffi.set_source("indurop._binding", "#include <indurop/c.h>" + READING + READ)
    ffi.emit_c_code(sys.argv[2])


if __name__ == "__main__":
    main()
