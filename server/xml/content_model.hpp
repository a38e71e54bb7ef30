// Which elements may stand inside an element, read from the compiled schemas. There are no wildcards in them, and no element that
// is referred to has substitutes.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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

// "rois:value": with the prefix that our own documents use.
std::string to_text(ElementName const&);

class ContentModel {
public:
    ContentModel(xercesc::XMLGrammarPool&, xercesc::ComplexTypeInfo&);

    // The declaration of an element of that name somewhere inside; null when there is none.
    xercesc::SchemaElementDecl* find(ElementName const&) const;

    // The index of the first child that must not stand there, or their number when some are missing at the end.
    std::optional<std::size_t> failing(std::span<ElementName const> children) const;

    // The names, any of which may come after these children.
    std::vector<ElementName> expected_after(std::span<ElementName const> children) const;

    // Those of them that make the content complete when there is such a one, else all.
    std::vector<ElementName> missing_after(std::span<ElementName const> children) const;

private:
    struct Declared {
        ElementName name;
        xercesc::SchemaElementDecl* declaration = nullptr;
    };
    // Children as xerces-c wants them.
    using Names = std::vector<std::unique_ptr<xercesc::QName>>;

    void collect(xercesc::ContentSpecNode*);
    std::unique_ptr<xercesc::QName> make_name(ElementName const&) const;
    Names make_names(std::span<ElementName const>) const;
    std::optional<std::size_t> failing(Names const&) const;

    xercesc::XMLGrammarPool& pool_;
    xercesc::ComplexTypeInfo& type_;
    std::vector<Declared> declared_;  // each name once
};

}  // namespace rois::xml
