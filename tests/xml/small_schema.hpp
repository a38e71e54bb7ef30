// A small schema for a test, and the comparison of the tables with xerces-c.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "fuzz/comparison.hpp"
#include "xml/speaking.hpp"

namespace rois::xml {

using Outcome = fuzz::Comparison::Outcome;

// A schema with these declarations in the namespace urn:t. Checks documents with the tables and with xerces-c.
class Small {
public:
    explicit Small(std::string_view declarations) {
        static Platform const platform;
        text_.append(R"(<xsd:schema xmlns:xsd="http://www.w3.org/2001/XMLSchema" xmlns="urn:t" xmlns:t="urn:t")")
            .append(R"( targetNamespace="urn:t" elementFormDefault="qualified">)")
            .append(declarations)
            .append("</xsd:schema>");
        comparison_.emplace(std::make_shared<Schemas const>(NamedFiles{{"t.xsd", text_}}));
    }

    // Checks `<root xmlns="urn:t">` with this content and these attributes. The test fails if only the tables accept it.
    Outcome root(std::string_view inside, std::string_view attributes = {}) {
        std::string document{R"(<root xmlns="urn:t" xmlns:t="urn:t" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance")"};
        document.append(attributes).append(">").append(inside).append("</root>");
        auto const outcome = comparison_->look_at(document);
        EXPECT_NE(outcome, Outcome::wrong) << text_ << '\n' << document << '\n' << comparison_->complaint();
        return outcome;
    }

private:
    std::string text_;
    std::optional<fuzz::Comparison> comparison_;
};

}  // namespace rois::xml
