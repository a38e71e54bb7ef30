// Reads and writes typed values of results and parameters, by name. A missing or invalid value is read as empty.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rois/components.hpp"
#include "types/messages.hpp"

namespace rois::client {

class Reading {
public:
    explicit Reading(Results const& results) : parameters_{results.parameters} {}
    explicit Reading(ParameterList const& parameters) : parameters_{parameters} {}

    std::optional<std::string> text(std::string_view name) const;
    std::vector<std::string> texts(std::string_view name) const;
    std::optional<int> integer(std::string_view name) const;
    std::vector<double> numbers(std::string_view name) const;  // of int[], which is one text
    bool truth(std::string_view name) const;
    std::optional<Utc> time(std::string_view name) const;
    std::optional<Milliseconds> milliseconds(std::string_view name) const;
    std::optional<Identifier> identifier(std::string_view name) const;
    std::vector<Identifier> identifiers(std::string_view name) const;
    // People or objects and their positions: two lists in the same order.
    std::vector<Sighting> sightings(std::string_view refs, std::string_view positions) const;

private:
    ParameterList const& parameters_;
};

// The inline results of an event; empty if it has none.
Results const& results_of(ReceiveEvent const&);

// Builds a list of parameters; leaves out empty values.
class Arguments {
public:
    Arguments& text(std::string_view name, std::optional<std::string> const&);
    Arguments& texts(std::string_view name, std::vector<std::string> const&, std::string crs = {});
    Arguments& integer(std::string_view name, std::optional<std::int64_t>);
    Arguments& integers(std::string_view name, std::vector<std::int64_t> const&);
    Arguments& milliseconds(std::string_view name, std::optional<Milliseconds>);
    Arguments& identifier(std::string_view name, std::optional<Identifier> const&);

    ParameterList list() { return std::move(list_); }

private:
    ParameterList list_;
};

}  // namespace rois::client
