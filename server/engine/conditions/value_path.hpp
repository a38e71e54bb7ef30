// Parses value references: the minimum XPath of ISO 19143 (clause 7.4.4).
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace rois {

// A step to a child element, without its namespace prefix.
struct PathStep {
    struct Predicate {  // [@attribute='text']
        std::string_view attribute;
        std::string_view text;
    };

    std::string_view name;
    std::size_t position = 0;  // [n], counted from 1; 0 if absent
    std::vector<Predicate> predicates;
};

// A relative, abbreviated path: steps divided by "/"; the last one may be an attribute. Its texts point into the parsed text,
// which must outlive it.
struct ValuePath {
    std::vector<PathStep> steps;  // at least one
    std::string_view attribute;   // after "@"; empty if absent

    // Returns nullopt for any other text, such as an absolute path, or one with other axes, functions or predicates.
    static std::optional<ValuePath> parse(std::string_view);
};

}  // namespace rois
