// The supported languages (ISO 639-1).
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace rois::basic {

inline constexpr std::array<std::string_view, 8> languages{"de", "en", "es", "fr", "it", "ja", "ko", "zh"};

inline bool is_language(std::string_view code) { return std::ranges::find(languages, code) != languages.end(); }

// Returns "de, en, ..." for messages.
inline std::string names_of_languages() {
    std::string names;
    for (auto language : languages) names += (names.empty() ? "" : ", ") + std::string{language};
    return names;
}

}  // namespace rois::basic
