#include "io/mesh/mtl_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/blanks.h"
#include "io/mesh/mtl_text.h"

namespace bruma::io {
namespace {

struct Option {
    std::string_view name;
    std::size_t fewest, most;  ///< how many arguments; what is no number ends those that may be left away
    std::string_view usual;    ///< one argument that asks for nothing special
};
constexpr std::array<Option, 15> options{{
    {"-s", 1, 3, ""},
    {"-o", 1, 3, ""},
    {"-mm", 2, 2, ""},
    {"-clamp", 1, 1, ""},
    {"-t", 1, 3, "0"},
    {"-blendu", 1, 1, "on"},
    {"-blendv", 1, 1, "on"},
    {"-bm", 1, 1, ""},
    {"-boost", 1, 1, "0"},
    {"-cc", 1, 1, "off"},
    {"-imfchan", 1, 1, ""},
    {"-texres", 1, 1, ""},
    {"-type", 1, 1, ""},
    {"-colorspace", 1, 1, "sRGB"},
    {"-halo", 0, 0, ""},
}};

const Option* option_of(std::string_view word) {
    const auto* const found =
        std::find_if(options.begin(), options.end(), [&](const Option& o) { return is_same_keyword(o.name, word); });
    return found != options.end() ? &*found : nullptr;
}

/// Takes one word off the text.
std::string_view take_word(std::string_view& text) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    const std::string_view word = text.substr(0, std::min(text.find_first_of(blanks), text.size()));
    text.remove_prefix(word.size());
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return word;
}

bool is_number(std::string_view word) {
    const MtlNumbers numbers = read_mtl_numbers(word);
    return numbers.complete && numbers.values.size() == 1 && std::isfinite(numbers.values.front());
}

/// The arguments of an option, taken off the text.
std::vector<std::string_view> take_arguments(const Option& option, std::string_view& text) {
    std::vector<std::string_view> words;
    while (words.size() < option.most && !text.empty()) {
        std::string_view left = text;
        const std::string_view word = take_word(left);
        const bool may_end = words.size() >= option.fewest;
        if (may_end && (!is_number(word) || left.empty())) {
            break;  // what is left begins, or is, the file's name
        }
        words.push_back(word);
        text = left;
    }
    return words;
}

bool is_usual(const Option& option, const std::vector<std::string_view>& words) {
    return !option.usual.empty() && std::all_of(words.begin(), words.end(), [&](std::string_view word) {
        return is_same_keyword(word, option.usual) || (is_number(word) && is_number(option.usual) &&
                                                       read_mtl_numbers(word).values == std::vector<double>{0.0});
    });
}

void apply(const Option& option, const std::vector<std::string_view>& words, MtlMap& map) {
    const auto number = [&](std::size_t n, double otherwise) {
        constexpr double most = 1e6;  // beyond, no coordinate has digits left
        if (n >= words.size() || !is_number(words[n])) {
            return otherwise;
        }
        return std::clamp(read_mtl_numbers(words[n]).values.front(), -most, most);
    };
    scene::TexturePlacement& placement = map.placement;
    if (option.name == "-s") {
        placement.scale = {number(0, 1.0), number(1, 1.0)};
    } else if (option.name == "-o") {
        placement.offset = {number(0, 0.0), number(1, 0.0)};
    } else if (option.name == "-mm") {
        placement.base = number(0, 0.0);
        placement.gain = number(1, 1.0);
    } else if (option.name == "-clamp") {
        placement.once = !words.empty() && is_same_keyword(words.front(), "on");
    } else if (!is_usual(option, words)) {
        const std::string name(option.name);
        if (std::find(map.unused_options.begin(), map.unused_options.end(), name) == map.unused_options.end()) {
            map.unused_options.push_back(name);
        }
    }
}

/// Takes options off the text up to the first word that is none.
void take_options(std::string_view& text, MtlMap& map) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    while (!text.empty()) {
        std::string_view left = text;
        const Option* const option = option_of(take_word(left));
        if (option == nullptr) {
            return;
        }
        apply(*option, take_arguments(*option, left), map);
        text = left;
    }
}

void add_name(std::string_view name, MtlMap& map) {
    name = name.substr(0, name.find_last_not_of(blanks) + 1);
    if (!name.empty() && std::find(map.names.begin(), map.names.end(), name) == map.names.end()) {
        map.names.emplace_back(name);
    }
}

}  // namespace

MtlMap read_mtl_map(std::string_view arguments) {
    MtlMap map;
    std::string_view rest = arguments;
    take_options(rest, map);
    add_name(rest, map);
    rest = without_comment(rest);
    add_name(rest, map);
    // Some programs write options behind the name.
    for (std::size_t at = rest.find(" -"); at != std::string_view::npos; at = rest.find(" -", at + 1)) {
        std::string_view behind = rest.substr(at);
        if (option_of(take_word(behind)) != nullptr) {
            const std::string tail = std::string(rest.substr(at)) + " .";  // in the place of a name
            behind = tail;
            take_options(behind, map);
            add_name(rest.substr(0, at), map);
            break;
        }
    }
    return map;
}

}  // namespace bruma::io
