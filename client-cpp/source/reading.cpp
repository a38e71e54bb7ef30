#include "reading.hpp"

#include "types/text/texts.hpp"

namespace rois::client {

std::vector<std::string> Reading::texts(std::string_view name) const {
    auto const* const found = find(parameters_, name);
    return found == nullptr ? std::vector<std::string>{} : found->values;
}

std::optional<std::string> Reading::text(std::string_view name) const {
    auto const* const found = find(parameters_, name);
    return found == nullptr || found->values.empty() ? std::nullopt : std::optional{found->values.front()};
}

std::optional<int> Reading::integer(std::string_view name) const {
    auto const value = text(name);
    return value ? to_int(*value) : std::nullopt;
}

std::vector<double> Reading::numbers(std::string_view name) const { return to_doubles(text(name).value_or("")); }

bool Reading::truth(std::string_view name) const {
    auto const value = text(name).value_or("");
    return trimmed(value) == "true" || trimmed(value) == "1";
}

std::optional<Utc> Reading::time(std::string_view name) const {
    auto const value = text(name);
    return value ? to_utc(*value) : std::nullopt;
}

std::optional<Milliseconds> Reading::milliseconds(std::string_view name) const {
    auto const value = integer(name);
    return value ? std::optional{Milliseconds{*value}} : std::nullopt;
}

std::vector<Identifier> Reading::identifiers(std::string_view name) const {
    std::vector<Identifier> list;
    auto const* const found = find(parameters_, name);
    if (found == nullptr) return list;
    for (auto const& code : found->values)
        list.push_back({.code = code, .authority = {}, .codebook_ref = found->data_type_ref.codebook_ref, .version = {}});
    return list;
}

std::optional<Identifier> Reading::identifier(std::string_view name) const {
    auto list = identifiers(name);
    return list.empty() ? std::nullopt : std::optional{std::move(list.front())};
}

std::vector<Sighting> Reading::sightings(std::string_view refs, std::string_view positions) const {
    std::vector<Sighting> seen;
    auto const* const where = find(parameters_, positions);
    for (auto& ref : identifiers(refs)) {
        auto const index = seen.size();
        auto const known = where != nullptr && index < where->values.size()
                               ? to_pose(where->values[index], where->data_type_ref.codebook_ref)
                               : std::nullopt;
        seen.push_back({std::move(ref), known.value_or(Pose{})});
    }
    return seen;
}

Results const& results_of(ReceiveEvent const& event) {
    static Results const none;
    return event.results ? *event.results : none;
}

Arguments& Arguments::text(std::string_view name, std::optional<std::string> const& value) {
    if (value) list_.push_back(rois::text(std::string{name}, *value));
    return *this;
}

Arguments& Arguments::texts(std::string_view name, std::vector<std::string> const& values, std::string crs) {
    if (!values.empty()) list_.push_back(positions(std::string{name}, values, std::move(crs)));
    return *this;
}

Arguments& Arguments::integer(std::string_view name, std::optional<std::int64_t> value) {
    if (value) list_.push_back(rois::integer(std::string{name}, *value));
    return *this;
}

Arguments& Arguments::integers(std::string_view name, std::vector<std::int64_t> const& values) {
    std::string all;
    for (auto const value : values) (all += all.empty() ? "" : " ") += std::to_string(value);
    auto list = rois::text(std::string{name}, std::move(all));
    list.data_type_ref.code = "int[]";
    if (!values.empty()) list_.push_back(std::move(list));
    return *this;
}

Arguments& Arguments::milliseconds(std::string_view name, std::optional<Milliseconds> value) {
    if (value) list_.push_back(rois::integer(std::string{name}, value->count()));
    return *this;
}

Arguments& Arguments::identifier(std::string_view name, std::optional<Identifier> const& value) {
    if (value) list_.push_back(reference(std::string{name}, value->code, value->codebook_ref));
    return *this;
}

}  // namespace rois::client
