// Numbers for the names that the schemas know: to compare names is then to compare numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rois::xml {

class Interned {
public:
    using Id = std::uint16_t;
    static constexpr Id unknown = 0;
    static constexpr Id empty = 1;  // of the empty text, as which "no namespace" is kept

    Interned();

    // The number of a text, a new one when it has none yet. Throws std::runtime_error when there are no more numbers.
    Id add(std::string_view);

    // `unknown` for a text that was not added.
    Id find(std::string_view) const;

    // Of a number that `add` gave.
    std::string_view text(Id id) const { return texts_[id]; }

private:
    void place(Id);

    std::vector<std::string> texts_;  // by number; the first one is nobody's
    std::vector<Id> slots_;           // a hash table with open addressing; a power of two, at most half full
};

}  // namespace rois::xml
