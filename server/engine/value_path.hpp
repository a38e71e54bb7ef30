// The path of a value reference: the minimum XPath of ISO 19143 (clause 7.4.4).
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace rois {

// A step down to a child, without its prefix.
struct PathStep {
    struct Predicate {  // [@attribute='text']
        std::string_view attribute;
        std::string_view text;
    };

    std::string_view name;
    std::size_t position = 0;  // [n], counted from 1; 0 when none is said
    std::vector<Predicate> predicates;
};

// Relative, abbreviated: steps divided by "/", the last one perhaps an attribute. Its texts are parts of the text that was
// parsed, which must live as long.
struct ValuePath {
    std::vector<PathStep> steps;  // one at least
    std::string_view attribute;   // after "@"; empty when there is none

    // Nothing when the text is no such path: absolute, with other axes, functions or predicates.
    static std::optional<ValuePath> parse(std::string_view);
};

}  // namespace rois
