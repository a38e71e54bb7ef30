// The schemas as tables: what may stand where, compiled once from the model that xerces-c has of them. What the tables hold is
// what xerces-c accepts, or less: whatever they do not know is `unknown`, and left to xerces-c (docs/validation.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <xercesc/framework/XMLGrammarPool.hpp>

#include "xml/interned.hpp"
#include "xml/value_type.hpp"

namespace rois::xml {

// An expanded name: the numbers of a namespace and of a local name.
struct Name {
    Interned::Id name_space = Interned::unknown;
    Interned::Id local = Interned::unknown;

    bool operator==(Name const&) const = default;
};

struct ElementDeclaration;

// One state of a content model: what may come next, and whether this may be the end.
struct ContentState {
    struct Transition {
        Name name;
        ElementDeclaration const* element = nullptr;
        std::uint32_t state = 0;
    };
    std::vector<Transition> transitions;  // one for a name
    bool final = false;
    std::uint32_t number = 0;  // among all states of all types: from 1 on
};

struct AttributeUse {
    Name name;
    ValueType const* type = nullptr;
};

// A type of elements, complex or simple.
struct ElementType {
    enum class Content : std::uint8_t { unknown, empty, value, elements, mixed };

    Content content = Content::unknown;
    ValueType const* value = nullptr;      // of Content::value
    std::vector<ContentState> states;      // of Content::elements and mixed; it begins with the first one
    std::vector<AttributeUse> attributes;  // 64 at most
    std::uint64_t required = 0;            // a bit for each of them that must be there
};

struct ElementDeclaration {
    ElementType const* type = nullptr;                             // its content is unknown when anything about the element is
    std::vector<std::pair<Name, ElementType const*>> substitutes;  // what its xsi:type may name
    bool of_limited_length = false;                                // one of those whose length the scan limits
};

// Immutable; any thread may read. Refers to nothing of xerces-c's.
class Tables {
public:
    // Of a locked pool; `namespaces` are those that documents may declare.
    Tables(xercesc::XMLGrammarPool&, std::vector<std::string> const& namespaces);
    Tables(Tables const&) = delete;
    Tables& operator=(Tables const&) = delete;

    Interned::Id name(std::string_view text) const { return names_.find(text); }

    std::string_view text(Interned::Id name) const { return names_.text(name); }

    // The number of a namespace that may be declared and that the tables know; else `unknown`.
    Interned::Id name_space(std::string_view text) const;

    // Null when there is no such global element.
    ElementDeclaration const* root(Name) const;

    Name xsi_type() const { return xsi_type_; }

    // The highest number of a content state.
    std::uint32_t states() const { return states_; }

private:
    friend class TablesBuilder;

    Interned names_;
    Interned::Id last_name_space_ = Interned::empty;  // those that may be declared come before all other names
    Name xsi_type_;
    std::uint32_t states_ = 0;
    std::deque<ValueType> values_;
    std::deque<ElementType> types_;
    std::deque<ElementDeclaration> declarations_;
    std::vector<std::pair<Name, ElementDeclaration const*>> roots_;
};

}  // namespace rois::xml
