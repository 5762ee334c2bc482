// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// The one exception of the library: bad input, told once, at the host call, before any work.
#include <stdexcept>
#include <string>
#if !defined(__cpp_exceptions)
#include <cstdio>
#include <cstdlib>
#endif

namespace winnow {

/// The caller's buffers or numbers cannot be used; the message names them and their sizes.
struct invalid_input : std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};

/// Throws invalid_input; without exceptions it prints the message and aborts.
[[noreturn]] inline void fail(const std::string& message) {
#if defined(__cpp_exceptions)
    throw invalid_input(message);
#else
    std::fprintf(stderr, "winnow: %s\n", message.c_str());
    std::abort();
#endif
}

}  // namespace winnow
