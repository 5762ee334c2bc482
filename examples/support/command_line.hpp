// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// What the command lines of all programs have in common.
#include <CLI/CLI.hpp>
#include <string>
#include <winnow/core/error.hpp>

#include "nearest.hpp"

namespace programs {

/// Parses the arguments into what was bound to `app`.  False where --help or --version has been answered already.
/// Throws invalid_input with one line for every misuse; an unknown option is told with the nearest known one.
inline bool parse(CLI::App& app, int argc, const char* const* argv) {
    app.set_version_flag("--version", WINNOW_VERSION);
    app.allow_extras();
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& answered) {
        app.exit(answered);
        return false;
    } catch (const CLI::Error& e) {
        std::string line = e.what();
        std::replace(line.begin(), line.end(), '\n', ' ');
        winnow::fail(line);
    }
    for (const std::string& extra : app.remaining()) {
        std::vector<std::string> known;
        for (const CLI::Option* option : app.get_options())
            for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
        winnow::fail("unknown option " + extra + did_you_mean(extra, known));
    }
    return true;
}

}  // namespace programs
