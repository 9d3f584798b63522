#include "io/volume/raw_name.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <vector>

#include "base/error.h"

namespace bruma::io {
namespace {

using scene::VoxelType;

struct TypeWord {
    std::string_view word;
    VoxelType type;
};
constexpr std::array<TypeWord, 18> type_words{{{"uint8", VoxelType::uint8},
                                               {"u8", VoxelType::uint8},
                                               {"uchar", VoxelType::uint8},
                                               {"byte", VoxelType::uint8},
                                               {"int8", VoxelType::int8},
                                               {"i8", VoxelType::int8},
                                               {"char", VoxelType::int8},
                                               {"uint16", VoxelType::uint16},
                                               {"u16", VoxelType::uint16},
                                               {"ushort", VoxelType::uint16},
                                               {"int16", VoxelType::int16},
                                               {"i16", VoxelType::int16},
                                               {"short", VoxelType::int16},
                                               {"float32", VoxelType::float32},
                                               {"f32", VoxelType::float32},
                                               {"float", VoxelType::float32},
                                               {"unsigned8", VoxelType::uint8},
                                               {"unsigned16", VoxelType::uint16}}};
/// Types that other programs write and that would be misread in silence.
constexpr std::array<std::string_view, 12> foreign_words{"float64", "f64",    "double", "uint32", "u32",   "int32",
                                                         "i32",     "uint64", "int64",  "rgb8",   "rgba8", "float16"};

std::string lower(std::string_view word) {
    std::string result(word);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

/// Three numbers of type T with 'x' between them, and what stands behind them.
template <class T>
std::optional<std::array<T, 3>> three_numbers(std::string_view word, std::string_view& behind) {
    std::array<T, 3> numbers{};
    const char* at = word.data();
    const char* const end = at + word.size();
    for (std::size_t n = 0; n < 3; ++n) {
        if (n > 0 && (at == end || *at++ != 'x')) {
            return std::nullopt;
        }
        if (at == end || !std::isdigit(static_cast<unsigned char>(*at))) {
            return std::nullopt;
        }
        const auto [after, error] = std::from_chars(at, end, numbers[n]);
        if (error == std::errc::result_out_of_range) {
            numbers[n] = std::numeric_limits<T>::max();  // kept, so that the size is refused and not overlooked
        } else if (error != std::errc()) {
            return std::nullopt;
        }
        at = after;
    }
    behind = std::string_view(at, std::size_t(end - at));
    return numbers;
}

/// The stem cut at '_', '-' and blanks, and at a '.' that is not part of a number.
std::vector<std::string> words_of(const std::string& stem) {
    const auto digit = [&](std::size_t i) {
        return i < stem.size() && std::isdigit(static_cast<unsigned char>(stem[i]));
    };
    std::vector<std::string> words(1);
    for (std::size_t i = 0; i < stem.size(); ++i) {
        const char c = stem[i];
        if (c == '_' || c == '-' || c == ' ' || (c == '.' && !(i > 0 && digit(i - 1) && digit(i + 1)))) {
            words.emplace_back();
        } else {
            words.back() += c;
        }
    }
    return words;
}

/// Types that are plain words too, and so say nothing beside a type that is none: 'short_8x8x8_uint8.raw'.
constexpr std::array<std::string_view, 4> plain_words{"byte", "char", "short", "float"};

bool is_plain(const std::string& word) {
    return std::find(plain_words.begin(), plain_words.end(), lower(word)) != plain_words.end();
}

/// The words of a name that may say something: plain words are left out beside a type that is none.
std::vector<bool> telling(const std::vector<std::string>& words) {
    const bool exact = std::any_of(words.begin(), words.end(), [](const std::string& word) {
        return voxel_type_of_word(word).has_value() && !is_plain(word);
    });
    std::vector<bool> result;
    result.reserve(words.size());
    for (const std::string& word : words) {
        result.push_back(!exact || !is_plain(word));
    }
    return result;
}

/// Takes one word of a name into `found`; false when it says nothing about the layout.
bool take_word(const std::string& given, const std::filesystem::path& path, scene::VolumeSource& found) {
    const std::string word = lower(given);
    std::string_view behind;
    if (const auto size = three_numbers<int>(word, behind); size && behind.empty()) {
        const glm::ivec3 value((*size)[0], (*size)[1], (*size)[2]);
        if (found.size && *found.size != value) {
            throw InputError(fmt::format("{}: the name says two sizes, {} x {} x {} and {}; say which by --dims",
                                         path.string(), found.size->x, found.size->y, found.size->z, given));
        }
        found.size = value;
        return true;
    }
    if (const auto spacing = three_numbers<double>(word, behind); spacing && (behind == "mm" || behind == "um")) {
        found.spacing = glm::dvec3((*spacing)[0], (*spacing)[1], (*spacing)[2]) / (behind == "mm" ? 1e3 : 1e6);
        return true;
    }
    if (const auto type = voxel_type_of_word(word)) {
        if (found.type && *found.type != *type) {
            throw InputError(fmt::format("{}: the name says two types, the second is {}; say which by --type",
                                         path.string(), given));
        }
        found.type = type;
        return true;
    }
    if (std::find(foreign_words.begin(), foreign_words.end(), word) != foreign_words.end()) {
        throw InputError(
            fmt::format("{}: samples of type {} are not read; convert them to uint8, int8, uint16, int16 "
                        "or float32, or say --type if the name is wrong",
                        path.string(), given));
    }
    if ((word == "be" || word == "le") && (found.size || found.type)) {
        found.endian = word == "be" ? scene::Endian::big : scene::Endian::little;
        return true;
    }
    return false;
}

}  // namespace

std::optional<VoxelType> voxel_type_of_word(std::string_view word) {
    const std::string wanted = lower(word);
    const auto found =
        std::find_if(type_words.begin(), type_words.end(), [&](const TypeWord& entry) { return entry.word == wanted; });
    return found == type_words.end() ? std::nullopt : std::optional(found->type);
}

scene::VolumeSource layout_from_name(const std::filesystem::path& path) {
    scene::VolumeSource found;
    const std::vector<std::string> words = words_of(path.stem().string());
    const std::vector<bool> tells = telling(words);
    for (std::size_t n = 0; n < words.size(); ++n) {
        if (tells[n]) {
            take_word(words[n], path, found);
        }
    }
    return found;
}

std::string make_grid_name(const std::filesystem::path& path) {
    const std::string stem = path.stem().string();
    std::string name;
    std::size_t from = 0;
    scene::VolumeSource said;
    const std::vector<std::string> words = words_of(stem);
    const std::vector<bool> tells = telling(words);
    for (std::size_t n = 0; n < words.size(); ++n) {
        const std::string& word = words[n];
        bool about_layout = true;
        try {
            about_layout = tells[n] && take_word(word, path, said);
        } catch (const InputError&) {
            // A contradiction is told where the layout is needed; here it is enough that the word is not a name.
        }
        if (!about_layout && !word.empty()) {
            name += (name.empty() || from == 0 ? "" : std::string(1, stem[from - 1])) + word;
        }
        from += word.size() + 1;
    }
    std::replace(name.begin(), name.end(), '.', '_');
    return name.empty() ? "volume" : name;
}

}  // namespace bruma::io
