// The child elements that a type allows, read from the compiled schemas, for error messages. Assumes that the schemas have no
// wildcards, and that no referenced element has substitutes.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>
#include <xercesc/framework/XMLGrammarPool.hpp>
#include <xercesc/util/QName.hpp>
#include <xercesc/validators/schema/ComplexTypeInfo.hpp>
#include <xercesc/validators/schema/SchemaElementDecl.hpp>

namespace rois::xml {

struct ElementName {
    std::string name_space;
    std::string local_name;

    bool operator==(ElementName const&) const = default;
};

// Returns "rois:value": the name with the prefix that the gateway's documents use.
std::string to_text(ElementName const&);

class ContentModel {
public:
    ContentModel(xercesc::XMLGrammarPool&, xercesc::ComplexTypeInfo&);

    // Returns the declaration of a child element by its name; null if there is none.
    xercesc::SchemaElementDecl* find(ElementName const&) const;

    // Returns the index of the first child that is not allowed, or the number of children if one is missing at the end.
    std::optional<std::size_t> failing(std::span<ElementName const> children) const;

    // Returns the names that are allowed after these children.
    std::vector<ElementName> expected_after(std::span<ElementName const> children) const;

    // Returns the names of expected_after() that complete the content, or all of them if none does.
    std::vector<ElementName> missing_after(std::span<ElementName const> children) const;

private:
    struct Declared {
        ElementName name;
        xercesc::SchemaElementDecl* declaration = nullptr;
    };
    using Names = std::vector<std::unique_ptr<xercesc::QName>>;  // of children

    void collect(xercesc::ContentSpecNode*);
    std::unique_ptr<xercesc::QName> make_name(ElementName const&) const;
    Names make_names(std::span<ElementName const>) const;
    std::optional<std::size_t> failing(Names const&) const;

    xercesc::XMLGrammarPool& pool_;
    xercesc::ComplexTypeInfo& type_;
    std::vector<Declared> declared_;  // names are unique
};

}  // namespace rois::xml
