// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// A film: what a renderer adds its samples to, and gets the planes out of that a filter reads.
#include <cassert>
#include <cstring>
#include <span>
#include <vector>
#include <winnow/frame/developed.hpp>
#include <winnow/frame/film_plan.hpp>
#include <winnow/frame/moments.hpp>
#include <winnow/frame/pixel_memory.hpp>
#include <winnow/frame/sample.hpp>

namespace winnow {

namespace detail {

template <class T, int Count>
struct pixel_values {
    T values[Count] = {};
};
template <class T>
struct pixel_values<T, 0> {
    static constexpr T* values = nullptr;
};

/// Everything that is kept of one pixel, side by side.
template <class Plan>
struct film_pixel : pixel_values<double, Plan::doubles>, pixel_values<float, Plan::floats> {
    static constexpr int parts = Plan::any_halves ? 2 : 1;
    std::uint32_t count[parts] = {};  ///< of each half, or of all
    std::uint32_t rejected = 0;

    template <class Self>
    static auto floats(Self& self) {
        return self.pixel_values<float, Plan::floats>::values;
    }
    template <class Self>
    static auto doubles(Self& self) {
        return self.pixel_values<double, Plan::doubles>::values;
    }
    std::uint32_t samples() const {
        if constexpr (Plan::any_halves) return count[0] + count[1];
        else return count[0];
    }
};

}  // namespace detail

/// `film<planes<color_t, variance_of<color_t>, half_a<color_t>, half_b<color_t>, albedo_t>>`: the list says what comes
/// out, and exactly what that takes is kept.  Guides may be named with
///     their mean, variance_of (of that mean), covariance_of (of one sample),
///     half_a and half_b (samples of even and of odd index), variance_of<half_a> and variance_of<half_b>;
/// gradient_of is left out, because executors derive it.  Values are kept in float: of a mean of 1e6 and noise of 1 the
/// variance is known to a few percent, of less extreme data to the last digits.
///
/// Different pixels may be added to by different threads at once.  Parts that were rendered apart, by threads, tiles
/// or machines, are merged; the order of merging decides the last bits, so merge in a fixed order.
template <class Planes>
class film {
    using plan = detail::film_plan<typename detail::kept_planes<Planes>::type>;
    using pixel = detail::film_pixel<plan>;
    static_assert(std::is_trivially_copyable_v<pixel>);

public:
    /// What comes out.
    using planes = typename detail::kept_planes<Planes>::type;
    /// What every sample must have.
    using inputs = typename plan::inputs;
    static constexpr std::size_t pixel_bytes = sizeof(pixel);

    /// `origin` is where the camera is: points of the world that `add` is given by name are taken relative to it.
    explicit film(extent size, std::array<double, 3> origin = {}) : size_(size), origin_(origin) {
        pixels_.resize(bytes(size) / pixel_bytes);
    }
    /// The memory that a film of this size takes.
    static std::size_t bytes(extent size) { return detail::pixel_memory("a film", size, 1, pixel_bytes); }

    extent size() const { return size_; }
    const std::array<double, 3>& origin() const { return origin_; }

    /// Adds sample number `index` of pixel (x, y).  A sample with a value that is no finite float is left out and
    /// counted.  Planes that nobody asked for are not looked at.
    template <class P>
    requires gives_all<P, inputs>
    void add(int x, int y, int index, const sample<P>& s) { keep(x, y, index, narrowed<inputs>(s).values.data()); }

    /// The same with the values as the renderer holds them:  `add(x, y, i, color = L, normal = n, depth = t)`.
    template <class... G, class... V>
    requires gives_all<winnow::planes<G...>, inputs>
    void add(int x, int y, int index, const valued<G, V>&... values) {
        sample<inputs> s;
        (set(s, values), ...);
        keep(x, y, index, s.values.data());
    }

    /// Adds what another film has seen; its pixel (0, 0) lies at (x0, y0) of this one.
    void merge(const film& other, int x0 = 0, int y0 = 0) {
        const extent part = other.size_;
        if (x0 < 0 || y0 < 0 || part.width > size_.width - x0 || part.height > size_.height - y0)
            fail("a film of " + to_string(part) + " at (" + std::to_string(x0) + ", " + std::to_string(y0) +
                 ") does not lie in one of " + to_string(size_));
        if (has_points() && other.origin_ != origin_) fail("two films have points relative to different origins");
        for (int y = 0; y < part.height; ++y)
            for (int x = 0; x < part.width; ++x) merge(at(x0 + x, y0 + y), other.at(x, y));
    }

