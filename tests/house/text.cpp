#include "house/text.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace rois::house {

void for_each_line(std::string_view text, std::function<void(std::string const&, std::size_t)> const& see) {
    std::istringstream lines{std::string(text)};
    std::string line;
    for (std::size_t number = 1; std::getline(lines, line); ++number) see(line, number);
}

std::string at(std::string_view file, std::size_t line) { return std::string(file) + ":" + std::to_string(line) + ": "; }

bool is_cpp(std::string_view file) { return file.ends_with(".cpp") || file.ends_with(".hpp"); }

namespace {

// The end of the literal or comment that begins at `from`; `from` itself if none begins there.
std::size_t end_of_silence(std::string_view text, std::size_t from) {
    auto const after = [&](std::string_view mark, std::size_t start) {
        auto const found = text.find(mark, start);
        return found == text.npos ? text.size() : found + mark.size();
    };
    auto const rest = text.substr(from);
    if (rest.starts_with("//")) return std::min(text.find('\n', from), text.size());
    if (rest.starts_with("/*")) return after("*/", from + 2);
    if (rest.starts_with("R\"")) {
        auto const open = text.find('(', from);
        if (open == text.npos) return text.size();
        return after(")" + std::string(text.substr(from + 2, open - from - 2)) + "\"", open);
    }
    bool const digit_separator =
        rest.starts_with('\'') && from > 0 && std::isxdigit(static_cast<unsigned char>(text[from - 1])) != 0;
    if (digit_separator || (!rest.starts_with('"') && !rest.starts_with('\''))) return from;
    for (auto i = from + 1; i < text.size(); ++i) {
        if (text[i] == '\\') {
            ++i;
        } else if (text[i] == rest.front() || text[i] == '\n') {
            return i + 1;
        }
    }
    return text.size();
}

}  // namespace

std::string code_alone(std::string_view text) {
    std::string code(text);
    for (std::size_t i = 0; i < text.size();) {
        auto const end = end_of_silence(text, i);
        for (auto j = i; j < end; ++j)
            if (code[j] != '\n') code[j] = ' ';
        i = std::max(i + 1, end);
    }
    return code;
}

}  // namespace rois::house
