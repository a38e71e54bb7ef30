// Converts values between the plain strings and numbers of the C++ PSM and the messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rois/psm/RoIS_Common.hpp"
#include "types/messages.hpp"

namespace rois::psm {

// Arguments of set_parameter. Leaves out empty texts, empty lists and negative numbers: their parameters stay unchanged.
class Arguments {
public:
    void text(std::string name, std::string value);
    void texts(std::string name, std::vector<std::string> values);
    void points(std::string name, std::vector<std::string> values);  // in the frame of the component
    void integer(std::string name, long value);
    void integers(std::string name, std::vector<long> const& values);  // may be negative
    void identifier(std::string name, std::string code);
    void identifiers(std::string name, std::vector<std::string> codes);

    ParameterList const& list() const { return list_; }

private:
    ParameterList list_;
};

// Results of an event, an answer or get_parameter, by name. A missing result is empty or -1.
class EventResults {
public:
    EventResults() = default;
    explicit EventResults(ParameterList list) : list_{std::move(list)} {}

    std::string text(std::string_view name) const;
    std::vector<std::string> texts(std::string_view name) const;
    long integer(std::string_view name) const;
    std::vector<long> integers(std::string_view name) const;
    // The functions above under the names of the PSM.
    std::string time(std::string_view name) const { return text(name); }
    std::string identifier(std::string_view name) const { return text(name); }
    std::vector<std::string> identifiers(std::string_view name) const { return texts(name); }
    std::vector<std::string> points(std::string_view name) const { return texts(name); }

private:
    ParameterList list_;
};

// A list of n items is n entries with the same name (RoIS_HRI.hpp).
template <class Entry>
std::vector<Entry> entries_of(ParameterList const& list) {
    std::vector<Entry> entries;
    for (auto const& parameter : list)
        for (auto const& value : parameter.values) entries.push_back({parameter.name, parameter.data_type_ref.code, value});
    return entries;
}
ParameterList parameters_of(RoIS_HRI::ParameterList const&);

Identifier identifier_of(std::string code);

// Component_Status and Stream_Status by their texts; false if the text is not one of them.
bool read_status(std::string_view text, RoIS_Common::Component_Status&);
bool read_status(std::string_view text, RoIS_Common::Stream_Status&);

}  // namespace rois::psm
