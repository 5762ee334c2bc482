// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#include "report.hpp"

#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <winnow/metric/mse.hpp>
#include <winnow/metric/psnr.hpp>
#include <winnow/metric/relative_mse.hpp>
#include <winnow/metric/ssim.hpp>

namespace denoise {

namespace {

struct totals {
    std::int64_t nan = 0, inf = 0, negative = 0;
};

totals count(const std::vector<winnow::layer_diagnosis>& layers) {
    totals t;
    for (const auto& layer : layers) {
        t.nan += layer.nan.count;
        t.inf += layer.inf.count;
        t.negative += layer.negative.count;
    }
    return t;
}

void print_bad(const winnow::bad_pixels& bad, const char* kind) {
    if (!bad.count) return;
    std::cerr << ", " << bad.count << ' ' << kind << " at";
    for (const auto& at : bad.first) std::cerr << ' ' << at.x << ',' << at.y;
    if (bad.count > static_cast<std::int64_t>(bad.first.size())) std::cerr << " ...";
}

}  // namespace

metrics compare(const winnow::source& image, const winnow::source& reference) {
    using namespace winnow::metric;
    return {mse(image, reference), relative_mse(image, reference), psnr(image, reference), ssim(image, reference)};
}

void print_json(const report& r) {
    using json = nlohmann::ordered_json;
    const totals bad = count(*r.read);
    json j = {{"filter", r.filter},
              {"width", r.size.width},
              {"height", r.size.height},
              {"executor", r.executor},
              {"threads", r.threads},
              {"seconds", {{"read", r.read_seconds}, {"filter", r.filter_seconds}, {"write", r.write_seconds}}},
              {"bad_pixels", {{"nan", bad.nan}, {"inf", bad.inf}, {"negative_variance", bad.negative}}}};
    if (r.outliers)
        j["outliers"] = {
            {"count", r.outliers->count}, {"removed", r.outliers->removed}, {"spread", r.outliers->spread}};
    if (r.estimated_mse) j["estimated"] = {{"mse", *r.estimated_mse}};
    const auto shown = [](const metrics& m) {
        return json{{"mse", m.mse}, {"relmse", m.relmse}, {"psnr", m.psnr}, {"ssim", m.ssim}};
    };
    if (r.input && r.output) j["metrics"] = {{"input", shown(*r.input)}, {"output", shown(*r.output)}};
    std::cout << j.dump(2) << '\n';
}

void print_text(const report& r) {
    std::printf("%s  %dx%d  %s, %d thread%s  %.3f s (read %.3f, write %.3f)\n", r.filter.c_str(), r.size.width,
                r.size.height, r.executor.c_str(), r.threads, r.threads == 1 ? "" : "s", r.filter_seconds,
                r.read_seconds, r.write_seconds);
    if (r.outliers && r.outliers->count > 0) {
        const std::vector<double>& gone = r.outliers->removed;
        std::printf("outliers: %lld taken out, with a mean radiance of %.3g %.3g %.3g\n",
                    static_cast<long long>(r.outliers->count), gone[0], gone[1], gone[2]);
    }
    if (r.estimated_mse) std::printf("estimated: mse %.4g\n", *r.estimated_mse);
    if (r.input && r.output)
        for (const auto& [name, m] : {std::pair{"input ", *r.input}, std::pair{"output", *r.output}})
            std::printf("%s  mse %.4g  relative mse %.4g  psnr %.2f dB  ssim %.4f\n", name, m.mse, m.relmse, m.psnr,
                        m.ssim);
}

void print_diagnosis(const winnow::diagnosis& d) {
    for (const auto& layer : d.layers) {
        std::cerr << "denoise: " << layer.name << ", " << winnow::to_string(layer.size);
        print_bad(layer.nan, "NaN");
        print_bad(layer.inf, "infinite");
        print_bad(layer.negative, "negative");
        std::cerr << (layer.clean() ? ", clean\n" : "\n");
    }
    for (const std::string& warning : d.warnings) std::cerr << "denoise: " << warning << '\n';
}

void warn_of_bad_pixels(const std::vector<winnow::layer_diagnosis>& read) {
    const totals bad = count(read);
    if (bad.nan + bad.inf + bad.negative == 0) return;
    std::cerr << "denoise: bad pixels: " << bad.nan << " NaN, " << bad.inf << " infinite, " << bad.negative
              << " of negative variance; --diagnose says where\n";
}

}  // namespace denoise
