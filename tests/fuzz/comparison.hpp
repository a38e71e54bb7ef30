// The tables and xerces-c side by side: what the tables accept, xerces-c must accept, and both trees must hold what xerces-c
// reads.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "xml/codec/codec.hpp"
#include "xml/tables/acceptor.hpp"
#include "xml/validation/schemas.hpp"
#include "xml/validation/validator.hpp"

namespace rois::fuzz {

class Comparison {
public:
    enum class Outcome { both, xerces_only, neither, wrong };

    explicit Comparison(std::shared_ptr<xml::Schemas const>, xml::DocumentLimits = {});

    Outcome look_at(std::string const& document);

    std::uint64_t count(Outcome outcome) const { return counts_[static_cast<std::size_t>(outcome)]; }
    // Why the last document was wrong to accept.
    std::string const& complaint() const { return complaint_; }

private:
    // Why the document must not be accepted; nothing when it may.
    std::optional<std::string> objection_to(std::string const& document);
    bool trees_differ(std::string document) const;

    std::shared_ptr<xml::Schemas const> schemas_;
    xml::DocumentLimits limits_;
    xml::Acceptor acceptor_;
    xml::Validator validator_;
    std::uint64_t counts_[4] = {};
    std::string complaint_;
};

}  // namespace rois::fuzz
