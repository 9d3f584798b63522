#pragma once
#include <cstdint>

#include "scene/rendering.h"

namespace bruma::scene {

/// How the optical depth from a point to the sun is found: looked up in a grid made beforehand, or from six samples in
/// a cone at each point.
enum class CloudSunPath { grid, cone };
template <>
inline std::span<const std::string_view> enum_words<CloudSunPath>() {
    static constexpr std::array<std::string_view, 2> words{"grid", "cone"};
    return words;
}

/// Where pictures of clouds take most of their pixels from the last one.
enum class CloudReprojection { in_window, always, never };
template <>
inline std::span<const std::string_view> enum_words<CloudReprojection>() {
    static constexpr std::array<std::string_view, 3> words{"in_window", "always", "never"};
    return words;
}

/// What a picture of clouds costs and how exact it is. No switch changes what is drawn beyond its error.
struct CloudMarch {
    double step_m = 30.0;        ///< shortest segment near the eye
    double step_growth = 0.005;  ///< shortest segment per distance
    double optical_step = 0.35;  ///< optical depth that a segment aims at; 0: all segments are the shortest
    bool big_steps = true;       ///< four times longer segments until something is met
    bool empty_space_skipping = true;
    bool detail_where_it_shows = true;
    bool early_termination = true;
    double stop_transmittance = 0.005;
    std::int64_t most_turns = 1024;  ///< of the march; what then remains is one segment
    CloudSunPath sun_path = CloudSunPath::grid;
    std::int64_t grid_columns = 384;  ///< of the grid, along both edges of the weather map
    std::int64_t grid_slices = 48;
    Jitter jitter = Jitter::off;  ///< steps are short enough for no bands; noise would be grain
    CloudReprojection reprojection = CloudReprojection::in_window;
    double reach_m = 200e3;
    bool operator==(const CloudMarch&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, CloudMarch>
void visit_fields(Self& march, Visitor&& visit) {
    visit(Field{.name = "step",
                .unit = "m",
                .sentence = "length of the shortest segment",
                .min = 0.1,
                .max = 1e4,
                .panel_min = 5.0,
                .panel_max = 200.0,
                .logarithmic = true},
          march.step_m);
    visit(Field{.name = "step_growth",
                .sentence = "length of the shortest segment as a share of its distance",
                .min = 0.0,
                .max = 0.1,
                .panel_max = 0.02},
          march.step_growth);
    visit(Field{.name = "optical_step",
                .sentence = "optical depth that a segment aims at; 0: every segment is the shortest",
                .min = 0.0,
                .max = 4.0,
                .panel_max = 1.0},
          march.optical_step);
    visit(Field{.name = "big_steps", .sentence = "segments four times longer until something is met"}, march.big_steps);
    visit(Field{.name = "empty_space_skipping", .sentence = "leap over what the weather map leaves clear"},
          march.empty_space_skipping);
    visit(Field{.name = "detail_where_it_shows", .sentence = "no fine noise where a segment is longer than all of it"},
          march.detail_where_it_shows);
    visit(Field{.name = "early_termination", .sentence = "end rays behind thick cloud"}, march.early_termination);
    visit(Field{.name = "stop_transmittance",
                .sentence = "rays end below this transmittance, and what they let through is scaled to begin there",
                .min = 0.0,
                .max = 0.5,
                .panel_min = 1e-5,
                .panel_max = 0.1,
                .logarithmic = true},
          march.stop_transmittance);
    visit(Field{.name = "most_turns",
                .sentence = "of the march along a ray; what then remains is one segment",
                .min = 1.0,
                .max = 65536.0,
                .panel_min = 16.0,
                .panel_max = 4096.0,
                .logarithmic = true},
          march.most_turns);
    visit(Field{.name = "sun_path", .sentence = "grid: made when sun or weather change; cone: six samples each time"},
          march.sun_path);
    visit(Field{.name = "grid_columns",
                .sentence = "of the grid of light along either edge of the weather map",
                .min = 16.0,
                .max = 1024.0,
                .panel_min = 64.0,
                .panel_max = 512.0},
          march.grid_columns);
    visit(Field{.name = "grid_slices",
                .sentence = "of the grid of light over the height of the clouds",
                .min = 4.0,
                .max = 256.0,
                .panel_min = 8.0,
                .panel_max = 128.0},
          march.grid_slices);
    visit(Field{.name = "jitter", .sentence = "place of the samples inside their segments: the middle, or noise"},
          march.jitter);
    visit(Field{.name = "reprojection",
                .sentence =
                    "march a sixteenth of the pixels and take the others from the last picture: where it moves in "
                    "a window, in every series of pictures, or nowhere"},
          march.reprojection);
    visit(Field{.name = "reach",
                .unit = "m",
                .sentence = "clouds beyond are not drawn",
                .min = 1.0,
                .max = 1e7,
                .panel_min = 1e3,
                .panel_max = 400e3,
                .logarithmic = true},
          march.reach_m);
}

}  // namespace bruma::scene
