#include "command/output/terminal.hpp"

#include <locale.h>
#include <unistd.h>
#include <wchar.h>

#include <algorithm>
#include <cstdlib>

#include "types/text/texts.hpp"

namespace rois::command {

namespace {

std::string_view sequence_of(Colour colour) {
    switch (colour) {
        case Colour::none:
            break;
        case Colour::good:
            return "\x1b[32m";
        case Colour::bad:
            return "\x1b[31m";
        case Colour::name:
            return "\x1b[36m";
        case Colour::quiet:
            return "\x1b[2m";
        case Colour::value:
            return "\x1b[1m";
    }
    return "";
}

// Uses UTF-8, independent of the user's locale. Returns 1 for characters that the system does not know.
std::size_t columns_of(char32_t character) {
    static auto const utf8 = newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
    if (character < 0x80 || utf8 == nullptr) return 1;
    auto const before = uselocale(utf8);
    auto const width = wcwidth(static_cast<wchar_t>(character));
    uselocale(before);
    return width < 0 ? 1 : static_cast<std::size_t>(width);
}

}  // namespace

bool shows_colours(std::string_view choice, int file_descriptor) {
    if (choice != "auto") return choice == "always";
    auto const* const refused = std::getenv("NO_COLOR");
    auto const* const terminal = std::getenv("TERM");
    if ((refused != nullptr && *refused != '\0') || terminal == nullptr || std::string_view{terminal} == "dumb") return false;
    return isatty(file_descriptor) == 1;
}

std::string harmless(std::string_view text) {
    std::string shown;
    while (!text.empty()) {
        auto const before = text;
        auto const character = *take_character(text);
        auto const bytes = before.substr(0, before.size() - text.size());
        if (character == '\n' || character == '\t' || character == '\r') {
            shown += ' ';
        } else if (character < 0x20 || (character >= 0x7f && character < 0xa0) || (character >= 0x80 && bytes.size() == 1)) {
            shown += '?';
        } else {
            shown += bytes;
        }
    }
    return shown;
}

std::string painted(std::string_view text, Colour colour, bool coloured) {
    auto shown = harmless(text);
    if (!coloured || colour == Colour::none || shown.empty()) return shown;
    return std::string{sequence_of(colour)}.append(shown).append("\x1b[0m");
}

std::size_t width_of(std::string_view text) {
    std::size_t width = 0;
    while (auto const character = take_character(text)) width += columns_of(*character);
    return width;
}

std::string Table::text(bool coloured, std::string_view indent) const {
    std::vector<std::size_t> widths;
    for (auto const& row : rows_) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(harmless(row[i].text)));
    }
    std::string text;
    for (auto const& row : rows_) {
        std::string line{indent};
        std::size_t due = 0;  // spaces before the next text
        for (std::size_t i = 0; i < row.size(); ++i) {
            auto const width = width_of(harmless(row[i].text));
            if (width > 0) {
                line.append(due, ' ').append(painted(row[i].text, row[i].colour, coloured));
                due = 0;
            }
            due += widths[i] - width + 2;
        }
        text.append(line).append("\n");
    }
    return text;
}

}  // namespace rois::command
