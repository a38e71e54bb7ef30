// What a test sees of an answer.
#pragma once

#include <string>
#include <string_view>

#include "net/http/http_answer.hpp"

namespace rois::net {

inline std::string written(HttpAnswer const& answer, Framing framing = {}) {
    std::string out;
    append(out, answer, framing);
    return out;
}

// Returns the value that is sent in this header field, or an empty text if there is none.
inline std::string field(HttpAnswer const& answer, std::string_view name) {
    auto const text = written(answer);
    auto const line = "\r\n" + std::string{name} + ": ";
    auto const begin = text.find(line);
    if (begin == text.npos) return {};
    auto const value = begin + line.size();
    return text.substr(value, text.find("\r\n", value) - value);
}

}  // namespace rois::net
