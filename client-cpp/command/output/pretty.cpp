#include "command/output/pretty.hpp"

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>
#include <vector>

#include "command/output/terminal.hpp"
#include "types/text/texts.hpp"

namespace rois::command {

namespace {

constexpr std::size_t shown_before = 60;  // characters of a long line, before the mark
constexpr std::size_t shown_after = 60;
constexpr std::size_t longest_line = 120;

// The line of this number without its line end; lines end with LF, CR LF or CR.
std::string_view line_of(std::string_view document, std::uint64_t number) {
    if (document.starts_with("\xef\xbb\xbf")) document.remove_prefix(3);
    for (std::uint64_t line = 1;; ++line) {
        auto const end = document.find_first_of("\r\n");
        if (line == number) return document.substr(0, end);
        if (end == document.npos) return {};
        document.remove_prefix(end + (document.substr(end, 2) == "\r\n" ? 2 : 1));
    }
}

std::vector<std::string> characters_of(std::string_view line) {
    std::vector<std::string> characters;
    while (!line.empty()) {
        auto const before = line;
        take_character(line);
        characters.push_back(harmless(before.substr(0, before.size() - line.size())));
    }
    return characters;
}

std::string joined(std::vector<std::string> const& characters, std::size_t begin, std::size_t end) {
    std::string text;
    for (std::size_t i = begin; i < end; ++i) text += characters[i];
    return text;
}

}  // namespace

std::string pretty(std::string_view document) {
    pugi::xml_document tree;
    if (!tree.load_buffer(document.data(), document.size(), pugi::parse_default | pugi::parse_comments))
        return std::string{document};
    std::ostringstream out;
    tree.save(out, "  ", pugi::format_indent | pugi::format_no_declaration, pugi::encoding_utf8);
    return out.str();
}

std::string underlined(std::string_view document, Place place, bool coloured) {
    auto const characters = characters_of(line_of(document, place.line));
    auto const at = static_cast<std::size_t>(place.column) - 1;
    if (place.column == 0 || at >= characters.size()) return {};
    std::size_t end = at + 1;
    while (end < characters.size() && characters[end - 1] != ">" && (characters[end] != "<")) ++end;
    std::size_t from = 0;
    std::size_t until = characters.size();
    if (until > longest_line) {
        from = at > shown_before ? at - shown_before : 0;
        until = std::min(until, at + shown_after);
    }
    end = std::min(end, until);
    auto const number = std::to_string(place.line);
    auto const cut = std::string{from > 0 ? "..." : ""};
    auto const marked = std::max<std::size_t>(width_of(joined(characters, at, end)), 1);
    auto const mark = "^" + std::string(marked - 1, '~');
    return number + " | " + cut + joined(characters, from, until) + (until < characters.size() ? "..." : "") + "\n" +
           std::string(number.size(), ' ') + " | " + std::string(cut.size() + width_of(joined(characters, from, at)), ' ') +
           painted(mark, Colour::bad, coloured) + "\n";
}

}  // namespace rois::command
