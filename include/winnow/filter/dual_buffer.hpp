// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Each half of the samples filtered with weights from the other half, so that the noise of a value never decides its
/// own weight.  Rousselle, Knaus, Zwicker, "Adaptive Rendering with Non-Local Means Filtering", 2012, section 5.
#include <winnow/filter/filter.hpp>

namespace winnow {

namespace detail {
/// What a filter reads when Half<color> stands for the colour.
template <template <class> class Half, class... G>
constexpr auto read_from(planes<G...>) {
    return planes<decltype(crossed_frame<named_layers, Half, Half>::substitute(G{}))...>{};
}
}  // namespace detail

/// Reads first_half(color), second_half(color) and their variances (each that of the half, not of the mean of both).
/// The result is the mean of the two filtered halves.  A further layer, which has no halves, gets the mean of the two
/// filterings.
template <class Filter>
struct dual_buffer {
    /// Both halves, and what the filter reads, with each half for the colour.
    using reads =
        joined<planes<half_a<color_t>, half_b<color_t>>, decltype(detail::read_from<half_a>(typename Filter::reads{})),
               decltype(detail::read_from<half_b>(typename Filter::reads{}))>;

    Filter filter;

    template <frame_with<reads> Frame, executor_policy Executor = executor::serial<>>
    void operator()(const Frame& in, const output& out, const Executor& executor = {}) const {
        workspace memory;
        (*this)(in, out, executor, memory);
    }

    template <frame_with<reads> Frame, executor_policy Executor>
    void operator()(const Frame& in, const output& out, const Executor& executor, workspace& memory) const {
        const source a = detail::find_or_fail(in, first_half(color));
        detail::check_layer(second_half(color), detail::find_or_fail(in, second_half(color)), a.channels, a.size,
                            first_half(color));
        detail::check_outputs(out, a.channels, a.size, first_half(color));
        // Two images, each with the colour and all further layers, one plane after another.
        int planes = a.channels;
        for (const auto& layer : out.layers()) planes += layer.first.channels;
        const std::size_t floats = static_cast<std::size_t>(a.size.pixels()) * planes;
        float* const first = reinterpret_cast<float*>(memory.images.reserve(2 * floats * sizeof(float)));
        float* const second = first + floats;

        const auto run = [&](const auto& frame, float* into) {
            output& o = memory.pass(planar(into, a.size, a.channels));
            float* next = into + a.size.pixels() * a.channels;
            for (const auto& layer : out.layers()) {
                o.layer(layer.first, planar(next, a.size, layer.first.channels));
                next += a.size.pixels() * layer.first.channels;
            }
            filter(frame, o, executor, memory);
        };
        memory.progress.enter(0, 0.5f);
        run(crossed_frame<Frame, half_b, half_a>{in}, first);
        memory.progress.enter(0.5f, 1);
        run(crossed_frame<Frame, half_a, half_b>{in}, second);

        const auto combine = [&](const target& to, int plane, const auto& f) {
            for (int c = 0; to && c < to.channels; ++c)
                for (int y = 0; y < a.size.height; ++y)
                    for (int x = 0; x < a.size.width; ++x) {
                        const std::ptrdiff_t i = (a.size.pixels() * (plane + c)) + a.size.width * std::ptrdiff_t{y} + x;
                        to.channel(c).set(x, y, f(first[i], second[i]));
                    }
        };
        const auto mean = [](float x, float y) { return (x + y) / 2; };
        combine(out.mean(), 0, mean);
        combine(out.half_a(), 0, [](float x, float) { return x; });
        combine(out.half_b(), 0, [](float, float y) { return y; });
        combine(out.error(), 0, [](float x, float y) { return (x - y) * (x - y) / 4; });
        int plane = a.channels;
        for (const auto& layer : out.layers()) {
            combine(layer.second, plane, mean);
            plane += layer.first.channels;
        }
    }
    bool operator==(const dual_buffer&) const = default;
};
template <class F>
dual_buffer(F) -> dual_buffer<F>;

/// As of the filter that is run twice.
template <class F>
int halo(const dual_buffer<F>& f) {
    return halo(f.filter);
}
template <class F, executor_policy Executor>
run_plan plan(const dual_buffer<F>& f, extent size, const Executor& executor, int values = 3) {
    run_plan p = plan(f.filter, size, executor, values);
    p.image_bytes = 2 * sizeof(float) * static_cast<std::size_t>(size.pixels()) * values;
    p.passes = 2;
    return p;
}

}  // namespace winnow