    /// Samples of a pixel that count, and those that were left out.
    std::int64_t samples(int x, int y) const { return at(x, y).samples(); }
    std::int64_t rejected(int x, int y) const { return at(x, y).rejected; }
    /// All that were left out.
    std::int64_t rejected() const {
        std::int64_t all = 0;
        for (const pixel& p : pixels_) all += p.rejected;
        return all;
    }

    /// The images.  A mean without samples is NaN, as is a variance of less than two: unknown.
    developed<planes> develop() const {
        static constexpr auto readings = []<class... G>(winnow::planes<G...>) {
            return std::array{reading_of<G>()...};
        }(planes{});
        developed<planes> images(size_);
        for (std::size_t i = 0; i < readings.size(); ++i) {
            image<float>& plane = images.number(i);
            for (int c = 0; c < plane.channels(); ++c)
                for (int y = 0; y < size_.height; ++y)
                    for (int x = 0; x < size_.width; ++x) plane.at(x, y, c) = value(at(x, y), readings[i], c);
        }
        return images;
    }

    /// All pixels as they lie in memory, to be sent to another machine: the layout is that of one build.
    std::span<const std::byte> raw() const { return std::as_bytes(std::span(pixels_)); }
    /// Takes over the pixels of a film of the same type and size.
    void restore(std::span<const std::byte> raw) {
        if (raw.size() != bytes(size_))
            fail("a film of " + to_string(size_) + " has " + std::to_string(bytes(size_)) + " bytes, not " +
                 std::to_string(raw.size()));
        std::memcpy(static_cast<void*>(pixels_.data()), raw.data(), raw.size());
    }

private:
    using halved = detail::moments<plan::halved::count, plan::halved_squares>;
    using whole = detail::moments<plan::whole::count, plan::whole_squares>;
    static constexpr int whole_floats = 2 * plan::half_floats;  // where those of the whole begin

    pixel& at(int x, int y) { return pixels_[index_of(x, y)]; }
    const pixel& at(int x, int y) const { return pixels_[index_of(x, y)]; }
    std::size_t index_of(int x, int y) const {
        assert(x >= 0 && y >= 0 && x < size_.width && y < size_.height);
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) + static_cast<std::size_t>(x);
    }

    static bool has_points() {
        bool any = false;
        inputs::for_each([&]<class G>(G) { any = any || is_point<G>; });
        return any;
    }

    template <class G, class V>
    void set([[maybe_unused]] sample<inputs>& s, [[maybe_unused]] const valued<G, V>& value) const {
        if constexpr (contains<G, inputs> && is_point<G>)
            for (int c = 0; c < G::channels; ++c) s.at(G{}, c) = static_cast<float>(value[c] - origin_[c]);
        else s.set(value);
    }

    // By itself: unrolled into the caller's loops, g++ 12 makes worse vectors of it (19 ns instead of 11 for ten
    // channels with variances; Xeon, 2026-11-22).
    __attribute__((noinline)) void keep(int x, int y, int index, const float* values) {
        pixel& p = at(x, y);
        // As is_finite, for all at once.
        std::int32_t largest = 0;
        for (int i = 0; i < inputs::count; ++i)
            largest = std::max(largest, std::bit_cast<std::int32_t>(values[i]) & 0x7fffffff);
        if (largest >= 0x7f800000) {
            ++p.rejected;
            return;
        }
        float* const floats = pixel::floats(p);
        if constexpr (plan::any_halves) {
            const int half = index & 1;
            halved::add(floats + half * plan::half_floats, values, 1 / static_cast<float>(++p.count[half]));
        } else {
            ++p.count[0];
        }
        const std::uint32_t n = p.samples();
        if constexpr (plan::whole::count > 0)
            whole::add(floats + whole_floats, values + plan::halved::count, 1 / static_cast<float>(n));
        plan::spread::for_each([&]<class G>(G) {
            detail::comoments<G::channels>::add(pixel::doubles(p) + spread_slot<G>, values + slot_of<G>(inputs{}),
                                                1 / static_cast<double>(n));
        });
    }
    template <class G>
    static constexpr int spread_slot = plan::template spread_slot<G>(typename plan::spread{});

