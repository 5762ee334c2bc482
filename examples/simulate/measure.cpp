// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include "measure.hpp"

#include <winnow/io/exr.hpp>
#include <winnow/metric/mse.hpp>
#include <winnow/metric/relative_mse.hpp>
#include <winnow/metric/two_references.hpp>

namespace simulator {

using namespace winnow;

references references::read(const std::vector<std::string>& files, extent size) {
    std::vector<image<float>> all;
    for (const std::string& name : files) {
        all.push_back(io::read_exr(name).read({"R", "G", "B"}));
        if (all.back().size() != size)
            fail(name + " is " + to_string(all.back().size()) + ", the render is " + to_string(size));
    }
    return references(std::move(all));
}

metrics references::measure(const image<float>& picture) const {
    const source x = picture.view(), first = pictures_.front().view(), second = pictures_.back().view();
    if (pictures_.size() == 2) return {metric::mse(x, first, second), metric::relative_mse(x, first, second)};
    return {metric::mse(x, first), metric::relative_mse(x, first)};
}

}  // namespace simulator
