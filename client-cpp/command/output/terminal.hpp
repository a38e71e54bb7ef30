// Text for people: colours on a terminal, and aligned columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rois::command {

enum class Colour : std::uint8_t { none, good, bad, name, quiet, value };

// Returns whether to write colours to the file. `choice`: always, never, or auto, which means that the file is a terminal that
// shows colours (NO_COLOR unset, TERM not dumb).
bool shows_colours(std::string_view choice, int file_descriptor);

// Returns the harmless text, in this colour if `coloured` is true.
std::string painted(std::string_view text, Colour, bool coloured);

// Replaces control characters, so that no document can control the terminal: line ends and tabs by spaces, others by `?`.
std::string harmless(std::string_view text);

// Returns the number of columns of a text: 1 for a character, 2 for a wide one (Japanese), 0 for a combining one.
std::size_t width_of(std::string_view text);

// Rows with aligned columns.
class Table {
public:
    struct Cell {
        std::string text;
        Colour colour = Colour::none;
    };

    void add(std::vector<Cell> row) { rows_.push_back(std::move(row)); }
    bool empty() const { return rows_.empty(); }

    // Each line ends with a line end, without trailing spaces.
    std::string text(bool coloured, std::string_view indent = {}) const;

private:
    std::vector<std::vector<Cell>> rows_;
};

}  // namespace rois::command
