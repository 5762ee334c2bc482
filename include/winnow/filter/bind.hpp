// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// From named buffers to the planes of a sweep, with every check that the input needs, before any work.
#include <cstdint>
#include <span>
#include <winnow/core/error.hpp>
#include <winnow/executor/run.hpp>
#include <winnow/filter/frame_with.hpp>
#include <winnow/frame/frame.hpp>
#include <winnow/frame/output.hpp>
#include <winnow/window/concept.hpp>

namespace winnow::detail {

// Names become strings only where a message needs them: a run that goes well allocates nothing.
inline std::string name_of(const char* name) { return name; }
template <guide G>
std::string name_of(G) {
    return G::name();
}

template <class Name, class Reference>
void check_layer(Name name, const source& layer, int channels, extent size, Reference reference) {
    if (layer.size != size)
        fail(name_of(name) + " is " + to_string(layer.size) + ", " + name_of(reference) + " is " + to_string(size));
    if (layer.channels != channels)
        fail(name_of(name) + " has " + std::to_string(layer.channels) + " channels, it needs " +
             std::to_string(channels));
}

/// Whether a value of one layer can share a byte with a value of the other.
inline bool overlap(const source& a, const source& b) {
    struct interval {
        std::intptr_t first, last;
    };
    const auto bytes = [](const source& s) {
        interval i{reinterpret_cast<std::intptr_t>(s.data), reinterpret_cast<std::intptr_t>(s.data)};
        const auto widen = [&i](std::intptr_t by) { (by < 0 ? i.first : i.last) += by; };
        widen(s.step.pixel * (s.size.width - 1));
        widen(s.step.row * (s.size.height - 1));
        widen(s.step.channel * (s.channels - 1));
        i.last += s.type == scalar::float32 ? 4 : 2;
        return i;
    };
    const interval x = bytes(a), y = bytes(b);
    if (x.last <= y.first || y.last <= x.first) return false;
    // Two members of one array of pixels: they meet only if they share bytes within a pixel.
    const std::ptrdiff_t pixel = a.step.pixel;
    if (pixel <= 0 || pixel != b.step.pixel || a.step.row != b.step.row || a.step.row % pixel != 0) return true;
    const std::ptrdiff_t size_a = a.type == scalar::float32 ? 4 : 2, size_b = b.type == scalar::float32 ? 4 : 2;
    for (int i = 0; i < a.channels; ++i)
        for (int j = 0; j < b.channels; ++j) {
            const std::ptrdiff_t from_a = (b.data + j * b.step.channel) - (a.data + i * a.step.channel);
            const std::ptrdiff_t d = (from_a % pixel + pixel) % pixel;  // b starts d bytes after an a
            if (d < size_a || pixel - d < size_b) return true;
        }
    return false;
}

/// Checks the sizes of all that an output asks for, but for its further layers' inputs.
template <class Reference>
void check_outputs(const output& out, int channels, extent size, Reference reference) {
    const auto check = [&](const char* name, const target& to, int needed) {
        if (to) check_layer(name, source(to), needed, size, reference);
    };
    check("the output", out.mean(), channels);
    check("the output of the first half", out.half_a(), channels);
    check("the output of the second half", out.half_b(), channels);
    check("the output of the error", out.error(), channels);
    check("the output of the derivative", out.derivative(), channels);
    check("the output of the sum of weights", out.support(), 1);
    for (const auto& layer : out.layers()) check("the output of a further layer", layer.second, layer.first.channels);
}

template <class Frame, class G>
source find_or_fail(const Frame& in, G) {
    const source layer = in.find(G{});
    if (!layer) fail("the filter needs " + G::name() + ", which the frame does not have");
    return layer;
}

/// Fills the buffers of a sweep from a frame and one output for each of its weights.
template <class Sweep, class Frame>
void bind_sweep(const Sweep& sweep, const Frame& in, std::span<const output> out, sweep_buffers& buffers) {
    using estimator = std::remove_const_t<decltype(Sweep::estimator)>;
    const auto value = filtered_guide(in);
    if constexpr (estimator::needs_derivative)
        static_assert(std::is_same_v<typename estimator::varies, decltype(filtered_guide(in))>,
                      "the estimator wants the derivative with respect to another buffer than the frame filters");
    const bool layers_alone = std::is_same_v<Frame, frame<>> && !out[0].layers().empty();
    const source main = layers_alone ? out[0].layers()[0].first : find_or_fail(in, value);
    if (main.size.width < 1 || main.size.height < 1)
        fail(value.name() + " is " + to_string(main.size) + ": there is nothing to filter");
    if (!layers_alone && main.channels != value.channels)
        fail(value.name() + " has " + std::to_string(main.channels) + " channels, it needs " +
             std::to_string(value.channels));
    buffers.size = main.size;
    buffers.channels = main.channels;
    buffers.clear();
    buffers.results.clear();
    buffers.errors.clear();
    buffers.derivatives.clear();
    buffers.supports.clear();

    const auto add_guides = [&](const auto& frame, frame_planes& to) {
        Sweep::reads::for_each([&]<class G>(G) {
            source layer;
            if constexpr (!is_gradient<G>) {
                layer = find_or_fail(frame, G{});
                check_layer(G{}, layer, G::channels, buffers.size, value);
            }
            for (int c = 0; c < G::channels; ++c) to.guides.push_back(layer ? layer.channel(c) : source{});
        });
    };
    add_guides(in, buffers);

    const auto add_values = [&](const source& layer, frame_planes& to) {
        for (int c = 0; c < layer.channels; ++c) to.values.push_back(layer.channel(c));
    };
    constexpr bool sums = sums_in < Sweep >> 0;
    bool estimates = false;
    buffers.mean = buffers.halves = false;
    for (const output& o : out) {
        buffers.mean = buffers.mean || o.mean();
        buffers.halves = buffers.halves || o.half_a() || o.half_b();
        if (o.error() && !estimator::reports)
            fail(
                "an error image is asked for, but the filter has no estimator; use "
                "filter.with(estimator::residual_variance{}) or filter.with(estimator::sure{})");
        if (o.derivative() && !estimator::needs_derivative)
            fail("a derivative is asked for, but the filter's estimator has none; use filter.with(estimator::sure{})");
        estimates = estimates || (!sums && o.error()) || o.derivative();
        if (o.layers().size() != out[0].layers().size()) fail("the outputs do not ask for the same further layers");
    }
    buffers.halves = buffers.halves || (estimates && estimator::needs_halves);
    // Estimates are made of the mean; halves come after it.
    buffers.mean = buffers.mean || buffers.halves || estimates || estimator::needs_derivative;
    if (layers_alone && buffers.mean) fail("the filter needs " + value.name() + ", which the frame does not have");
    const auto add_colors = [&](const auto& frame, frame_planes& to) {
        const auto add_color = [&](auto g, const char* otherwise) {
            const source layer = frame.find(g);
            if (!layer)
                fail(std::string(otherwise) + g.name() +
                     "; render the frame twice with other seeds, or split its samples by parity");
            check_layer(g, layer, buffers.channels, buffers.size, value);
            add_values(layer, to);
        };
        if (buffers.mean) add_color(value, "a frame has no ");
        if (buffers.halves) {
            add_color(first_half(value), "half buffers are asked for, but the frame has no ");
            add_color(second_half(value), "half buffers are asked for, but the frame has no ");
        }
    };
    add_colors(in, buffers);
    for (const auto& layer : out[0].layers()) {
        check_layer("a further layer", layer.first, layer.first.channels, buffers.size, value);
        add_values(layer.first, buffers);
    }
    buffers.frames = 1;
    if constexpr (is_frame_sequence<Frame>)
        in.for_each_other(frames_around(sweep.window), [&](const auto& other) {
            if (!out[0].layers().empty())
                fail("further layers are those of one frame; the filter's window looks at others too");
            const std::size_t i = static_cast<std::size_t>(buffers.frames++) - 1;
            if (buffers.others.size() <= i) buffers.others.emplace_back();
            buffers.others[i].clear();
            add_guides(other, buffers.others[i]);
            add_colors(other, buffers.others[i]);
        });

    const auto add = [&](std::vector<target>& to, const target& layer, int channels, const char* what) {
        if (layer) {
            check_layer(what, source(layer), channels, buffers.size, value);
            const auto check_apart = [&](const source& from) {
                if (from && overlap(from, layer))
                    fail(std::string(what) + " overlaps the input; filter into other memory");
            };
            for (const source& from : buffers.guides) check_apart(from);
            for (const source& from : buffers.values) check_apart(from);
        }
        for (int c = 0; c < channels; ++c) to.push_back(layer ? layer.channel(c) : target{});
    };
    for (const output& o : out) {
        if (buffers.mean) add(buffers.results, o.mean(), buffers.channels, "the output");
        if (buffers.halves) {
            add(buffers.results, o.half_a(), buffers.channels, "the output of the first half");
            add(buffers.results, o.half_b(), buffers.channels, "the output of the second half");
        }
        for (std::size_t i = 0; i < o.layers().size(); ++i) {
            if (o.layers()[i].first != out[0].layers()[i].first)
                fail("the outputs do not ask for the same further layers");
            add(buffers.results, o.layers()[i].second, o.layers()[i].first.channels, "the output of a further layer");
        }
        add(buffers.errors, o.error(), sums ? 1 : buffers.channels, "the output of the error");
        add(buffers.derivatives, o.derivative(), buffers.channels, "the output of the derivative");
        add(buffers.supports, o.support(), 1, "the output of the sum of weights");
    }
}

/// Calls check() of every policy that has one.
template <class Sweep>
void check_numbers(const Sweep& sweep) {
    const auto check = [](const auto& part) {
        if constexpr (requires { part.check(); }) part.check();
    };
    check(sweep.window);
    std::apply([&](const auto&... w) { (visit(w, check), ...); }, sweep.weights);
}

template <class Sweep, class Frame, class Executor>
void run_sweep(const Sweep& sweep, const Frame& in, std::span<const output> out, const Executor& executor,
               workspace& memory) {
    check_numbers(sweep);
    bind_sweep(sweep, in, out, memory.buffers);
    run_tiles(executor.kernel(), sweep, memory, executor.workers(),
              [&](int count, const auto& work) { executor.dispatch(count, work); });
}

}  // namespace winnow::detail
