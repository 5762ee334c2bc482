// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Runs a program as a user does.
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <support/folder.hpp>

namespace winnow::test {

struct outcome {
    int code;
    std::string out, err;

    int lines() const { return static_cast<int>(std::count(err.begin(), err.end(), '\n')); }
};

/// What it prints goes into a folder of its own.
inline outcome run_program(const std::string& command) {
    const folder said;
    const int status = std::system((command + " >" + said.name("out") + " 2>" + said.name("err")).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, said.read("out"), said.read("err")};
}

}  // namespace winnow::test
