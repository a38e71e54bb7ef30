// What people read: colours on a terminal, and columns that are aligned.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rois::command {

enum class Colour : std::uint8_t { none, good, bad, name, quiet, value };

// Whether standard output, or standard error, is a terminal that shows colours (NO_COLOR unset, TERM not dumb).
bool shows_colours(int file_descriptor);

// The text in this colour; as it is when `coloured` is false or the colour is none. What could steer a terminal is written as
// `?`.
std::string painted(std::string_view text, Colour, bool coloured);

// Without control characters, so that nothing from outside steers a terminal. Line ends and tabs become blanks.
std::string harmless(std::string_view text);

// How many columns a text takes: one for each character, two for wide ones as those of Japanese, none for what stands above
// others.
std::size_t width_of(std::string_view text);

// Rows whose columns begin below each other.
class Table {
public:
    struct Cell {
        std::string text;
        Colour colour = Colour::none;
    };

    void add(std::vector<Cell> row) { rows_.push_back(std::move(row)); }
    bool empty() const { return rows_.empty(); }

    // Each line ends with a line end; nothing stands behind the last column.
    std::string text(bool coloured, std::string_view indent = {}) const;

private:
    std::vector<std::vector<Cell>> rows_;
};

}  // namespace rois::command
