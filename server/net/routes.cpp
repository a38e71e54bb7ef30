#include "net/routes.hpp"

#include <array>

#include "net/foreign.hpp"
#include "types/texts.hpp"

namespace rois::net {

namespace {

struct Named {
    std::string_view path;
    Endpoint endpoint;
};
constexpr std::array<Named, 12> fixed{{{"/", Endpoint::page},
                                       {"/plain", Endpoint::plain_page},
                                       {"/rois", Endpoint::rois},
                                       {"/rois/notifications", Endpoint::notifications},
                                       {"/rois/profile", Endpoint::engine_profile},
                                       {"/rois/schemas", Endpoint::schema_list},
                                       {"/rois/map", Endpoint::floor_map},
                                       {"/rois/stop", Endpoint::stop},
                                       {"/rois/clear", Endpoint::clear},
                                       {"/healthz", Endpoint::healthz},
                                       {"/readyz", Endpoint::readyz},
                                       {"/metrics", Endpoint::metrics}}};
constexpr std::array<Named, 3> folders{
    {{"/rois/profile/", Endpoint::component_profile}, {"/rois/schemas/", Endpoint::schema}, {"/assets/", Endpoint::asset}}};

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

// Without its percent signs; nothing when one of them is not followed by two digits.
std::optional<std::string> decoded(std::string_view text) {
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            plain.push_back(text[i]);
            continue;
        }
        if (i + 2 >= text.size() || hex_digit(text[i + 1]) < 0 || hex_digit(text[i + 2]) < 0) return {};
        plain.push_back(static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2])));
        i += 2;
    }
    return plain;
}

// The XML content types, in UTF-8 (RFC 7303).
bool is_xml(std::string_view content_type) {
    if (content_type == "application/xml") return true;  // as most say it
    auto const semicolon = std::min(content_type.find(';'), content_type.size());
    auto const type = lower_case(trimmed(content_type.substr(0, semicolon)));
    bool const structured = type.starts_with("application/") && type.ends_with("+xml");
    if (type != "application/xml" && type != "text/xml" && !structured) return false;
    for (auto rest = content_type.substr(semicolon); !rest.empty();) {
        rest.remove_prefix(1);
        auto const end = std::min(rest.find(';'), rest.size());
        auto const parameter = lower_case(trimmed(rest.substr(0, end)));
        rest.remove_prefix(end);
        if (!parameter.starts_with("charset")) continue;
        if (parameter != "charset=utf-8" && parameter != "charset=\"utf-8\"") return false;
    }
    return true;
}

std::string_view methods_of(Endpoint endpoint) {
    switch (endpoint) {
        case Endpoint::stop:
        case Endpoint::clear:
            return "POST";
        case Endpoint::rois:
            return "GET, HEAD, POST";
        default:
            return "GET, HEAD";
    }
}

bool takes(Route const& route, std::string_view method) {
    bool const known = method == "GET" || method == "HEAD" || method == "POST";
    return known && methods_of(route.endpoint).find(method) != std::string_view::npos;
}

HttpAnswer not_found(RequestHead const& head) {
    return answer_of({FaultCode::not_found, "there is nothing at " + quoted(head.path), {}, {}});
}

HttpAnswer method_not_allowed(Route const& route) {
    auto const allowed = methods_of(route.endpoint);
    auto answer = answer_of({FaultCode::method_not_allowed, "the methods taken here are " + std::string{allowed}, {}, {}});
    answer.set("Allow", allowed);
    return answer;
}

}  // namespace

Route route_of(std::string_view path) {
    for (auto const& [fixed_path, endpoint] : fixed) {
        if (path == fixed_path) return {endpoint, {}};
    }
    for (auto const& [folder, endpoint] : folders) {
        if (!path.starts_with(folder)) continue;
        if (auto name = decoded(path.substr(folder.size()))) return {endpoint, std::move(*name)};
    }
    return {};
}

std::optional<HttpAnswer> refusal(RequestHead const& head, Route const& route, Settings const& settings) {
    if (auto foreign = refusal_of_foreign(head, settings)) return foreign;
    bool const known_method = head.method == "GET" || head.method == "HEAD" || head.method == "POST";
    if (route.endpoint == Endpoint::unknown && known_method) return not_found(head);
    if (!takes(route, head.method)) return method_not_allowed(route);
    if (head.content_length > settings.document.bytes) {
        return answer_of(
            {FaultCode::too_large, "the body may have " + std::to_string(settings.document.bytes) + " bytes", {}, {}});
    }
    if (head.method != "POST" || route.endpoint != Endpoint::rois) return {};
    auto const type = head.field("Content-Type");
    if (!type || !is_xml(*type)) {
        return answer_of({FaultCode::unsupported_media_type,
                          "send one request document with the header Content-Type: application/xml (charset utf-8)",
                          {},
                          {}});
    }
    return {};
}

}  // namespace rois::net
