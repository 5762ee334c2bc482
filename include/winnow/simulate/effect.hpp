// SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
#pragma once
/// \file
/// Effects: what a scene shows, as types.  The random numbers, the buffers and the code of the simulator follow from
/// the list that a scene declares; an effect that is not in it draws nothing, stores nothing and is not compiled.
#include <string>
#include <vector>
#include <winnow/frame/path_guides.hpp>
#include <winnow/frame/planes.hpp>
#include <winnow/simulate/dimension.hpp>

namespace winnow::simulate {

/// What brings what: `draws` are the random dimensions of an effect, `gives` the buffers that exist because of it.
template <class E>
concept effect_policy = plays<E, role::effect> && requires {
    typename E::draws;
    typename E::gives;
    { E::name() } -> std::convertible_to<std::string>;
};

namespace effect {

using second_hit = planes<position2_t, normal2_t, albedo2_t, hit_distance_t, brdf_t, direct_diffuse_t,
                          indirect_diffuse_t, indirect_specular_t>;

/// A thin lens: what is not in focus spreads over a circle.
struct depth_of_field {
    using role = role::effect;
    static std::string name() { return "depth_of_field"; }
    using draws = dimensions<draw::lens>;
    using gives = planes<lens_point_t>;
};
/// Objects move straight on while the shutter is open.
struct translation {
    using role = role::effect;
    static std::string name() { return "translation"; }
    using draws = dimensions<draw::time>;
    using gives = planes<shutter_time_t>;
};
/// Objects turn while the shutter is open.
struct rotation {
    using role = role::effect;
    static std::string name() { return "rotation"; }
    using draws = dimensions<draw::time>;
    using gives = planes<shutter_time_t>;
};
/// The camera moves while the shutter is open.
struct camera_motion {
    using role = role::effect;
    static std::string name() { return "camera_motion"; }
    using draws = dimensions<draw::time>;
    using gives = planes<shutter_time_t>;
};
/// Lights with an extent, the sky among them; sampled as lights and by the surfaces that they light.
struct area_light {
    using role = role::effect;
    static std::string name() { return "area_light"; }
    using draws = dimensions<draw::light_choice, draw::light, draw::lobe, draw::direction>;
    using gives = planes<visibility_t, light_point_t, brdf_t, direct_diffuse_t>;
};
/// Rough specular reflection (GGX) of lights and of everything else.
struct glossy {
    using role = role::effect;
    static std::string name() { return "glossy"; }
    using draws = dimensions<draw::lobe, draw::direction, draw::roulette>;
    using gives = joined<second_hit, planes<direct_specular_t, specular_share_t, f0_t, roughness_t, cosine_t>>;
};
/// Mirrors and glass.
struct mirror {
    using role = role::effect;
    static std::string name() { return "mirror"; }
    using draws = dimensions<draw::lobe, draw::roulette>;
    using gives = joined<second_hit, planes<direct_specular_t, specular_share_t, f0_t, cosine_t>>;
};
/// Light by way of mirrors and glass onto diffuse surfaces, by photons; paths no longer carry it.  The samples of one
/// half share photons: what these bring varies less from sample to sample than from half to half, so that its variance
/// is to be taken from the halves (frame/variance.hpp).
struct caustics {
    using role = role::effect;
    static std::string name() { return "caustics"; }
    using draws = dimensions<>;  // the photons have numbers of their own
    using gives = planes<caustic_t>;
};
/// The albedo varies over a surface.
struct texture {
    using role = role::effect;
    static std::string name() { return "texture"; }
    using draws = dimensions<>;
    using gives = planes<>;
};
/// The shading normal varies over a surface.
struct bump {
    using role = role::effect;
    static std::string name() { return "bump"; }
    using draws = dimensions<>;
    using gives = planes<>;
};
/// The roughness varies over a surface.
struct roughness_map {
    using role = role::effect;
    static std::string name() { return "roughness_map"; }
    using draws = dimensions<>;
    using gives = planes<>;
};
/// The whole space scatters and absorbs.
struct medium {
    using role = role::effect;
    static std::string name() { return "medium"; }
    using draws = dimensions<draw::free_flight, draw::direction, draw::roulette>;
    using gives = planes<transmittance_t, scatter_distance_t, indirect_diffuse_t>;
};
/// Light goes from diffuse surface to diffuse surface.
struct global_illumination {
    using role = role::effect;
    static std::string name() { return "global_illumination"; }
    using draws = dimensions<draw::lobe, draw::direction, draw::roulette>;
    using gives = joined<second_hit, planes<light_point2_t>>;
};
/// A sequence: camera and objects have moved from the previous frame to this.
struct frames {
    using role = role::effect;
    static std::string name() { return "frames"; }
    using draws = dimensions<>;
    using gives = planes<motion_vector_t, instance_t>;
};
/// Lights are chosen by what the scene says, which may be as bad as a renderer's worst guess.
struct fireflies {
    using role = role::effect;
    static std::string name() { return "fireflies"; }
    using draws = dimensions<>;
    using gives = planes<>;
};

}  // namespace effect

template <effect_policy... E>
struct effects;

namespace detail {
template <class...>
struct effect_list {};
template <class...>
struct concatenated;
template <class... E>
struct concatenated<effect_list<E...>> {
    using type = effects<E...>;
};
template <>
struct concatenated<> : concatenated<effect_list<>> {};
template <class... A, class... B, class... More>
struct concatenated<effect_list<A...>, effect_list<B...>, More...> : concatenated<effect_list<A..., B...>, More...> {};
}  // namespace detail

/// The effects of a scene.
template <effect_policy... E>
struct effects {
    template <effect_policy X>
    static constexpr bool has = (std::is_same_v<X, E> || ...);

    /// Whether any effect draws this dimension; where in the pixel is always drawn.
    template <class D>
    static constexpr bool draws = std::is_same_v<D, draw::image> || (false || ... || E::draws::template contain<D>);

    /// How many random numbers a path takes at the camera, and at most at each vertex.
    static constexpr int camera_numbers = []<class... D>(dimensions<D...>) {
        return (0 + ... + (draws<D> && !D::at_vertex ? D::count : 0));
    }(all_dimensions{});
    static constexpr int vertex_numbers = []<class... D>(dimensions<D...>) {
        return (0 + ... + (draws<D> && D::at_vertex ? D::count : 0));
    }(all_dimensions{});

    /// All buffers that a scene with these effects can give.
    using gives = joined<planes<color_t, albedo_t, normal_t, depth_t, view_depth_t, position_t, rest_position_t,
                                emission_t, image_point_t>,
                         typename E::gives...>;

    /// Something moves while the shutter is open.
    static constexpr bool shutter = draws<draw::time>;

    static std::vector<std::string> names() { return {E::name()...}; }

    /// The same list without X.
    template <effect_policy X>
    using without = typename detail::concatenated<
        std::conditional_t<std::is_same_v<X, E>, detail::effect_list<>, detail::effect_list<E>>...>::type;
};

}  // namespace winnow::simulate
