#include "types/values.hpp"

#include <algorithm>
#include <utility>

#include "types/text/texts.hpp"

namespace rois {

namespace {

Parameter typed(std::string name, std::string type, std::vector<std::string> values, std::string codebook_ref = {}) {
    return {.name = std::move(name),
            .data_type_ref = {.code = std::move(type), .authority = {}, .codebook_ref = std::move(codebook_ref), .version = {}},
            .values = std::move(values)};
}

// Returns a vector of one text. An initializer list would copy it.
std::vector<std::string> one(std::string value) {
    std::vector<std::string> values;
    values.push_back(std::move(value));
    return values;
}

}  // namespace

std::vector<Results> one_row(Results results) {
    std::vector<Results> rows;
    rows.push_back(std::move(results));
    return rows;
}

Parameter integer(std::string name, std::int64_t value) { return typed(std::move(name), "int", one(std::to_string(value))); }

Parameter boolean(std::string name, bool value) { return typed(std::move(name), "bool", one(value ? "true" : "false")); }

Parameter text(std::string name, std::string value) { return typed(std::move(name), "string", one(std::move(value))); }

Parameter texts(std::string name, std::vector<std::string> values) {
    return typed(std::move(name), "string[]", std::move(values));
}

Parameter date_time(std::string name, Utc value) { return typed(std::move(name), "DateTime", one(to_text(value))); }

Parameter status_of(std::string name, ComponentStatus value) {
    return typed(std::move(name), "Component_Status", one(std::string{to_text(value)}));
}

Parameter status_of(std::string name, StreamStatus value) {
    return typed(std::move(name), "Stream_Status", one(std::string{to_text(value)}));
}

Parameter reference(std::string name, std::string code, std::string codebook_ref) {
    return typed(std::move(name), "RoISIdentifier", one(std::move(code)), std::move(codebook_ref));
}

Parameter references(std::string name, std::vector<std::string> codes, std::string codebook_ref) {
    return typed(std::move(name), "RoISIdentifier[]", std::move(codes), std::move(codebook_ref));
}

Parameter positions(std::string name, std::vector<std::string> points, std::string crs) {
    return typed(std::move(name), "string[]", std::move(points), std::move(crs));
}

Parameter const* find(std::span<Parameter const> list, std::string_view name) {
    auto const found = std::ranges::find_if(list, [&](Parameter const& p) { return equal_ignoring_case(p.name, name); });
    return found == list.end() ? nullptr : &*found;
}

}  // namespace rois
