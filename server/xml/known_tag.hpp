// Start tags as they were last written, to be taken as a whole when they come again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "xml/tables.hpp"

namespace rois::xml {

// The last start tag without attributes that stood at some place: in the root's, or in one state of an element's content. Where
// the same bytes stand there again, and its prefix means the same, all that was found out about it holds again.
struct KnownTag {
    // A part of the tag.
    struct Part {
        std::size_t offset = 0;
        std::size_t length = 0;

        std::string_view of(char const* tag) const { return {tag + offset, length}; }
    };
    struct Declared {
        Part prefix;
        Interned::Id name_space = Interned::empty;
    };

    static constexpr std::size_t longest = 512;  // bytes

    std::string text;  // from `<` to `>`; empty: none was seen yet
    Part name, prefix, local;
    std::vector<Declared> namespaces;  // that the tag declares
    Interned::Id name_space = Interned::empty;
    ElementDeclaration const* declaration = nullptr;
    bool holds_text = false;       // whatever text; no elements
    std::uint32_t next_state = 0;  // of its parent's content
    std::uint64_t scope = 0;       // in which its prefix was last looked up; of a root: that it opens
};

}  // namespace rois::xml
