#include "app/verbs/contact_sheet.h"

#include <fmt/core.h>

#include <algorithm>
#include <sstream>

#include "app/exposure.h"
#include "app/nothing_seen.h"
#include "base/error.h"
#include "base/log.h"

namespace bruma::app {

std::vector<ContactSheet::Settings> sheet_settings(const std::string& option, const std::string& words) {
    std::vector<ContactSheet::Settings> all;
    std::istringstream bars(words);
    for (std::string part; std::getline(bars, part, '|');) {
        std::istringstream blanks(part);
        ContactSheet::Settings settings;
        for (std::string setting; blanks >> setting;) {
            settings.push_back(setting);
        }
        if (settings.empty()) {
            throw InputError(fmt::format(
                "{} '{}': a picture without settings; write PATH=VALUE between bars, as in 'sun.elevation=50 | "
                "sun.elevation=5'",
                option, words));
        }
        all.push_back(std::move(settings));
    }
    if (all.empty()) {
        throw InputError(fmt::format("{}: holds no settings; write PATH=VALUE between bars", option));
    }
    return all;
}

io::Picture8 draw_sheet(const ContactSheet& sheet, const SceneArguments& arguments, gl::ShaderLibrary& shaders) {
    const glm::ivec2 tile = arguments.pixels();
    io::Picture8 whole{tile.x * int(sheet.across.size()), tile.y * int(sheet.down.size()), {}};
    const std::size_t stride = std::size_t(4) * whole.width;
    whole.rgba.resize(stride * std::size_t(whole.height));
    render::Renderer renderer(shaders);
    render::Presenter presenter(shaders);
    NothingSeen nothing_seen(shaders);
    for (std::size_t row = 0; row < sheet.down.size(); ++row) {
        for (std::size_t column = 0; column < sheet.across.size(); ++column) {
            SceneArguments one = arguments;
            for (const auto& more : {sheet.down[row], sheet.across[column]}) {
                one.settings.insert(one.settings.end(), more.begin(), more.end());
            }
            scene::Scene scene = open_scene(one);
            renderer.render(scene, {tile, 1.0});
            nothing_seen.look_at(scene, renderer.picture());
            if (const auto suitable =
                    sheet.auto_exposure ? suitable_exposure(renderer.read_picture(), scene) : std::nullopt) {
                scene.display.edit([&](scene::Display& display) { display.exposure_ev = suitable->ev; });
                if (suitable->limited) {
                    log_warning("--auto-exposure: row {}, column {}: {}", row + 1, column + 1, limit_words(*suitable));
                }
            }
            const std::vector<std::uint8_t> picture = presenter.read(renderer.picture(), *scene.display);
            for (int y = 0; y < tile.y; ++y) {
                std::copy_n(picture.begin() + std::ptrdiff_t(4) * tile.x * y, 4 * tile.x,
                            whole.rgba.begin() + std::ptrdiff_t(stride * (row * tile.y + y) + 4 * column * tile.x));
            }
        }
    }
    nothing_seen.say();
    return whole;
}

}  // namespace bruma::app
