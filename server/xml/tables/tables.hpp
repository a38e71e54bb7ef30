// Tables of the elements, attributes and values that the schemas allow, compiled once from xerces-c's schema model. Conservative:
// they accept nothing that xerces-c rejects. For an unsupported part of a schema the content is `unknown`, and xerces-c decides
// (docs/validation.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <xercesc/framework/XMLGrammarPool.hpp>

#include "xml/tables/interned.hpp"
#include "xml/tables/value_type.hpp"

namespace rois::xml {

// An expanded name: the numbers of a namespace and of a local name.
struct Name {
    Interned::Id name_space = Interned::unknown;
    Interned::Id local = Interned::unknown;

    bool operator==(Name const&) const = default;
};

struct ElementDeclaration;

// One state of a content model: the allowed next elements, and whether the content may end here.
struct ContentState {
    struct Transition {
        Name name;
        ElementDeclaration const* element = nullptr;
        std::uint32_t state = 0;
    };
    std::vector<Transition> transitions;  // names are unique
    bool final = false;
    std::uint32_t number = 0;  // unique among the states of all types, from 1
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
    std::vector<ContentState> states;      // of Content::elements and mixed; index 0 is the start
    std::vector<AttributeUse> attributes;  // at most 64
    std::uint64_t required = 0;            // bit i: attributes[i] is required
};

struct ElementDeclaration {
    ElementType const* type = nullptr;                             // Content::unknown if the element is unsupported
    std::vector<std::pair<Name, ElementType const*>> substitutes;  // the types that its xsi:type may name
    bool of_limited_length = false;                                // the scan limits its length
};

// Immutable and thread-safe. Does not refer to the grammar pool after construction.
class Tables {
public:
    // The pool must be locked. `namespaces` are the namespaces that documents may declare.
    Tables(xercesc::XMLGrammarPool&, std::vector<std::string> const& namespaces);
    Tables(Tables const&) = delete;
    Tables& operator=(Tables const&) = delete;

    Interned::Id name(std::string_view text) const { return names_.find(text); }

    std::string_view text(Interned::Id name) const { return names_.text(name); }

    // Returns the number of a namespace that documents may declare; else `unknown`.
    Interned::Id name_space(std::string_view text) const;

    // Returns null if there is no such global element.
    ElementDeclaration const* root(Name) const;

    Name xsi_type() const { return xsi_type_; }

    std::uint32_t states() const { return states_; }  // the highest number of a content state

private:
    friend class TablesBuilder;

    Interned names_;
    Interned::Id last_name_space_ = Interned::empty;  // declarable namespaces have the numbers up to this one
    Name xsi_type_;
    std::uint32_t states_ = 0;
    std::deque<ValueType> values_;
    std::deque<ElementType> types_;
    std::deque<ElementDeclaration> declarations_;
    std::vector<std::pair<Name, ElementDeclaration const*>> roots_;
};

}  // namespace rois::xml
