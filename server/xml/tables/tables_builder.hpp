// Builds the tables from xerces-c's schema model.
#pragma once

#include <map>
#include <vector>
#include <xercesc/framework/psvi/XSComplexTypeDefinition.hpp>
#include <xercesc/framework/psvi/XSElementDeclaration.hpp>
#include <xercesc/framework/psvi/XSModel.hpp>
#include <xercesc/framework/psvi/XSSimpleTypeDefinition.hpp>

#include "xml/tables/tables.hpp"

namespace rois::xml {

class TablesBuilder {
public:
    explicit TablesBuilder(Tables& tables) : tables_{tables} {}

    void build(xercesc::XMLGrammarPool& locked);

private:
    Name name(XMLCh const* name_space, XMLCh const* local);
    Name name(xercesc::XSElementDeclaration& element) { return name(element.getNamespace(), element.getName()); }

    ElementDeclaration const* declaration(xercesc::XSElementDeclaration&);
    ElementType const* type(xercesc::XSTypeDefinition&);
    void fill(ElementType&, xercesc::XSComplexTypeDefinition&);
    void add_attributes(ElementType&, xercesc::XSComplexTypeDefinition&);
    void limit_length(ElementDeclaration&, xercesc::XSElementDeclaration&) const;
    void add_substitutes(ElementDeclaration&, xercesc::XSElementDeclaration&);

    ValueType const* value(xercesc::XSSimpleTypeDefinition&);
    ValueType made_from(xercesc::XSSimpleTypeDefinition&);
    ValueType list(xercesc::XSSimpleTypeDefinition&);
    ValueType alternatives(xercesc::XSSimpleTypeDefinition&);

    Tables& tables_;
    ElementType const* unknown_ = nullptr;                  // the type of unsupported elements
    std::vector<xercesc::XSComplexTypeDefinition*> named_;  // complex types that an xsi:type can name
    std::map<xercesc::XSElementDeclaration*, ElementDeclaration*> declarations_;
    std::map<xercesc::XSTypeDefinition*, ElementType*> types_;
    std::map<xercesc::XSSimpleTypeDefinition*, ValueType*> values_;
};

// Returns a built-in type by its local name; Kind::unknown if it is not supported.
ValueType built_in(std::string_view name);

// Returns the base type restricted by the facets of `derived`; Kind::unknown if a facet is not supported.
ValueType with_facets(ValueType base, xercesc::XSSimpleTypeDefinition& derived);

}  // namespace rois::xml
