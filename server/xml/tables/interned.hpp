// Gives each name of the schemas a number, so that comparing names is comparing numbers.
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
    static constexpr Id empty = 1;  // of the empty text, which stands for "no namespace"

    Interned();

    // Returns the number of a text, and adds the text if it is new. Throws std::runtime_error if no number is left.
    Id add(std::string_view);

    // Returns `unknown` if the text was not added.
    Id find(std::string_view) const;

    // `id` must be a result of add().
    std::string_view text(Id id) const { return texts_[id]; }

private:
    void place(Id);

    std::vector<std::string> texts_;  // by number; index 0 is unused
    std::vector<Id> slots_;           // hash table with open addressing; its size is a power of two, at most half of it used
};

}  // namespace rois::xml
