#pragma once
#include "scene/field.h"

namespace bruma::scene {

/// The time that a picture shows, and how it runs when it is played. Time is continuous: every moment can be drawn.
struct Timeline {
    double now_s = 0.0;
    double start_s = 0.0, end_s = 600.0;  ///< what is played
    double speed = 1.0;                   ///< seconds of the scene per second of the viewer
    double frame_rate = 25.0;             ///< of pictures written one by one, per second of the scene
    bool loop = true;
    bool operator==(const Timeline&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, Timeline>
void visit_fields(Self& timeline, Visitor&& visit) {
    const auto moment = [](std::string_view name, std::string_view sentence) {
        return Field{.name = name, .unit = "s", .sentence = sentence, .min = -1e9, .max = 1e9, .panel_max = 3600.0};
    };
    visit(moment("now", "the moment that is shown"), timeline.now_s);
    visit(moment("start", "where playing begins"), timeline.start_s);
    visit(moment("end", "where playing ends"), timeline.end_s);
    visit(Field{.name = "speed",
                .sentence = "seconds of the scene in one second of the viewer",
                .min = 0.0,
                .max = 1e4,
                .panel_max = 100.0},
          timeline.speed);
    visit(Field{.name = "frame_rate",
                .unit = "1/s",
                .sentence = "pictures per second of the scene when they are written one by one",
                .min = 1e-3,
                .max = 1e4,
                .panel_min = 1.0,
                .panel_max = 60.0},
          timeline.frame_rate);
    visit(Field{.name = "loop", .sentence = "begin again at the end"}, timeline.loop);
}

}  // namespace bruma::scene
