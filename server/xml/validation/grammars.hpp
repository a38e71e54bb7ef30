// The compiled schemas; internal to server/xml.
#pragma once

#include <memory>
#include <string>
#include <vector>
#include <xercesc/framework/XMLGrammarPool.hpp>

#include "xml/tables/tables.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::xml {

class Schemas::Grammars {
public:
    explicit Grammars(NamedFiles const& files);

    // Locked. Parsers and resolvers need a non-const reference, but do not modify it.
    xercesc::XMLGrammarPool& pool() const { return *pool_; }

    // The namespaces that a document may declare.
    std::vector<std::string> const& namespaces() const { return namespaces_; }

    Tables const& tables() const { return *tables_; }

private:
    std::unique_ptr<xercesc::XMLGrammarPool> pool_;
    std::vector<std::string> namespaces_;
    std::unique_ptr<Tables const> tables_;
};

}  // namespace rois::xml
