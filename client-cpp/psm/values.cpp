#include "psm/values.hpp"

#include <array>
#include <utility>

#include "types/text/texts.hpp"

namespace rois::psm {

void Arguments::text(std::string name, std::string value) {
    if (!value.empty()) list_.push_back(rois::text(std::move(name), std::move(value)));
}

void Arguments::texts(std::string name, std::vector<std::string> values) {
    if (!values.empty()) list_.push_back(rois::texts(std::move(name), std::move(values)));
}

void Arguments::points(std::string name, std::vector<std::string> values) { texts(std::move(name), std::move(values)); }

void Arguments::integer(std::string name, long value) {
    if (value >= 0) list_.push_back(rois::integer(std::move(name), value));
}

void Arguments::integers(std::string name, std::vector<long> const& values) {
    if (values.empty()) return;
    std::string all;
    for (auto const value : values) (all += all.empty() ? "" : " ") += std::to_string(value);
    auto list = rois::text(std::move(name), std::move(all));
    list.data_type_ref.code = "int[]";
    list_.push_back(std::move(list));
}

void Arguments::identifier(std::string name, std::string code) {
    if (!code.empty()) list_.push_back(reference(std::move(name), std::move(code)));
}

// The published Reaction takes a list where its component takes one identifier; the engine rejects a longer list.
void Arguments::identifiers(std::string name, std::vector<std::string> codes) {
    if (codes.empty()) return;
    auto list = reference(std::move(name), {});
    list.values = std::move(codes);
    list_.push_back(std::move(list));
}

std::vector<std::string> EventResults::texts(std::string_view name) const {
    auto const* const found = find(list_, name);
    return found == nullptr ? std::vector<std::string>{} : found->values;
}

std::string EventResults::text(std::string_view name) const {
    auto const* const found = find(list_, name);
    return found == nullptr || found->values.empty() ? std::string{} : found->values.front();
}

long EventResults::integer(std::string_view name) const { return to_int(text(name)).value_or(-1); }

std::vector<long> EventResults::integers(std::string_view name) const {
    std::vector<long> numbers;
    auto const all = text(name);
    for (auto rest = trimmed(all); !rest.empty();) {
        auto const word = rest.substr(0, rest.find_first_of(" \t\r\n"));
        numbers.push_back(to_int(word).value_or(0));
        rest = trimmed(rest.substr(word.size()));
    }
    return numbers;
}

ParameterList parameters_of(RoIS_HRI::ParameterList const& entries) {
    ParameterList list;
    for (auto const& entry : entries) {
        bool const continues = !list.empty() && list.back().name == entry.name;
        if (!continues) list.push_back({entry.name, identifier_of(entry.data_type_ref), {}});
        list.back().values.push_back(entry.value);
    }
    return list;
}

Identifier identifier_of(std::string code) {
    return {.code = std::move(code), .authority = {}, .codebook_ref = {}, .version = {}};
}

bool read_status(std::string_view text, RoIS_Common::Component_Status& status) {
    auto const code = to_code<ComponentStatus>(text);
    if (!code) return false;
    constexpr std::array statuses{RoIS_Common::UNINITIALIZED, RoIS_Common::READY, RoIS_Common::BUSY, RoIS_Common::WARNING,
                                  RoIS_Common::ERROR};
    status = statuses.at(static_cast<std::size_t>(*code));
    return true;
}

bool read_status(std::string_view text, RoIS_Common::Stream_Status& status) {
    auto const code = to_code<StreamStatus>(text);
    if (!code) return false;
    constexpr std::array statuses{RoIS_Common::STREAMING_NOT_RUNNING, RoIS_Common::STREAMING_NOT_CONNECTED,
                                  RoIS_Common::STREAMING_RUNNING, RoIS_Common::STREAMING_SUSPENDED,
                                  RoIS_Common::STREAMING_RESUMED};
    status = statuses.at(static_cast<std::size_t>(*code));
    return true;
}

}  // namespace rois::psm