    static void merge(pixel& a, const pixel& b) {
        float* const into = pixel::floats(a);
        const float* const from = pixel::floats(b);
        const std::uint32_t n_a = a.samples(), n_b = b.samples();
        if constexpr (plan::any_halves)
            for (int half = 0; half < 2; ++half)
                halved::merge(into + half * plan::half_floats, a.count[half], from + half * plan::half_floats,
                              b.count[half]);
        if constexpr (plan::whole::count > 0) whole::merge(into + whole_floats, n_a, from + whole_floats, n_b);
        plan::spread::for_each([&]<class G>(G) {
            detail::comoments<G::channels>::merge(pixel::doubles(a) + spread_slot<G>, n_a,
                                                  pixel::doubles(b) + spread_slot<G>, n_b);
        });
        for (int part = 0; part < pixel::parts; ++part) a.count[part] += b.count[part];
        a.rejected += b.rejected;
    }

    /// How a plane is read from a pixel: not by its type, because a film may have very many.
    struct reading {
        detail::statistic what;
        int half;                             ///< -1: of both
        enum { spread, whole, halved } kept;  ///< in which part of the pixel
        int first;                            ///< of its means there
        int channels;                         ///< of the guide itself
    };
    template <class G>
    static constexpr reading reading_of() {
        using named = detail::plane_named<G>;
        using base = typename named::base;
        if constexpr (contains<base, typename plan::spread> && named::half < 0)
            return {named::what, -1, reading::spread, spread_slot<base>, base::channels};
        else if constexpr (contains<base, typename plan::whole>)
            return {named::what, -1, reading::whole, slot_of<base>(typename plan::whole{}), base::channels};
        else return {named::what, named::half, reading::halved, slot_of<base>(typename plan::halved{}), base::channels};
    }

    static float value(const pixel& p, const reading& r, int c) {
        const bool is_mean = r.what == detail::statistic::mean;
        const double n = p.samples();
        if (r.kept == reading::spread) {
            const double* const mean = pixel::doubles(p) + r.first;
            if (is_mean) return n > 0 ? static_cast<float>(mean[c]) : detail::unknown;
            if (r.what == detail::statistic::covariance) return detail::quotient(mean[r.channels + c], n);
            return detail::variance_of_mean(mean[detail::diagonal(r.channels, c)], n);
        }
        if (r.kept == reading::whole) {
            const float* const mean = pixel::floats(p) + whole_floats + r.first + c;
            if (is_mean) return n > 0 ? *mean : detail::unknown;
            return detail::variance_of_mean(mean[plan::whole::count], n);
        }
        const float* const a = pixel::floats(p) + r.first + c;
        const float* const b = a + plan::half_floats;
        const double n_a = p.count[0], n_b = p.count[pixel::parts - 1];
        if (r.half >= 0) {
            const float* const mean = r.half == 0 ? a : b;
            const double count = r.half == 0 ? n_a : n_b;
            if (is_mean) return count > 0 ? *mean : detail::unknown;
            return detail::variance_of_mean(mean[plan::halved::count], count);
        }
        if (n == 0) return detail::unknown;
        if (is_mean) return static_cast<float>(detail::mean_of_both(*a, n_a, *b, n_b));
        const double distance = double{*b} - *a;
        const double squares = detail::squares_of_both(a[plan::halved::count], b[plan::halved::count], distance,
                                                       distance, detail::cross_share(n_a, n_b));
        return detail::variance_of_mean(squares, n);
    }

    extent size_;
    std::array<double, 3> origin_;
    std::vector<pixel> pixels_;
};

namespace detail {
/// The colour and what a filter reads, with the halves of the colour where its estimator needs them.
template <class Filter>
constexpr auto planes_for() {
    using reads = joined<planes<color_t>, typename Filter::reads>;
    if constexpr (requires { requires decltype(Filter::estimator)::needs_halves; })
        return joined<reads, planes<half_a<color_t>, half_b<color_t>>>{};
    else return reads{};
}
}  // namespace detail

/// The film of everything that some filters need:  `film_for<decltype(denoise)> film(size);`.
template <class... Filters>
using film_for = film<joined<planes<color_t>, decltype(detail::planes_for<Filters>())...>>;

}  // namespace winnow
