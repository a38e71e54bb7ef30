// A cache of start tags, so that the acceptor can take a repeated tag as a whole. Without it, validating 20 kB takes 2.2 times as
// long (docs/performance.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "xml/tables/tables.hpp"

namespace rois::xml {

// The last start tag without attributes at one place: the root, or one state of a content model. If the same bytes occur there
// again and the prefix is bound to the same namespace, all results of checking the tag are still valid.
struct KnownTag {
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

    std::string text;  // from `<` to `>`; empty: no tag yet
    Part name, prefix, local;
    std::vector<Declared> namespaces;  // declared by the tag
    Interned::Id name_space = Interned::empty;
    ElementDeclaration const* declaration = nullptr;
    bool holds_text = false;       // its content is any text
    std::uint32_t next_state = 0;  // of its parent's content model
    std::uint64_t scope = 0;       // in which its prefix was last resolved; for a root: the scope that it opens
};

}  // namespace rois::xml
